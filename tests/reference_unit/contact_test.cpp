#include <cmath>
#include <vector>

#include "../reference/contact.hpp"
#include "catch.hpp"
#include "rough.hpp"

using namespace reference;
using namespace rough;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// The particles of a body for which `chosen` is true, in their order.
state part_of(const state& body, bool (*chosen)(const VectorXd&)) {
    std::vector<Index> kept;
    state part = body;
    part.stress.clear();
    part.deformation.clear();
    for (Index p = 0; p < body.size(); ++p) {
        if (!chosen(body.x.row(p).transpose())) continue;
        kept.push_back(p);
        part.stress.push_back(body.stress[static_cast<std::size_t>(p)]);
        part.deformation.push_back(body.deformation[static_cast<std::size_t>(p)]);
    }
    part.x = body.x(kept, Eigen::all);
    part.v = body.v(kept, Eigen::all);
    part.mass = body.mass(kept);
    part.volume = body.volume(kept);
    part.half_width = body.half_width(kept);
    return part;
}
bool left(const VectorXd& at) { return at.sum() < 0.4; }
bool right(const VectorXd& at) { return !left(at); }

VectorXd momentum(const state& body) { return body.v.transpose() * body.mass; }

scene rubbed(shape_kind shape, const update& by, stress_order order) {
    scene set = box(2, 1., 0.25);
    set.shape = shape;
    set.update = by;
    set.order = order;
    set.poisson = 0.2;
    return set;
}

}  // namespace

TEST_CASE("bodies that are bonded move as one", "[reference]") {
    for (const stress_order order : {stress_order::usl_minus, stress_order::usavg_plus, stress_order::usf})
        for (const update& by : {flip(), fmpm(1), fmpm(2), fmpm(5)}) {
            CAPTURE(static_cast<int>(order), by.k);
            scene set = rubbed(shape_kind::quadratic_spline, by, order);
            add_conditions(set);
            state whole = rough_body(set, 2);
            whole.v *= 0.05;
            std::vector<state> halves{part_of(whole, left), part_of(whole, right)};
            for (int n = 0; n < 5; ++n) {
                const MatrixXd alone = step(set, whole, 0.01 * n, 0.01);
                const contact_result told = advance(set, {.law = contact_law::bonded}, halves, 0.01 * n, 0.01);
                CHECK((told.reactions - alone).cwiseAbs().maxCoeff() < 1e-11);
            }
            MatrixXd v(whole.size(), 2);
            v << halves[0].v, halves[1].v;
            CHECK(std::abs(v.squaredNorm() - whole.v.squaredNorm()) < 1e-11);
            CHECK((momentum(halves[0]) + momentum(halves[1]) - momentum(whole)).norm() < 1e-13);
        }
}

TEST_CASE("contact forces change the bodies' momenta, and keep their sum", "[reference]") {
    for (const stress_order order : {stress_order::usl_minus, stress_order::usl_plus, stress_order::usavg_minus})
        for (const update& by : {flip(), fmpm(1), fmpm(4)})
            for (const contact_law law : {contact_law::frictionless, contact_law::coulomb, contact_law::bonded}) {
                CAPTURE(static_cast<int>(order), by.k, static_cast<int>(law));
                const scene set = rubbed(shape_kind::linear, by, order);
                const state whole = rough_body(set, 2);
                std::vector<state> halves{part_of(whole, left), part_of(whole, right)};
                const VectorXd before = momentum(halves[0]);
                const contact_result told = advance(set, {.law = law, .mu = 0.3, .cells = 1.1}, halves, 0, 0.01);
                VectorXd impulse = VectorXd::Zero(2);
                for (const shared_node& e : told.touching) impulse += 0.01 * e.force;
                CHECK(impulse.norm() > 1e-4);
                CHECK((momentum(halves[0]) - before - impulse).norm() < 1e-13);
                CHECK((momentum(halves[0]) + momentum(halves[1]) - momentum(whole)).norm() < 1e-13);
                CHECK(told.heat >= 0);
                CHECK((told.heat > 0) == (law == contact_law::coulomb));
            }
}
