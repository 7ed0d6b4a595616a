#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// A report as one HTML file that needs no other: text, tables, and figures as SVG inside it. Text is plain; what
/// stands between two backquotes is set as code. Everything is put down in the order of the calls.
///
///     page report("Error against run time");
///     report.heading("Standing wave").paragraph("A bar rings, see `standing_wave --help`.");
///     report.figures({{svg_by_gnuplot(script), "What the lines are."}});
///     report.table({{"update", "error"}, {{"FLIP", "1e-3"}}, "Caption."});
///     report.write("out/report.html");
class page {
  public:
    struct table_of {
        std::vector<std::string> columns;
        std::vector<std::vector<std::string>> rows;
        std::string caption;
        /// Columns from this one on hold numbers, and are set to the right.
        std::size_t numbers_from = 1;
        /// Rows to mark, by index.
        std::vector<std::size_t> marked = {};
    };
    struct figure_of {
        std::string svg, caption;
    };

    explicit page(std::string title) : title_(std::move(title)) {}

    /// Level 2 begins a section, which the list of contents at the top leads to; 3 is below it.
    page& heading(const std::string& text, int level = 2);
    page& paragraph(const std::string& text);
    /// A short list of points.
    page& list(const std::vector<std::string>& points);
    /// Names and what they are, as two columns.
    page& facts(const std::vector<std::vector<std::string>>& names_and_values);
    /// Wide tables are moved sideways in their own frame. Throws `tamis::error` if a row has not as many cells as there
    /// are columns.
    page& table(const table_of& table);
    /// Side by side where there is room, else below each other.
    page& figures(const std::vector<figure_of>& figures);

    std::string text() const;
    /// The file appears whole or not at all. Throws `tamis::error` if it cannot be written.
    void write(const std::filesystem::path& path) const;

  private:
    std::string title_, contents_, body_;
    int sections_ = 0, figures_ = 0;
};

/// The picture that a gnuplot script draws. Terminal and output are set already, with text of 15: at this size it can
/// still be read on a page 400 pixels wide. Throws `tamis::error` with gnuplot's words if it fails, or is not
/// installed.
struct picture_size {
    int width = 540, height = 430;
};
std::string svg_by_gnuplot(const std::string& script, picture_size size = {});
/// Is there a gnuplot to draw with?
bool has_gnuplot();
