#include "page.hpp"

#include <tamis/core/error.hpp>
#include <tamis/observe/atomic_file.hpp>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace {

const char* const style = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: #1a1a1a; font: 16px/1.5 system-ui, sans-serif; overflow-wrap: break-word; }
main { max-width: 1240px; margin: 0 auto; padding: 1rem; }
h1 { font-size: 1.8rem; line-height: 1.2; margin: 0.5rem 0 1rem; }
h2 { font-size: 1.35rem; margin: 2.5rem 0 0.75rem; padding-top: 0.75rem; border-top: 1px solid #c8c8c8; }
h3 { font-size: 1.1rem; margin: 1.5rem 0 0.5rem; }
p, ul { max-width: 52rem; margin: 0.6rem 0; }
ul { padding-left: 1.3rem; }
a { color: #0a4f8a; }
code { font: 0.9em ui-monospace, monospace; background: #f2f2f2; padding: 0 0.2em; overflow-wrap: anywhere; }
nav ul { columns: 16rem; }
.frame { overflow-x: auto; margin: 0.3rem 0 1rem; }
table { border-collapse: collapse; font-size: 0.9rem; }
.caption { margin: 1rem 0 0; font-size: 0.9rem; }
th, td { padding: 0.2rem 0.6rem; border-bottom: 1px solid #d8d8d8; text-align: left; vertical-align: top; }
th { border-bottom: 2px solid #707070; vertical-align: bottom; }
td, th { white-space: nowrap; }
.number { text-align: right; font-variant-numeric: tabular-nums; }
.marked td { background: #fff3d6; }
.facts td { white-space: normal; overflow-wrap: anywhere; }
.facts td:first-child { color: #505050; padding-left: 0; min-width: 6rem; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 34rem), 1fr)); gap: 1rem 2rem; }
figure { margin: 0.5rem 0; min-width: 0; }
figure svg { display: block; font-family: sans-serif; width: 100%; max-width: 46rem; height: auto; }
figcaption { font-size: 0.9rem; color: #333; max-width: 46rem; margin-top: 0.3rem; }
@media (max-width: 600px) { main { padding: 0.75rem; } th, td { padding: 0.2rem 0.4rem; } }
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

/// Text for HTML; between backquotes it is code.
std::string marked_up(const std::string& text) {
    std::string html;
    bool in_code = false;
    for (const char c : text) {
        if (c == '&')
            html += "&amp;";
        else if (c == '<')
            html += "&lt;";
        else if (c == '>')
            html += "&gt;";
        else if (c == '"')
            html += "&quot;";
        else if (c == '`') {
            html += in_code ? "</code>" : "<code>";
            in_code = !in_code;
        } else
            html += c;
    }
    if (in_code) throw tamis::error("page: a text has an odd number of backquotes: " + text);
    return html;
}

/// One digit after the point is enough for places, but not for what a picture says.
std::string with_short_numbers(const std::string& svg) {
    static const std::regex tag("<[^>]*>"), digits("(\\.[0-9])[0-9]+");
    std::string all;
    auto from = svg.cbegin();
    for (std::sregex_iterator at(svg.begin(), svg.end(), tag), end; at != end; ++at) {
        all.append(from, (*at)[0].first);
        all += std::regex_replace((*at).str(), digits, "$1");
        from = (*at)[0].second;
    }
    return all.append(from, svg.cend());
}

std::string without(const std::string& text, const char* pattern) {
    return std::regex_replace(text, std::regex(pattern), "");
}
/// Colours as #rrggbb.
std::string short_colours(const std::string& svg) {
    static const std::regex colour("rgb\\( ?([0-9]+), ?([0-9]+), ?([0-9]+)\\)");
    std::string all;
    auto from = svg.cbegin();
    for (std::sregex_iterator at(svg.begin(), svg.end(), colour), end; at != end; ++at) {
        char hex[8];
        std::snprintf(hex, sizeof hex, "#%02x%02x%02x", std::stoi((*at)[1]) & 255, std::stoi((*at)[2]) & 255,
                      std::stoi((*at)[3]) & 255);
        all.append(from, (*at)[0].first) += hex;
        from = (*at)[0].second;
    }
    return all.append(from, svg.cend());
}
/// Without definitions of marks that nothing uses.
std::string without_unused_marks(const std::string& svg) {
    static const std::regex mark("<(path|rect|circle|use)[^>]*id='(gp[A-Za-z0-9]+)'[^>]*/>");
    std::string kept;
    auto from = svg.cbegin();
    for (std::sregex_iterator at(svg.begin(), svg.end(), mark), end; at != end; ++at) {
        kept.append(from, (*at)[0].first);
        if (svg.find("#" + (*at)[2].str() + "'") != std::string::npos) kept.append((*at)[0].first, (*at)[0].second);
        from = (*at)[0].second;
    }
    return kept.append(from, svg.cend());
}
/// gnuplot's SVG in a third of its bytes: coordinates to a tenth of a pixel, nothing that is empty, unused, or said
/// though it is the default.
std::string shortened(std::string svg) {
    svg = with_short_numbers(svg);
    svg = std::regex_replace(svg, std::regex(">\\s+<"), "><");
    svg = std::regex_replace(svg, std::regex("\\s+"), " ");
    svg = without(
        svg, " stroke-linecap=\"butt\"| stroke-linejoin=\"miter\"| font-family=\"sans-serif\"| class=\"gridline\"");
    svg = without(svg, "<filter .*?</filter>");
    svg = std::regex_replace(short_colours(svg), std::regex("xlink:href"), "href");
    for (std::string before; before != svg;) {
        before = svg;
        svg = without_unused_marks(without(svg, "<g[^>]*></g>|<tspan[^>]*></tspan>"));
    }
    return svg;
}

/// A picture for the inside of a page: without the XML head, and with names that no other picture has.
std::string inlined(const std::string& svg, int number, const std::string& says) {
    const std::size_t begin = svg.find("<svg"), end = svg.rfind("</svg>");
    if (begin == std::string::npos || end == std::string::npos)
        throw tamis::error("page: a figure is no SVG picture: it has no <svg>...</svg>");
    std::string inner = shortened(svg.substr(begin, end + 6 - begin));
    const std::string prefix = "f" + std::to_string(number) + "_";
    for (const std::string start : {" id='", " id=\"", "href='#", "href=\"#", "url(#"})
        inner = replaced(inner, start, start + prefix);
    return replaced(inner, "<svg", "<svg role=\"img\" aria-label=\"" + marked_up(replaced(says, "`", "")) + "\"");
}

std::string content_of(const std::filesystem::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A folder for the files of one call; it goes when the call ends.
class passing_folder {
  public:
    passing_folder() {
        std::string name = (std::filesystem::temp_directory_path() / "tamis_report_XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw tamis::error("page: no folder could be made in " + std::filesystem::temp_directory_path().string() +
                               "; see that it may be written to, or set TMPDIR");
        path = name;
    }
    passing_folder(const passing_folder&) = delete;
    ~passing_folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    std::filesystem::path path;
};

}  // namespace

page& page::heading(const std::string& text, int level) {
    const std::string tag = "h" + std::to_string(level), html = marked_up(text);
    if (level == 2) {
        const std::string id = "section-" + std::to_string(++sections_);
        contents_ += "<li><a href=\"#" + id + "\">" + html + "</a></li>\n";
        body_ += "<h2 id=\"" + id + "\">" + html + "</h2>\n";
    } else
        body_ += "<" + tag + ">" + html + "</" + tag + ">\n";
    return *this;
}

page& page::paragraph(const std::string& text) {
    body_ += "<p>" + marked_up(text) + "</p>\n";
    return *this;
}

page& page::list(const std::vector<std::string>& points) {
    body_ += "<ul>\n";
    for (const std::string& point : points) body_ += "<li>" + marked_up(point) + "</li>\n";
    body_ += "</ul>\n";
    return *this;
}

page& page::facts(const std::vector<std::vector<std::string>>& names_and_values) {
    body_ += "<table class=\"facts\">\n";
    for (const auto& row : names_and_values)
        body_ += "<tr><td>" + marked_up(row.at(0)) + "</td><td>" + marked_up(row.at(1)) + "</td></tr>\n";
    body_ += "</table>\n";
    return *this;
}

page& page::table(const table_of& table) {
    const auto cell = [&](const char* tag, std::size_t column, const std::string& text) {
        const std::string name = tag;
        return "<" + name + (column >= table.numbers_from ? " class=\"number\">" : ">") + marked_up(text) + "</" +
               name + ">";
    };
    std::string html;
    if (!table.caption.empty()) html += "<p class=\"caption\">" + marked_up(table.caption) + "</p>\n";
    html += "<div class=\"frame\"><table>\n<thead><tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c) html += cell("th", c, table.columns[c]);
    html += "</tr></thead>\n<tbody>\n";
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        if (table.rows[r].size() != table.columns.size())
            throw tamis::error(tamis::detail::sentence("page: row ", r, " of a table has ", table.rows[r].size(),
                                                       " cells for ", table.columns.size(), " columns"));
        bool marked = false;
        for (const std::size_t m : table.marked) marked = marked || m == r;
        html += marked ? "<tr class=\"marked\">" : "<tr>";
        for (std::size_t c = 0; c < table.columns.size(); ++c) html += cell("td", c, table.rows[r][c]);
        html += "</tr>\n";
    }
    body_ += html + "</tbody></table></div>\n";
    return *this;
}

page& page::figures(const std::vector<figure_of>& figures) {
    body_ += "<div class=\"figures\">\n";
    for (const figure_of& one : figures)
        body_ += "<figure>" + inlined(one.svg, ++figures_, one.caption) + "\n<figcaption>" + marked_up(one.caption) +
                 "</figcaption></figure>\n";
    body_ += "</div>\n";
    return *this;
}

std::string page::text() const {
    const std::string title = marked_up(title_);
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
           "<link rel=\"icon\" href=\"data:,\">\n<title>" +
           title + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n<main>\n<h1>" + title + "</h1>\n" +
           (sections_ > 1 ? "<nav><ul>\n" + contents_ + "</ul></nav>\n" : "") + body_ + "</main>\n</body>\n</html>\n";
}

void page::write(const std::filesystem::path& path) const {
    tamis::atomic_file file(path);
    file.out() << text();
    file.commit();
}

bool has_gnuplot() { return std::system("gnuplot --version > /dev/null 2>&1") == 0; }

std::string svg_by_gnuplot(const std::string& script, picture_size size) {
    const passing_folder folder;
    const auto file = folder.path / "plot.gp", out = folder.path / "plot.svg", words = folder.path / "words";
    std::ofstream(file) << "set terminal svg size " << size.width << ',' << size.height
                        << " dynamic font \"sans-serif,15\"\nset output \"" << out.string() << "\"\n"
                        << script << "\nunset output\n";
    const std::string command = "gnuplot \"" + file.string() + "\" > \"" + words.string() + "\" 2>&1";
    if (std::system(command.c_str()) != 0) {
        if (!has_gnuplot())
            throw tamis::error(
                "gnuplot draws the pictures of a report and is not installed; install it (Debian, Ubuntu: "
                "gnuplot-nox)");
        throw tamis::error("gnuplot could not draw a picture of the report: " + content_of(words));
    }
    return content_of(out);
}
