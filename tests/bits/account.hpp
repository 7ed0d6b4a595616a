#pragma once
#include <array>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bits {

/// The file of one composition. Each line says what is told, of which one, and its numbers, as hexadecimal floats:
///
///     body0.velocity 17 0x1.9p-3 -0x1.4p-4
class account {
  public:
    explicit account(const std::string& path);
    ~account();
    account(const account&) = delete;
    account& operator=(const account&) = delete;

    /// A line of `owner` and `what` ("body0.", "velocity"), of one of many or of a node.
    void line(std::string_view owner, std::string_view what, long which, std::span<const double> numbers);
    void line(std::string_view owner, std::string_view what, const std::array<int, 3>& node,
              std::span<const double> numbers);
    /// A line of one number.
    void tell(std::string_view what, double value);
    /// Something that keeps a run from showing what it is there to show: it makes the program fail.
    void complain(const std::string& sentence);

    /// Closes the file; throws if it could not be written.
    void close();
    const std::vector<std::string>& complaints() const { return complaints_; }
    /// What the table on standard output says of a run.
    std::string remark;

  private:
    std::string path_;
    std::FILE* file_;
    std::vector<std::string> complaints_;
    bool finite_ = true;

    void begin(std::string_view owner, std::string_view what);
    void put(std::span<const double> numbers);
};

/// A composition by the name of its file, listed by being made: `const bits::composition here{"name", run};`.
struct composition {
    using run_type = void (*)(account&);
    composition(const char* name, run_type run);
    static std::vector<composition>& all();
    const char* name;
    run_type run;
};

}  // namespace bits
