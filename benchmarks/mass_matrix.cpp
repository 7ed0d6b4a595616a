// FMPM(k) where the full mass matrix is assembled, beside the same by sweeps over the particles.
#include <tamis/tamis.hpp>

#include "block.hpp"
#include "ratios.hpp"

using namespace tamis;

namespace {

/// The full mass matrix of K terms, without telling how many: so it is swept.
template <int K> struct swept_mass : private full_mass<K> {
    using full_mass<K>::full;
    using typename full_mass<K>::on_nodes;
    using full_mass<K>::filter;
};
template <int K> struct swept : transfer<swept_mass<K>, set_velocity_move_by_mean> {
    static constexpr std::string_view name = "swept";
};

template <int Dim, int... K, class... Policy>
void add(ratio_run& run, int n, const std::string& scene, std::integer_sequence<int, K...>, Policy... policies) {
    const auto one = [&](const auto& by_sweeps, const auto& assembled, const std::string& k) {
        const std::string name = scene + "/fmpm(" + k + ")";
        run.add(name + "/swept", scene + "/flip",
                [=] { return elastic_block<Dim, double>(n, policies..., by_sweeps); });
        run.add(name, name + "/swept", [=] { return elastic_block<Dim, double>(n, policies..., assembled); });
    };
    run.add(scene + "/flip", "", [=] { return elastic_block<Dim, double>(n, policies..., flip{}); });
    (one(swept<K>{}, fmpm<K>{}, std::to_string(K)), ...);
}

}  // namespace

int main(int argc, char** argv) {
    ratio_run run;
    const std::integer_sequence<int, 3, 4> few;
    const std::integer_sequence<int, 4> four;
    add<1>(run, 400, "1D/linear", std::integer_sequence<int, 3, 4, 8>{}, linear{});
    add<1>(run, 400, "1D/quadratic", std::integer_sequence<int, 3, 4, 8>{}, quadratic_spline{});
    add<1>(run, 400, "1D/cubic", std::integer_sequence<int, 4, 8>{}, cubic_spline{});
    add<2>(run, 128, "2D/linear", few, linear{});
    add<2>(run, 512, "2D/linear, 512 cells", few, linear{});
    add<2>(run, 128, "2D/linear, held", few, linear{}, held{});
    add<2>(run, 128, "2D/quadratic, held", few, quadratic_spline{}, held{});
    add<2>(run, 512, "2D/quadratic, held, 512 cells", four, quadratic_spline{}, held{});
    add<2>(run, 128, "2D/cubic, held", four, cubic_spline{}, held{});
    add<3>(run, 32, "3D/linear, held", few, linear{}, held{});
    return run.run(argc, argv);
}
