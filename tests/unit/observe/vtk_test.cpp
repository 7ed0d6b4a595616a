#include <tamis/tamis.hpp>

#include <bit>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <regex>

#include "catch.hpp"
#include "scratch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

struct temperature : scalar_field {
    static constexpr std::string_view name = "temperature";
    static constexpr std::string_view unit = "K";
};
struct out_of_plane : symmetric_3x3_field {
    static constexpr std::string_view name = "out_of_plane";
};
struct namesake : scalar_field {
    static constexpr std::string_view name = "body";
};
struct odd_name : scalar_field {
    static constexpr std::string_view name = "a<b & \"c\">d";
};
constexpr field::id id;
const linear_elastic law{.young = 1, .poisson = 0.2, .density = 1};
const linear_elastic bar_law{.young = 1, .density = 1};
const progress_state start{0, 1, 0, {0, 1}};

/// An array of a file, in bytes.
struct array {
    std::string type, unit;
    int components = 0;
    std::vector<std::string> names;
    std::string bytes;

    template <class Number> Number at(std::size_t point, int c = 0) const {
        Number value;
        const std::size_t k =
            (point * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)) * sizeof value;
        REQUIRE(k + sizeof value <= bytes.size());
        std::memcpy(&value, bytes.data() + k, sizeof value);
        return value;
    }
};
struct file {
    std::size_t points = 0;
    std::string time, head;
    std::map<std::string, array> arrays;
};

std::string attribute(const std::string& tag, const std::string& name) {
    std::smatch found;
    return std::regex_search(tag, found, std::regex(" " + name + "=\"([^\"]*)\"")) ? found[1].str() : "";
}
/// Reads a file as its header says, and checks that nothing is missing or left over.
file read(const std::filesystem::path& path) {
    const std::string text = text_of(path), mark = "<AppendedData encoding=\"raw\">\n_",
                      ending = "\n</AppendedData>\n</VTKFile>\n";
    const std::size_t begin = text.find(mark);
    REQUIRE(begin != std::string::npos);
    REQUIRE(text.size() > ending.size());
    REQUIRE(text.substr(text.size() - ending.size()) == ending);
    file all;
    all.head = text.substr(0, begin);
    const std::string data = text.substr(begin + mark.size(), text.size() - ending.size() - begin - mark.size());
    CHECK(attribute(all.head, "header_type") == "UInt64");
    CHECK(attribute(all.head, "byte_order") ==
          (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian"));
    all.points = std::stoul(attribute(all.head, "NumberOfPoints"));
    CHECK(std::stoul(attribute(all.head, "NumberOfVerts")) == all.points);
    std::smatch found;
    REQUIRE(std::regex_search(all.head, found, std::regex("Name=\"TimeValue\"[^>]*>([^<]*)<")));
    all.time = found[1].str();
    std::size_t next = 0;
    const std::regex tags("<DataArray[^>]*offset=\"[0-9]+\"(/>|>\\n<InformationKey[^>]*>([^<]*)<)");
    for (std::sregex_iterator at(all.head.begin(), all.head.end(), tags), end; at != end; ++at) {
        const std::string tag = at->str();
        array one{attribute(tag, "type"), (*at)[2].str(), std::stoi(attribute(tag, "NumberOfComponents")), {}, {}};
        for (int c = 0; !attribute(tag, "ComponentName" + std::to_string(c)).empty(); ++c)
            one.names.push_back(attribute(tag, "ComponentName" + std::to_string(c)));
        CHECK(std::stoul(attribute(tag, "offset")) == next);
        std::uint64_t bytes = 0;
        REQUIRE(next + sizeof bytes <= data.size());
        std::memcpy(&bytes, data.data() + next, sizeof bytes);
        REQUIRE(next + sizeof bytes + bytes <= data.size());
        const std::size_t size = one.type == "Float32" || one.type == "Int32" ? 4 : 8;
        CHECK(bytes == all.points * static_cast<std::size_t>(one.components) * size);
        one.bytes = data.substr(next + sizeof bytes, static_cast<std::size_t>(bytes));
        next += sizeof bytes + static_cast<std::size_t>(bytes);
        CHECK(all.arrays.emplace(attribute(tag, "Name"), one).second);
    }
    CHECK(next == data.size());
    return all;
}
/// The series' times and files, each of which must be there, whole.
std::vector<std::pair<std::string, std::string>> list_of_series(const std::filesystem::path& path) {
    const std::string text = text_of(path), ending = "</Collection>\n</VTKFile>\n";
    REQUIRE(text.size() > ending.size());
    CHECK(text.substr(text.size() - ending.size()) == ending);
    CHECK(attribute(text, "type") == "Collection");
    std::vector<std::pair<std::string, std::string>> all;
    const std::regex tags("<DataSet [^>]*/>");
    for (std::sregex_iterator at(text.begin(), text.end(), tags), end; at != end; ++at) {
        all.emplace_back(attribute(at->str(), "timestep"), attribute(at->str(), "file"));
        CHECK(read(path.parent_path() / all.back().second).time == all.back().first);
    }
    return all;
}
template <class Number> auto bits_of(const Number& value) {
    if constexpr (sizeof value == 4)
        return std::bit_cast<std::uint32_t>(value);
    else
        return std::bit_cast<std::uint64_t>(value);
}

struct short_run {
    solver<uniform_grid<1>, linear> mpm{uniform_grid{{0.}, {1.}, 0.25}, linear{}};
    decltype(mpm.make_body(bar_law, everywhere, per_cell{1})) bar = mpm.make_body(bar_law, everywhere, per_cell{1});
};

}  // namespace

TEST_CASE("vtk: every particle of every body is a vertex with its place and all that is stored") {
    const scratch_folder folder("vtk_all");
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.125}, quadratic_spline{}, flip{}};
    auto low = mpm.make_body(
        law, [](const auto& at) { return at[0] < 0.4; }, per_cell{2}, fields<field::id, temperature>{});
    auto high = mpm.make_body(
        law, [](const auto& at) { return at[0] > 0.6; }, per_cell{1}, fields<field::deformation>{});
    double k = 0;
    const double odd_nan = std::bit_cast<double>(std::uint64_t(0x7ff8000000abcdef));
    for (auto p : low) {
        k += 1;
        p[v] << 0.1 * k, -0.0;
        p[sigma] = (matrix<2, double>() << 0.3 * k, 0.7 * k, 0.7 * k, 0.9 * k).finished();
        p[temperature{}] = k == 3 ? odd_nan : k == 4 ? -std::numeric_limits<double>::infinity() : 300 / k;
    }
    for (auto p : high) {
        k += 1;
        p[F] << 0.1 * k, 0.2 * k, 0.3 * k, 0.4 * k;
    }
    vtk_output(mpm, bodies(low, high), folder / "both.pvd")(progress_state{7, 10, 0.1, {0, 1}});
    CHECK(folder.names() == std::vector<std::string>{"both.pvd", "both_000000000.vtp"});
    const file all = read(folder / "both_000000000.vtp");
    CHECK(all.time == "0.1");
    REQUIRE(all.points == low.size() + high.size());
    std::vector<std::string> names;
    for (const auto& [name, one] : all.arrays) names.push_back(name);
    CHECK(names == std::vector<std::string>{"Points", "body", "connectivity", "deformation", "id", "mass", "offsets",
                                            "stress", "temperature", "velocity", "volume"});
    const auto& arrays = all.arrays;
    for (const char* name : {"Points", "deformation", "mass", "stress", "temperature", "velocity", "volume"})
        CHECK(arrays.at(name).type == "Float64");
    for (const char* name : {"connectivity", "offsets", "id"}) CHECK(arrays.at(name).type == "Int64");
    CHECK(arrays.at("body").type == "Int32");
    CHECK(arrays.at("Points").components == 3);
    CHECK(arrays.at("velocity").components == 3);
    CHECK(arrays.at("stress").components == 6);
    CHECK(arrays.at("stress").names == std::vector<std::string>{"XX", "YY", "ZZ", "XY", "YZ", "XZ"});
    CHECK(arrays.at("deformation").components == 9);
    CHECK(arrays.at("mass").components == 1);
    CHECK(arrays.at("velocity").unit == "m/s");
    CHECK(arrays.at("volume").unit == "m^2");
    CHECK(arrays.at("temperature").unit == "K");

    std::size_t n = 0;
    const auto same = [&](const char* name, int c, double value) {
        CHECK(bits_of(arrays.at(name).at<double>(n, c)) == bits_of(value));
    };
    const auto check = [&](const auto& body, int number) {
        for (const auto p : body) {
            CAPTURE(n);
            CHECK(arrays.at("connectivity").at<std::int64_t>(n) == static_cast<std::int64_t>(n));
            CHECK(arrays.at("offsets").at<std::int64_t>(n) == static_cast<std::int64_t>(n + 1));
            CHECK(arrays.at("body").at<std::int32_t>(n) == number);
            for (int d = 0; d < 3; ++d) same("Points", d, d < 2 ? p[x][d] : 0);
            for (int d = 0; d < 3; ++d) same("velocity", d, d < 2 ? p[v][d] : 0);
            same("mass", 0, p[m]);
            same("volume", 0, p[V]);
            const double six[] = {p[sigma](0, 0), p[sigma](1, 1), 0, p[sigma](0, 1), 0, 0};
            for (int c = 0; c < 6; ++c) same("stress", c, six[c]);
            if constexpr (std::remove_cvref_t<decltype(body)>::has(F)) {
                const double nine[] = {p[F](0, 0), p[F](0, 1), 0, p[F](1, 0), p[F](1, 1), 0, 0, 0, 0};
                for (int c = 0; c < 9; ++c) same("deformation", c, nine[c]);
                CHECK(std::isnan(arrays.at("temperature").at<double>(n)));
                CHECK(arrays.at("id").at<std::int64_t>(n) == -1);
            } else {
                for (int c = 0; c < 9; ++c) CHECK(std::isnan(arrays.at("deformation").at<double>(n, c)));
                same("temperature", 0, p[temperature{}]);
                CHECK(arrays.at("id").at<std::int64_t>(n) == static_cast<std::int64_t>(p[id]));
            }
            ++n;
        }
    };
    check(std::as_const(low), 0);
    check(std::as_const(high), 1);
    CHECK(bits_of(arrays.at("temperature").at<double>(2)) == 0x7ff8000000abcdefu);
}

TEST_CASE("vtk: floats stay floats, in one dimension and in three") {
    const scratch_folder folder("vtk_float");
    solver line{uniform_grid{{0.f}, {1.f}, 0.125f}, linear{}, flip{}};
    auto bar = line.make_body(bar_law, everywhere, per_cell{1}, fields<field::deformation>{});
    float k = 0;
    for (auto p : bar) {
        k += 1;
        p[v][0] = k == 2 ? std::bit_cast<float>(0x7fc0beefu) : 0.1f * k;
        p[sigma](0, 0) = 0.7f * k;
        p[F](0, 0) = 0.3f * k;
    }
    vtk_output(line, bodies(bar), folder / "bar.pvd")(start);
    const file flat = read(folder / "bar_000000000.vtp");
    for (const char* name : {"Points", "deformation", "mass", "stress", "velocity", "volume"})
        CHECK(flat.arrays.at(name).type == "Float32");
    std::size_t n = 0;
    for (const auto p : std::as_const(bar)) {
        for (int c = 0; c < 9; ++c) {
            const auto same = [&](const char* name, int components, float value) {
                if (c < components)
                    CHECK(bits_of(flat.arrays.at(name).at<float>(n, c)) == bits_of(c == 0 ? value : 0.f));
            };
            same("Points", 3, p[x][0]);
            same("velocity", 3, p[v][0]);
            same("stress", 6, p[sigma](0, 0));
            same("deformation", 9, p[F](0, 0));
        }
        ++n;
    }
    CHECK(bits_of(flat.arrays.at("velocity").at<float>(1)) == 0x7fc0beefu);

    solver box{uniform_grid{{0.f, 0.f, 0.f}, {1.f, 1.f, 1.f}, 0.5f}, linear{}, flip{}, held{}};
    auto block = box.make_body(law, everywhere, per_cell{1}, fields<field::deformation>{});
    for (auto p : block) {
        p[sigma] = (matrix<3, float>() << 1, 4, 6, 4, 2, 5, 6, 5, 3).finished();
        p[F] << 1, 2, 3, 4, 5, 6, 7, 8, 9;
    }
    vtk_output(box, bodies(block), folder / "block.pvd")(start);
    const file full = read(folder / "block_000000000.vtp");
    CHECK(full.arrays.count("weights") == 0);
    n = 0;
    for (const auto p : std::as_const(block)) {
        for (int d = 0; d < 3; ++d) CHECK(full.arrays.at("Points").at<float>(n, d) == p[x][d]);
        for (int c = 0; c < 6; ++c) CHECK(full.arrays.at("stress").at<float>(n, c) == static_cast<float>(c + 1));
        for (int c = 0; c < 9; ++c) CHECK(full.arrays.at("deformation").at<float>(n, c) == static_cast<float>(c + 1));
        ++n;
    }
    CHECK(n == 8);
}

TEST_CASE("vtk: symmetric tensors with a part out of the plane keep it") {
    const scratch_folder folder("vtk_out_of_plane");
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.5}, linear{}, flip{}};
    auto block = mpm.make_body(law, everywhere, per_cell{1}, fields<out_of_plane>{});
    for (auto p : block) p[out_of_plane{}] = (matrix<3, double>() << 1, 4, 0, 4, 2, 0, 0, 0, 3).finished();
    vtk_output(mpm, bodies(block), folder / "block.pvd")(start);
    const file all = read(folder / "block_000000000.vtp");
    REQUIRE(all.points == 4);
    CHECK(all.arrays.at("out_of_plane").components == 6);
    for (std::size_t n = 0; n < 4; ++n)
        for (int c = 0; c < 6; ++c) CHECK(all.arrays.at("out_of_plane").at<double>(n, c) == (c < 4 ? c + 1 : 0));
}

TEST_CASE("vtk: fields are chosen, names are made one's own, and a const body will do") {
    const scratch_folder folder("vtk_chosen");
    short_run run;
    const auto bar = run.mpm.make_body(bar_law, everywhere, per_cell{1}, fields<namesake, odd_name, field::id>{});
    vtk_output(run.mpm, bodies(bar), folder / "some.pvd", fields<field::velocity, const namesake, odd_name>{})(start);
    const auto arrays = read(folder / "some_000000000.vtp").arrays;
    std::vector<std::string> names;
    for (const auto& [name, one] : arrays) names.push_back(name);
    CHECK(names == std::vector<std::string>{"Points", "a&lt;b &amp; &quot;c&quot;&gt;d", "body", "body_2",
                                            "connectivity", "offsets", "velocity"});
    CHECK(arrays.at("body").type == "Int32");
    CHECK(arrays.at("body_2").type == "Float64");
}

TEST_CASE("vtk: the series is whole after every frame, by an observer that is given by value") {
    const scratch_folder folder("vtk_series");
    short_run run;
    std::size_t looked = 0;
    const auto look = [&](const progress_state& now) {
        const auto list = list_of_series(folder / "below/bar.pvd");
        CHECK(list.size() == static_cast<std::size_t>(now.step / 5 + 1));
        CHECK(list.back().second == "bar_00000000" + std::to_string(now.step / 5) + ".vtp");
        ++looked;
    };
    integrate(run.mpm, bodies(run.bar), {0, 1}, fixed_steps{20},
              every(5, vtk_output{run.mpm, bodies(run.bar), folder / "below/bar.pvd"}), look);
    CHECK(looked == 21);
    const auto list = list_of_series(folder / "below/bar.pvd");
    REQUIRE(list.size() == 5);
    CHECK(list[0].first == "0");
    CHECK(list[1].first == "0.25");
    CHECK(list[4].first == "1");
    for (const auto& entry : std::filesystem::directory_iterator(folder / "below"))
        CHECK(entry.path().extension() != ".part");
}

TEST_CASE("vtk: a run that goes on adds to its series, one that begins anew replaces it, and nothing else") {
    const scratch_folder folder("vtk_again");
    for (const char* name : {"bar_000000777.vtp", "bar_12.vtp", "bar_00000077x.vtp", "other_000000777.vtp", "bar.txt"})
        std::ofstream(folder / name) << "old";
    short_run run;
    vtk_output frames(run.mpm, bodies(run.bar), folder / "bar.pvd");
    CHECK(text_of(folder / "bar_000000777.vtp") == "old");
    const auto other = frames;
    integrate(run.mpm, bodies(run.bar), {0, 0.5}, fixed_steps{4}, every(2, frames));
    integrate(run.mpm, bodies(run.bar), {0.5, 1}, fixed_steps{4}, every(2, std::ref(other)));
    auto list = list_of_series(folder / "bar.pvd");
    REQUIRE(list.size() == 5);
    for (std::size_t k = 0; k < 5; ++k) CHECK(std::stod(list[k].first) == 0.25 * double(k));
    CHECK(folder.names() == std::vector<std::string>{"bar.pvd", "bar.txt", "bar_000000000.vtp", "bar_000000001.vtp",
                                                     "bar_000000002.vtp", "bar_000000003.vtp", "bar_000000004.vtp",
                                                     "bar_00000077x.vtp", "bar_12.vtp", "other_000000777.vtp"});
    integrate(run.mpm, bodies(run.bar), {0.125, 0.25}, fixed_steps{1}, frames);
    list = list_of_series(folder / "bar.pvd");
    REQUIRE(list.size() == 3);
    CHECK(list[1].first == "0.125");
    CHECK_FALSE(std::filesystem::exists(folder / "bar_000000003.vtp"));
    vtk_output(run.mpm, bodies(run.bar), folder / "bar.pvd")(start);
    CHECK(list_of_series(folder / "bar.pvd").size() == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "bar_000000001.vtp"));
}

TEST_CASE("vtk: a body that lost all its particles is a file without points") {
    const scratch_folder folder("vtk_empty");
    solver mpm{uniform_grid{{0.}, {1.}, 0.25}, linear{}, leaving_removes{}};
    auto bar = mpm.make_body(
        bar_law, [](const auto& at) { return at[0] > 0.7; }, per_cell{1});
    for (auto p : bar) p[v][0] = 1;
    for (int k = 0; k < 40; ++k) mpm.step(bodies(bar), 0.01);
    REQUIRE(bar.size() == 0);
    vtk_output(mpm, bodies(bar), folder / "bar.pvd")(start);
    CHECK(read(folder / "bar_000000000.vtp").points == 0);
}

TEST_CASE("vtk: what cannot be written is refused by a sentence, and leaves the series as it was") {
    const scratch_folder folder("vtk_refused");
    std::ofstream(folder / "file") << "";
    short_run run;
    const auto made = [&](const std::filesystem::path& path) {
        return complaint([&] { vtk_output(run.mpm, bodies(run.bar), path); });
    };
    CHECK(names(made(folder / "bar.vtp"), "vtk_output", "bar.vtp", "ends in .pvd"));
    CHECK(names(made(folder / "bar"), "ends in .pvd"));
    CHECK(names(made(folder / ".pvd"), "ends in .pvd"));
    CHECK(names(made(folder / "file/bar.pvd"), "cannot write"));
    CHECK(folder.names() == std::vector<std::string>{"file"});

    std::filesystem::create_directory(folder / "bar_000000001.vtp");
    vtk_output frames(run.mpm, bodies(run.bar), folder / "bar.pvd");
    frames(start);
    CHECK(names(complaint([&] { frames(progress_state{1, 2, 0.5, {0, 1}}); }), "bar_000000001.vtp", "folder"));
    CHECK(list_of_series(folder / "bar.pvd").size() == 1);
    std::filesystem::remove(folder / "bar_000000001.vtp");
    frames(progress_state{2, 2, 1, {0, 1}});
    CHECK(list_of_series(folder / "bar.pvd").size() == 2);
    CHECK(folder.names() == std::vector<std::string>{"bar.pvd", "bar_000000000.vtp", "bar_000000001.vtp", "file"});
}
