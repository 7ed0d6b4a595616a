// Reports of what the library can do, each by one command: `tamis_report error --out DIR`, `tamis_report --help`.
#include "error_command.hpp"
#include "stability_command.hpp"

int main(int argc, char** argv) {
    CLI::App app("Reports on Tamis as HTML pages", "tamis_report");
    app.require_subcommand(1);
    int exit_code = 0;
    add_error_command(app, exit_code, report_scenes);
    add_stability_command(app, exit_code);
    CLI11_PARSE(app, argc, argv);
    return exit_code;
}
