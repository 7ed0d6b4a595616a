// The tables of docs/open-questions.md, as markdown. Bars of length, density and stiffness 1, so that c = 1; errors are
// relative to the amplitude of the exact answer.
#include <tamis/tamis.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace tamis;
using namespace tamis::symbols;
using place = point<1, double>;

constexpr double pi = std::numbers::pi, amplitude = 0.01, omega = 10;
const linear_elastic law{.young = 1, .poisson = 0, .density = 1};

// Markdown.

std::string number(double value, const char* format = "%.1e") {
    if (!std::isfinite(value)) return "unstable";
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}
void row(const std::string& name, const std::vector<std::string>& cells) {
    std::printf("| %s |", name.c_str());
    for (const auto& cell : cells) std::printf(" %s |", cell.c_str());
    std::puts("");
}
void heading(const char* title, const std::string& name, const std::vector<std::string>& columns) {
    std::printf("\n%s\n\n", title);
    row(name, columns);
    row("---", std::vector<std::string>(columns.size(), "---"));
}
template <class Values> std::vector<std::string> columns_of(const char* before, const Values& values) {
    std::vector<std::string> names;
    for (const auto value : values) names.push_back(before + std::to_string(value));
    return names;
}

// The scenes of section 10 of the method.

/// Both ends at rest; or the right one at v0 sin(omega t).
struct ends {
    bool driven;
    bool holds(const auto& at) const { return at[0] <= 0 || at[0] >= 1; }
    template <class Point> Point velocity(const Point& at, auto t) const {
        return Point::Constant(driven && at[0] > 0 ? amplitude * std::sin(omega * t) : 0.0);
    }
};
struct state {
    double velocity, strain;
};
state standing_wave(double at, double t) {
    return {amplitude * std::sin(pi * at) * std::cos(pi * t), amplitude * std::cos(pi * at) * std::sin(pi * t)};
}
/// Up to t = 2.
state driven_bar(double at, double t) {
    const auto g = [](double s) { return s > 0 ? amplitude * std::sin(omega * s) : 0; };
    return {g(t - 1 + at) - g(t - 1 - at), g(t - 1 + at) + g(t - 1 - at)};
}
double driven_energy(double t) { return amplitude * amplitude * (t / 2 - std::sin(2 * omega * t) / (4 * omega)); }
template <class Body> double energy_of(const Body& body) { return kinetic_energy(body) + elastic_energy(body); }

/// Root mean squares over the particles, over the amplitude; energy over the exact one, less 1.
struct errors {
    double velocity = INFINITY, strain = INFINITY, energy = INFINITY, wall = INFINITY;
};
struct bar_run {
    bool driven;
    int cells;
    double end, courant_number = 0.1;
};

/// By how much the velocity at the ends misses what they are held at: linear functions and two particles per cell, so
/// that FMPM's V' = S v continues linearly to the wall.
template <class Body> double wall_miss(const Body& bar, const ends& held, double t) {
    std::vector<std::array<double, 2>> all;
    for (const auto p : bar) all.push_back({p[x][0], p[v][0]});
    std::sort(all.begin(), all.end());
    const auto miss = [&](std::size_t last, std::size_t beside, double wall) {
        const double slope = (all[last][1] - all[beside][1]) / (all[last][0] - all[beside][0]);
        return std::abs(all[last][1] + slope * (wall - all[last][0]) - held.velocity(place(wall), t)[0]);
    };
    return std::max(miss(0, 1, 0), miss(all.size() - 1, all.size() - 2, 1)) / amplitude;
}

template <class Motion, class... Policy> errors bar_errors(const bar_run& run, const Policy&... policies) {
    const ends held_ends{run.driven};
    const double h = 1. / run.cells, dt = h * run.courant_number;
    solver mpm{uniform_grid{{0.}, {1.}, h}, linear{}, usl_minus{}, held_ends, Motion{}, policies...};
    auto bar = mpm.make_body(law, everywhere, per_cell{2}, fields<field::strain>{});
    if (!run.driven) set_velocity_of(bar, [](const auto& at) { return amplitude * std::sin(pi * at[0]); });
    const double start = energy_of(bar), most = 10 * std::max(start, driven_energy(2));
    errors out;
    double wall = 0;
    try {
        for (const int steps = static_cast<int>(std::lround(run.end / dt)); mpm.steps() < steps;) {
            mpm.step(bodies(bar), dt);
            if (!Motion::moves) wall = std::max(wall, wall_miss(bar, held_ends, mpm.time()));
            if (!(kinetic_energy(bar) < most)) return out;
        }
    } catch (const error&) {
        return out;
    }
    double velocity = 0, strain = 0;
    for (const auto p : std::as_const(bar)) {
        const auto exact = run.driven ? driven_bar(p[x][0], mpm.time()) : standing_wave(p[x][0], mpm.time());
        velocity += std::pow(p[v][0] - exact.velocity, 2);
        strain += std::pow(p[epsilon](0, 0) - exact.strain, 2);
    }
    const double count = static_cast<double>(bar.size()) * amplitude * amplitude;
    out.velocity = std::sqrt(velocity / count);
    out.strain = std::sqrt(strain / count);
    out.energy = energy_of(bar) / (run.driven ? driven_energy(mpm.time()) : start) - 1;
    out.wall = wall;
    return out;
}

// 2.4: boundary methods.

template <class Motion> struct boundary_tables {
    static constexpr std::array<int, 5> orders{1, 2, 4, 8, 16};
    std::vector<std::string> names;
    std::vector<std::array<errors, 5>> rows;

    template <class Method> void add(const bar_run& run, Method method) {
        names.emplace_back(Method::name);
        std::array<errors, 5> all;
        for (std::size_t k = 0; k < orders.size(); ++k)
            all[k] = bar_errors<Motion>(run, fmpm<dynamic>{orders[k]}, method);
        rows.push_back(all);
    }
    void print(const std::string& scene, const char* what, double errors::*value) const {
        heading((scene + ", " + what).c_str(), "method", columns_of("k = ", orders));
        for (std::size_t r = 0; r < rows.size(); ++r) {
            std::vector<std::string> cells;
            for (const auto& e : rows[r]) cells.push_back(number(e.*value));
            row(names[r], cells);
        }
    }
};
template <class Motion> void boundary_methods(const std::string& scene, const bar_run& run) {
    boundary_tables<Motion> tables;
    tables.add(run, boundary_method::incremental{});
    tables.add(run, boundary_method::lumped{});
    tables.add(run, boundary_method::velocity{});
    tables.add(run, boundary_method::combined{});
    tables.add(run, boundary_method::unlumped1{});
    tables.add(run, boundary_method::unlumped2{});
    tables.add(run, boundary_method::partial{});
    tables.add(run, boundary_method::collected{});
    tables.print(scene, "velocity", &errors::velocity);
    tables.print(scene, "strain", &errors::strain);
    tables.print(scene, "energy", &errors::energy);
    if (!Motion::moves) tables.print(scene, "largest miss at a held node", &errors::wall);
}

// 1.5: positions and velocities.

/// FLIP's velocity, moved by the mean of V and V'.
struct add_acceleration_move_by_mean : add_acceleration {
    using to_move = fields<>;
    auto displacement(const auto& before, const auto& after, auto, auto dt) const {
        return ((before + after) * (dt / 2)).eval();
    }
};
struct pair_errors {
    double lagrangian, position, velocity;
};
/// The standing wave to t = 1/2, where it is farthest out; `noise`: what no node sees, in the initial velocity.
template <class Order, class Scheme>
pair_errors position_run(const Scheme& scheme, double courant_number, double noise) {
    const double h = 0.02, dt = h * courant_number, size = 0.01 * amplitude;
    solver mpm{uniform_grid{{0.}, {1.}, h}, linear{}, ends{false}, scheme, Order{}};
    auto bar = mpm.make_body(law, everywhere, per_cell{2});
    for (auto p : bar) {
        const double cell = p[x][0] / h;
        p[v][0] = size * (std::sin(pi * p[x][0]) + (cell - std::floor(cell) < 0.5 ? noise : -noise));
    }
    // Particles stay in their cells, and so in their order.
    const auto copy = [&] {
        std::vector<std::array<double, 2>> all;
        for (const auto p : std::as_const(bar)) all.push_back({p[x][0], p[v][0]});
        return all;
    };
    const auto first = copy();
    auto before = first;
    const int steps = static_cast<int>(std::lround(0.5 / dt));
    const auto square = [](double a) { return a * a; };
    double sum = 0;
    for (int n = 0; n < steps; ++n) {
        mpm.step(bodies(bar), dt);
        const auto after = copy();
        for (std::size_t k = 0; k < after.size(); ++k)
            sum += square((after[k][0] - before[k][0]) / dt - (after[k][1] + before[k][1]) / 2);
        before = after;
    }
    if (mpm.crossings() > 0) std::puts("particles left their cells: V_bar - V is wrong");
    double way = 0, speed = 0;
    for (std::size_t k = 0; k < first.size(); ++k) {
        way += square(before[k][0] - first[k][0] - size / pi * std::sin(pi * first[k][0]));
        speed += square(before[k][1]);
    }
    const double count = static_cast<double>(first.size());
    return {std::sqrt(sum / (steps * count)) / size, std::sqrt(way / count) * pi / size,
            std::sqrt(speed / count) / size};
}
/// (X - g t^2/2)/(g dt t/2) after a fall.
template <class Scheme> double fall_lead(const Scheme& scheme) {
    const double dt = 0.01, g = 0.5;
    solver mpm{uniform_grid{{0.}, {2.}, 0.1}, linear{}, scheme, usl_minus{}, gravity{place(g)}};
    auto block = mpm.make_body(
        law, [](const auto& at) { return at[0] > 0.2 && at[0] < 0.8; }, per_cell{2});
    const double home = mean(block, x)[0];
    for (int n = 0; n < 100; ++n) mpm.step(bodies(block), dt);
    const double t = 100 * dt;
    return (mean(block, x)[0] - home - g * t * t / 2) / (g * dt * t / 2);
}
template <class Order, class Scheme> void position_row(const std::string& name, const Scheme& scheme) {
    std::vector<std::string> cells;
    for (const double courant_number : {0.1, 0.01}) {
        const auto e = position_run<Order>(scheme, courant_number, 0);
        for (const double value : {e.lagrangian, e.position, e.velocity}) cells.push_back(number(value));
    }
    const auto noisy = position_run<Order>(scheme, 0.1, 0.1);
    for (const double value : {noisy.lagrangian, noisy.position}) cells.push_back(number(value));
    cells.push_back(number(fall_lead(scheme), "%+.2f"));
    row(name, cells);
}
template <class Order> void positions() {
    heading(
        (std::string(Order::name) + ": Courant number 0.1, 0.01, and 0.1 with noise").c_str(), "update",
        {"V_bar - V", "position", "velocity", "V_bar - V", "position", "velocity", "V_bar - V", "position", "fall"});
    position_row<Order>("FLIP", flip{});
    position_row<Order>("FLIP(psi = 1)", modified_flip{1});
    position_row<Order>("FLIP, moved by (V + V')/2", transfer<lumped_mass, add_acceleration_move_by_mean>{});
    position_row<Order>("PIC", pic{});
    for (const int k : {1, 2, 4}) position_row<Order>("XPIC(" + std::to_string(k) + ")", xpic<dynamic>{k});
    for (const int k : {1, 2, 4, 8}) position_row<Order>("FMPM(" + std::to_string(k) + ")", fmpm<dynamic>{k});
}

// 3.3: contact.

/// Largest difference of the velocities of two bars that stick to those of one, over the amplitude.
template <class Order, class Method> double stick_difference(int k, Order order, Method method) {
    const auto left = [](const auto& at) { return at[0] < 0.5; };
    const auto run = [&](const auto& touch) {
        solver mpm{uniform_grid{{0.}, {1.}, 0.05}, ends{true}, fmpm<dynamic>{k}, order, touch};
        auto one = mpm.make_body(law, left, per_cell{2});
        auto two = mpm.make_body(
            law, [](const auto& at) { return at[0] > 0.5; }, per_cell{2});
        const auto rough = [](const auto& at) { return amplitude * std::sin(40 * at[0] * at[0]); };
        set_velocity_of(one, rough);
        set_velocity_of(two, rough);
        for (int n = 0; n < 100; ++n) mpm.step(bodies(one, two), 0.005);
        std::vector<std::array<double, 2>> all;
        for (const auto p : std::as_const(one)) all.push_back({p[x][0], p[v][0]});
        for (const auto p : std::as_const(two)) all.push_back({p[x][0], p[v][0]});
        std::sort(all.begin(), all.end());
        return all;
    };
    const auto as_one = run(one_velocity{}), as_two = run(contact{bonded{}, normal_by_mass{}, by_approach{}, method});
    double most = 0;
    for (std::size_t n = 0; n < as_one.size(); ++n) most = std::max(most, std::abs(as_one[n][1] - as_two[n][1]));
    return most / amplitude;
}
void stick() {
    const std::array<int, 8> orders{1, 2, 3, 4, 5, 6, 7, 8};
    heading("Two bars that stick less one bar", "order, contact", columns_of("k = ", orders));
    const auto add_method = [&](auto order, const char* name, auto method) {
        std::vector<std::string> cells;
        for (const int k : orders) cells.push_back(number(stick_difference(k, order, method), "%.0e"));
        row(std::string(order.name) + ", " + name, cells);
    };
    const auto add = [&](auto order) { add_method(order, "incremental", contact_method::incremental{}); };
    add(usf{});
    add(usl_minus{});
    add(usl_plus{});
    add(usavg_minus{});
    add(usavg_plus{});
    add(euler{});
    add_method(usl_minus{}, "net", contact_method::net{});
    add_method(usl_minus{}, "filtered", contact_method::filtered{});
    add_method(usl_minus{}, "lumped", contact_method::lumped{});
    add_method(usl_minus{}, "velocity", contact_method::velocity{});
}

struct impact_result {
    double left = INFINITY, energy = INFINITY, force = INFINITY;
};
/// A bar at speed u meets one at rest, end to end. They are pressed together by rho c u/2 until t = 2 L/c; then the
/// first is at rest and the other has its speed. `left`: momentum of the first at t = 3 over M u; `force`: root mean
/// square of F/(rho c u/2) - 1 for 0.2 < t < 1.8, F from the momentum that the first loses in a step.
template <class Motion, class Shape, class Method, class... Policy>
impact_result impact(Method method, const Policy&... policies) {
    const double h = 0.02, dt = 0.1 * h;
    solver mpm{uniform_grid{{0.}, {4.}, h}, Shape{}, Motion{},
               contact{frictionless{}, given_normal{place(1.)}, by_approach{}, method}, policies...};
    auto one = mpm.make_body(
        law, [](const auto& at) { return at[0] > 1 && at[0] < 2; }, per_cell{2});
    auto two = mpm.make_body(
        law, [](const auto& at) { return at[0] > 2 && at[0] < 3; }, per_cell{2});
    set_velocity_of(one, [](const auto&) { return amplitude; });
    const double start = energy_of(one);
    double square = 0, momentum = amplitude;
    int count = 0;
    impact_result out;
    while (mpm.steps() < 1500) {
        mpm.step(bodies(one, two), dt);
        const double before = std::exchange(momentum, total_momentum(one)[0]), force = (before - momentum) / dt;
        if (mpm.time() > 0.2 && mpm.time() < 1.8) {
            square += std::pow(force / (amplitude / 2) - 1, 2);
            ++count;
        }
        if (!(energy_of(one) < 10 * start)) return out;
    }
    out.left = total_momentum(one)[0] / amplitude;
    out.energy = (energy_of(one) + energy_of(two)) / start - 1;
    out.force = std::sqrt(square / count);
    return out;
}
void impact_row(const std::string& name, const impact_result& r, std::vector<std::string> before = {}) {
    for (const double value : {r.left, r.energy, r.force}) before.push_back(number(value, "%+.1e"));
    row(name, before);
}
const std::vector<std::string> impact_columns{"momentum left", "energy", "force"};
std::vector<std::string> with_impact_columns(std::vector<std::string> names) {
    names.insert(names.end(), impact_columns.begin(), impact_columns.end());
    return names;
}
void impacts() {
    heading("Impact, held, linear", "order", with_impact_columns({"contact", "k"}));
    const auto add = [](auto order, const std::string& name, auto method) {
        for (const int k : {1, 2, 4, 8})
            impact_row(std::string(order.name), impact<held, linear>(method, fmpm<dynamic>{k}, order),
                       {name, std::to_string(k)});
    };
    const auto each = [&](auto order) {
        add(order, "incremental", contact_method::incremental{});
        add(order, "lumped", contact_method::lumped{});
        add(order, "velocity", contact_method::velocity{});
    };
    each(usf{});
    each(usl_minus{});
    each(usl_plus{});
    each(usavg_minus{});
    each(usavg_plus{});
    each(euler{});
    add(usl_minus{}, "net", contact_method::net{});
    add(usl_minus{}, "filtered", contact_method::filtered{});
    impact_row("usl-", impact<held, linear>(contact_method::incremental{}, flip{}, usl_minus{}), {"FLIP", "-"});
    heading("Impact, moving, quadratic, usl-", "contact", with_impact_columns({"k"}));
    const auto moving_row = [](const std::string& name, auto method) {
        for (const int k : {1, 2, 4, 8})
            impact_row(name, impact<moving, quadratic_spline>(method, fmpm<dynamic>{k}, usl_minus{}),
                       {std::to_string(k)});
    };
    moving_row("incremental", contact_method::incremental{});
    moving_row("net", contact_method::net{});
    moving_row("filtered", contact_method::filtered{});
    moving_row("lumped", contact_method::lumped{});
    moving_row("velocity", contact_method::velocity{});
    impact_row("FLIP", impact<moving, quadratic_spline>(contact_method::incremental{}, flip{}, usl_minus{}), {"-"});
    const auto xpic_row = [](const std::string& name, auto method) {
        for (const int k : {2, 4, 8})
            impact_row("XPIC, " + name, impact<moving, quadratic_spline>(method, xpic<dynamic>{k}, usl_minus{}),
                       {std::to_string(k)});
    };
    xpic_row("incremental", contact_method::incremental{});
    xpic_row("net", contact_method::net{});
    xpic_row("filtered", contact_method::filtered{});
}

// 3.3: which velocity strains.

/// v+(k), which particles take while the lumped v+ strains them.
struct full_speed : vector_field {
    static constexpr std::string_view name = "full_speed";
};
struct full_mass_beside : full_mass<dynamic> {
    using full_mass::full_mass;
    static constexpr bool full = false;
    using on_nodes = fields<const field::inverse_mass, field::velocity, field::increment, field::image, full_speed>;
    void solve(auto& pass) const { this->template filter<full_speed>(true, pass); }
};
struct set_full_speed {
    using on_nodes = fields<const full_speed>;
    static constexpr double start_share() { return 1; }
    auto velocity(auto, auto near, auto) const { return near.sum(full_speed{}).eval(); }
    auto displacement(const auto& before, const auto& after, auto, auto dt) const {
        return ((before + after) * (dt / 2)).eval();
    }
};
struct fmpm_lumped_strain : transfer<full_mass_beside, set_full_speed> {
    explicit fmpm_lumped_strain(int k) : transfer{full_mass_beside(k), {}} {}
};

/// Does the energy of rough velocities stay within bounds?
template <class Shape, class Scheme, class Order>
bool stable(const Scheme& scheme, Order order, double courant_number) {
    const double h = 0.02;
    solver mpm{uniform_grid{{0.}, {1.}, h}, Shape{}, ends{false}, held{}, scheme, order};
    auto bar = mpm.make_body(law, everywhere, per_cell{3});
    set_velocity_of(bar, [](const auto& at) { return amplitude * std::sin(9137 * at[0] * at[0]); });
    const double start = energy_of(bar);
    while (mpm.steps() < 2000) {
        mpm.step(bodies(bar), h * courant_number);
        if (!(energy_of(bar) < 100 * start)) return false;
    }
    return true;
}
template <class Shape, class Scheme, class Order>
std::string largest_courant_number(const Scheme& scheme, Order order) {
    double low = 0, high = 2;
    while (high - low > 0.005) {
        const double middle = (low + high) / 2;
        (stable<Shape>(scheme, order, middle) ? low : high) = middle;
    }
    return number(low, "%.2f");
}
/// The share of its angular momentum that a free, stiff neo-Hookean square keeps while it turns for 3.2 s, 0.76 of a
/// turn.
template <class Scheme> double turned(const Scheme& scheme, double dt) {
    using plane = point<2, double>;
    solver mpm{uniform_grid{{0., 0.}, {2., 2.}, 0.1}, scheme, usl_minus{}};
    auto body = mpm.make_body(
        neo_hookean{.young = 200, .poisson = 0.3, .density = 1},
        [](const auto& at) { return std::abs(at[0] - 1) < 0.42 && std::abs(at[1] - 1) < 0.42; }, per_cell{2});
    set_velocity_of(body, [](const auto& at) { return plane(1.5 * (1 - at[1]), 1.5 * (at[0] - 1)); });
    const auto momentum = [&] {
        return sum_over(body, [](const auto& p) { return p[m] * ((p[x][0] - 1) * p[v][1] - (p[x][1] - 1) * p[v][0]); });
    };
    const double start = momentum();
    try {
        for (const int steps = static_cast<int>(std::lround(3.2 / dt)); mpm.steps() < steps;)
            mpm.step(bodies(body), dt);
    } catch (const error&) {
        return INFINITY;
    }
    return momentum() / start;
}

void strain_velocities() {
    const std::array<int, 5> terms{1, 2, 4, 8, 16};
    heading("Strained by v(k) or by the lumped v, usl-", "",
            {"k", "wave: velocity", "strain", "energy", "driven bar: velocity", "strain", "impact: momentum left",
             "energy", "force"});
    const auto add = [&](const std::string& name, auto scheme_of) {
        for (const int k : terms) {
            const auto wave = bar_errors<held>({false, 50, 2}, scheme_of(k));
            const auto driven = bar_errors<held>({true, 100, 1.5}, scheme_of(k));
            const auto met = impact<held, linear>(contact_method::incremental{}, scheme_of(k), usl_minus{});
            std::vector<std::string> cells{std::to_string(k)};
            for (const double value : {wave.velocity, wave.strain, wave.energy, driven.velocity, driven.strain,
                                       met.left, met.energy, met.force})
                cells.push_back(number(value));
            row(name, cells);
        }
    };
    add("v(k)", [](int k) { return fmpm<dynamic>{k}; });
    add("lumped", [](int k) { return fmpm_lumped_strain{k}; });

    heading("Largest stable Courant number", "", columns_of("k = ", terms));
    const auto limits = [&]<class Shape>(Shape, auto order, const std::string& name, auto scheme_of) {
        std::vector<std::string> cells;
        for (const int k : terms) cells.push_back(largest_courant_number<Shape>(scheme_of(k), order));
        row(std::string(Shape::name) + ", " + std::string(order.name) + ", " + name, cells);
    };
    const auto full = [](int k) { return fmpm<dynamic>{k}; };
    const auto lumped = [](int k) { return fmpm_lumped_strain{k}; };
    limits(linear{}, usl_minus{}, "v(k)", full);
    limits(linear{}, usl_minus{}, "lumped", lumped);
    limits(quadratic_spline{}, usl_minus{}, "v(k)", full);
    limits(quadratic_spline{}, usl_minus{}, "lumped", lumped);
    limits(linear{}, usl_plus{}, "v(k)", full);
    limits(linear{}, usavg_minus{}, "v(k)", full);

    heading("Angular momentum kept, Courant number 0.33 and 0.66", "k", {"v(k)", "v(k)", "lumped", "lumped"});
    for (const int k : {2, 4, 8, 16})
        row(std::to_string(k), {number(turned(full(k), 0.002), "%.2f"), number(turned(full(k), 0.004), "%.2f"),
                                number(turned(lumped(k), 0.002), "%.2f"), number(turned(lumped(k), 0.004), "%.2f")});
}

}  // namespace

/// open_questions [boundary] [positions] [contact] [strain]: these tables; all of them without a name.
int main(int argc, char** argv) {
    const std::vector<std::string> wanted(argv + 1, argv + argc);
    const auto want = [&](const char* name) {
        return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
    };
    if (want("boundary")) {
        boundary_methods<held>("Standing wave, held", {false, 50, 2});
        boundary_methods<moving>("Standing wave, moving", {false, 50, 2});
        boundary_methods<held>("Driven bar, held", {true, 100, 1.5});
        boundary_methods<moving>("Driven bar, moving", {true, 100, 1.5});
    }
    if (want("positions")) {
        positions<usl_minus>();
        positions<usavg_minus>();
    }
    if (want("contact")) {
        stick();
        impacts();
    }
    if (want("strain")) strain_velocities();
}
