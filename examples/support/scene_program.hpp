#pragma once
#include "ranges.hpp"
#include "require.hpp"

#include <tamis/observe/atomic_file.hpp>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <string>

/// Prints a scene's numbers and writes them to a file, if one is named.
inline void put_summary(const std::string& text, const std::string& path) {
    std::fputs(text.c_str(), stdout);
    if (path.empty()) return;
    tamis::atomic_file file(path);
    file.out() << text;
    file.commit();
}

/// Runs a program's body; what it throws is said in one line, and the code is 1, or 2 for an option.
template <class F> int run_program(const char* name, F f) {
    try {
        f();
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s: %s\n", name, e.what());
        return dynamic_cast<const unusable_option*>(&e) ? 2 : 1;
    }
}

/// Options that all these scenes share.
template <class Options> void add_composition(CLI::App& app, Options& o) {
    app.add_option("--shape", o.shape, "Shape functions: linear, quadratic, ...");
    app.add_option("--update", o.update, "Particle update: pic, flip, blend, xpic or fmpm");
    app.add_option("--order", o.order, "Terms k of xpic and fmpm")->check(whole_from(1, 1000));
    app.add_option("--alpha", o.alpha, "Share of FLIP in a blend, 0 to 1")->check(number_from(0, 1));
    app.add_option("--stress", o.stress, "When the particles are strained: usf, usl-, usl+, usavg-, ...");
    app.add_option("--csv", o.csv, "File for the particles at the end and the exact answer");
    app.add_option("--summary", o.summary, "File for the results, JSON");
}
