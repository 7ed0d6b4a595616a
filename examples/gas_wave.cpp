// A gas in a tube: the right end is driven with v0 sin(10 t), the left one is fixed (Perez, ADMPM, 2021, section 7).
//     gas_wave --csv wave.csv && gnuplot -e "csv='wave.csv'; out='wave'" examples/plots/gas_wave.gp
#include "support/ranges.hpp"
#include "support/scene_program.hpp"
#include "support/gas_wave.hpp"

namespace {

void write_particles(const gas_wave_options& o, const gas_wave_result& r) {
    const gas_wave_exact exact{o.gamma, o.amplitude, o.drive == "smooth"};
    const double t = o.times.back();
    tamis::atomic_file file(o.csv);
    file.out() << "x,velocity,pressure,exact_velocity,exact_pressure\n";
    for (const gas_wave_particle& p : r.particles)
        file.out() << p.x << ',' << p.velocity << ',' << p.pressure << ',' << exact.velocity(p.x, t) << ','
                   << exact.pressure(p.x, t) << '\n';
    file.commit();
}

}  // namespace

int main(int argc, char** argv) {
    gas_wave_options o;
    CLI::App app{"A gas in a tube: the right end is driven with A sin(10 t), the left one is fixed."};
    app.option_defaults()->always_capture_default();
    app.add_option("--cells", o.cells, "Cells of the grid along the tube")->check(whole_from(1, 100000));
    app.add_option("--per-cell", o.per_cell, "Particles per cell")->check(whole_from(1, 100));
    add_composition(app, o);
    app.add_option("--particles", o.particles, "moving or held");
    app.add_option("--rate", o.rate, "Rate of pressure: motion (as particles move or not) or admpm (of a fixed point)");
    app.add_option("--drive", o.drive, "sine, or smooth: its cube, whose wave has no kink at its front");
    app.add_option("--gamma", o.gamma, "Exponent of the gas; c^2 = gamma")->check(number_from(1, 10));
    app.add_option("--amplitude", o.amplitude, "Velocity v0 of the driven end")->check(CLI::PositiveNumber);
    app.add_option("--courant", o.courant, "c dt/h, rounded down")->check(number_from(1e-6, 1));
    app.add_option("--time", o.times, "Times at which errors are measured, ascending; the last is the end");
    CLI11_PARSE(app, argc, argv);
    return run_program("gas_wave", [&] {
        const gas_wave_result r = run_gas_wave(o);
        put_summary(summary_of(o, r), o.summary);
        if (!o.csv.empty()) write_particles(o, r);
    });
}
