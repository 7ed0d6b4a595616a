// `tamis_report error` of the bar's scenes alone, which compiles in a fraction of the time: the demo's.
#include "error_command.hpp"

int main(int argc, char** argv) {
    CLI::App app("Report on the bar's scenes as an HTML page", "tamis_bar_report");
    app.require_subcommand(1);
    int exit_code = 0;
    add_error_command(app, exit_code, bar_report_scenes);
    CLI11_PARSE(app, argc, argv);
    return exit_code;
}
