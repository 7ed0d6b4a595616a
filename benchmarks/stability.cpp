// Critical Courant numbers by composition, from the exact Jacobian of a step: fixed ends, and free ends at the worst
// place of the particles in their cells. USL+ and USAVG+ have USF's numbers (tests/unit/stability): a step of theirs is
// the same from another starting point.
//     stability [--csv FILE] [--full]
#include <tamis/stability/stability.hpp>
#include <tamis/tamis.hpp>

#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace tamis;
using stability::bar;

constexpr double most = 2, tolerance = 3e-5;

struct limits {
    double fixed, free, worst_offset;
};

class table {
  public:
    table(bool full, const std::string& csv) : full_(full) {
        if (csv.empty()) return;
        file_.emplace(csv);
        file_->out() << "shape,update,order,stress,per_cell,fixed,free,worst_offset\n";
    }
    template <class Shape, class Update, class Order>
    void row(const Shape& shape, const Update& update, int k, const Order& order) {
        for (const int per_cell : full_ ? std::vector{1, 2, 3, 4} : std::vector{2}) {
            const limits found = find(per_cell, shape, update, order);
            std::printf("| %-9s | %-5s | %2d | %-7s | %d | %6.3f | %6.3f | %5.2f |\n", Shape::name.data(),
                        Update::name.data(), k, Order::name.data(), per_cell, found.fixed, found.free,
                        found.worst_offset);
            if (file_)
                file_->out() << Shape::name << ',' << Update::name << ',' << k << ',' << Order::name << ',' << per_cell
                             << ',' << found.fixed << ',' << found.free << ',' << found.worst_offset << '\n';
        }
    }
    void commit() {
        if (file_) file_->commit();
    }

  private:
    bool full_;
    std::optional<atomic_file> file_;

    template <class... Policy> limits find(int per_cell, const Policy&... policies) const {
        limits found{stability::critical_courant(bar{16, per_cell}, most, tolerance, policies...), most, 0};
        const int places = full_ ? 50 : 20;
        for (int place = 0; place < places; ++place) {
            const double offset = static_cast<double>(place) / places;
            // Only what is below the worst so far is looked for.
            const double critical =
                stability::critical_courant(bar{8, per_cell, offset, true}, found.free, tolerance, policies...);
            if (critical < found.free) {
                found.free = critical;
                found.worst_offset = offset;
            }
        }
        return found;
    }
};

template <class Shape, class Order> void updates(table& to, const Shape& shape, const Order& order) {
    to.row(shape, flip{}, 0, order);
    for (const int k : {2, 4}) to.row(shape, xpic<dynamic>{k}, k, order);
    for (const int k : {1, 2, 4, 8, 16}) to.row(shape, fmpm<dynamic>{k}, k, order);
}
template <class Shape> void orders(table& to, const Shape& shape) {
    updates(to, shape, usf{});
    updates(to, shape, usl_minus{});
    updates(to, shape, usavg_minus{});
}

}  // namespace

int main(int argc, char** argv) {
    bool full = false;
    std::string csv;
    for (int k = 1; k < argc; ++k) {
        const std::string_view given = argv[k];
        if (given == "--full")
            full = true;
        else if (given == "--csv" && k + 1 < argc)
            csv = argv[++k];
        else {
            std::fputs("usage: stability [--csv FILE] [--full]\n", stderr);
            return 2;
        }
    }
    try {
        table to(full, csv);
        std::puts("| shape | update | k | stress | particles per cell | fixed ends | free ends | worst offset |");
        std::puts("|---|---|---|---|---|---|---|---|");
        orders(to, linear{});
        orders(to, quadratic_spline{});
        orders(to, cubic_spline{});
        to.commit();
    } catch (const std::exception& e) {
        std::fprintf(stderr, "stability: %s\n", e.what());
        return 1;
    }
    return 0;
}
