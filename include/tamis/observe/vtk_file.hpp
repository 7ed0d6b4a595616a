#pragma once
#include <tamis/core/lanes.hpp>

#include <bit>
#include <charconv>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace tamis::detail {

/// Text as XML has it in attributes.
inline std::string xml_text(std::string_view plain) {
    std::string text;
    for (const char c : plain) {
        if (c == '&')
            text += "&amp;";
        else if (c == '<')
            text += "&lt;";
        else if (c == '>')
            text += "&gt;";
        else if (c == '"')
            text += "&quot;";
        else
            text += c;
    }
    return text;
}
/// The shortest digits that read back as the same number.
inline std::string digits_of(double value) {
    char digits[64];
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}
inline std::string vtk_root(std::string_view type, std::string_view version) {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + std::string(type) + "\" version=\"" + std::string(version) +
           "\" byte_order=\"" + (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian") + '"';
}

template <class Number> constexpr std::string_view vtk_type() {
    if constexpr (std::is_same_v<Number, float>)
        return "Float32";
    else if constexpr (std::is_same_v<Number, double>)
        return "Float64";
    else if constexpr (std::is_same_v<Number, std::int32_t>)
        return "Int32";
    else {
        static_assert(std::is_same_v<Number, std::int64_t>);
        return "Int64";
    }
}

/// Points with values, as a file of VTK's XML PolyData: every point a vertex, arrays appended as they lie in memory.
class vtk_points {
  public:
    vtk_points(std::uint64_t count, double time) : count_(count), time_(time) {}

    /// The places, and the values of the points: `put` appends `components` numbers a point, and is called while the
    /// file is written, so that of all arrays but one is in memory at a time.
    template <class Number> void set_places(std::function<void(std::vector<Number>&)> put) {
        places_ = made(array{"Points", {}, 3, {}}, std::move(put));
    }
    template <class Number> void add(std::string name, std::string unit, int components,
                                     std::vector<std::string> component_names,
                                     std::function<void(std::vector<Number>&)> put) {
        values_.push_back(made(array{std::move(name), std::move(unit), components, std::move(component_names)}, put));
    }

    void write(std::ostream& out) const {
        const auto numbers = [this](std::int64_t first) {
            return std::function<void(std::vector<std::int64_t>&)>([this, first](std::vector<std::int64_t>& to) {
                for (std::uint64_t k = 0; k < count_; ++k) to.push_back(static_cast<std::int64_t>(k) + first);
            });
        };
        const array connectivity = made(array{"connectivity", {}, 1, {}}, numbers(0));
        const array offsets = made(array{"offsets", {}, 1, {}}, numbers(1));
        std::uint64_t offset = 0;
        const std::string count = std::to_string(count_);
        out << vtk_root("PolyData", "1.0") << " header_type=\"UInt64\">\n<PolyData>\n"
            << "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">"
            << digits_of(time_) << "</DataArray>\n</FieldData>\n"
            << "<Piece NumberOfPoints=\"" << count << "\" NumberOfVerts=\"" << count
            << "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n";
        describe(out, places_, offset);
        out << "</Points>\n<Verts>\n";
        describe(out, connectivity, offset);
        describe(out, offsets, offset);
        out << "</Verts>\n<PointData>\n";
        for (const array& one : values_) describe(out, one, offset);
        out << "</PointData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
        places_.put(out);
        connectivity.put(out);
        offsets.put(out);
        for (const array& one : values_) one.put(out);
        out << "\n</AppendedData>\n</VTKFile>\n";
    }

  private:
    struct array {
        std::string name, unit;
        int components = 1;
        std::vector<std::string> component_names;
        std::string_view type{};
        std::uint64_t bytes = 0;
        std::function<void(std::ostream&)> put{};
    };
    std::uint64_t count_;
    double time_;
    array places_;
    std::vector<array> values_;

    template <class Number> array made(array one, std::function<void(std::vector<Number>&)> put) const {
        const std::uint64_t numbers = count_ * static_cast<std::uint64_t>(one.components);
        const std::uint64_t bytes = numbers * sizeof(Number);
        one.type = vtk_type<Number>();
        one.bytes = bytes;
        one.put = [numbers, bytes, put = std::move(put)](std::ostream& out) {
            std::vector<Number> all;
            all.reserve(static_cast<std::size_t>(numbers));
            put(all);
            out.write(reinterpret_cast<const char*>(&bytes), sizeof bytes);
            out.write(reinterpret_cast<const char*>(all.data()), static_cast<std::streamsize>(bytes));
        };
        return one;
    }
    /// An array's entry; its numbers follow those of the entries before it.
    static void describe(std::ostream& out, const array& one, std::uint64_t& offset) {
        out << "<DataArray type=\"" << one.type << "\" Name=\"" << xml_text(one.name) << "\" NumberOfComponents=\""
            << one.components << '"';
        for (std::size_t c = 0; c < one.component_names.size(); ++c)
            out << " ComponentName" << c << "=\"" << xml_text(one.component_names[c]) << '"';
        out << " format=\"appended\" offset=\"" << offset << '"';
        if (one.unit.empty())
            out << "/>\n";
        else
            out << ">\n<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">" << xml_text(one.unit)
                << "</InformationKey>\n</DataArray>\n";
        offset += sizeof one.bytes + one.bytes;
    }
};

}  // namespace tamis::detail
