#include "core/simulation/machine/resting_body.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace pulseline::simulation {
namespace {

constexpr int kMostRounds = 60;
constexpr int kMostHalvings = 40;
constexpr double kBalance = 1e-8;    // of the weight, what may be left unbalanced
constexpr double kRounding = 1e-12;  // of the energy: less is no step uphill
constexpr double kSlack_m = 1.0;     // a body that sinks or tilts by more has found no rest
constexpr double kFirstSag_m = 0.1;  // below all supports: each of them pushes at the beginning

Eigen::Vector3d at(geometry::Point2 place) { return {1, place.x_m, place.y_m}; }

struct Energy {
    const std::vector<Support>& supports;
    Eigen::Vector3d load;  // the weight and its moments

    double pressed_m(const Support& support, const Eigen::Vector3d& plane) const {
        return std::max(0.0, support.height_m - at(support.place).dot(plane));
    }
    double value(const Eigen::Vector3d& plane) const {
        double energy = load.dot(plane);
        for (const Support& support : supports) {
            const double pressed = pressed_m(support, plane);
            energy += support.stiffness_npm * pressed * pressed / 2;
        }
        return energy;
    }
    Eigen::Vector3d slope(const Eigen::Vector3d& plane) const {
        Eigen::Vector3d slope = load;
        for (const Support& support : supports)
            slope -= support.stiffness_npm * pressed_m(support, plane) * at(support.place);
        return slope;
    }
    Eigen::Matrix3d curvature(const Eigen::Vector3d& plane) const {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (const Support& support : supports) {
            if (pressed_m(support, plane) <= 0) continue;
            const Eigen::Vector3d place = at(support.place);
            sum += support.stiffness_npm * place * place.transpose();
        }
        // Fewer than three that push leave it free to turn about them: a little resistance keeps
        // the step finite, and the next round finds what it turns onto.
        return sum + (1e-6 * sum.trace() + 1) * Eigen::Matrix3d::Identity();
    }
};

}  // namespace

// The energy is convex and smooth but for its curvature: Newton's steps, halved until each goes
// downhill, end at its one least value.
std::optional<Rest> rest_on(const std::vector<Support>& supports, double weight_n,
                            geometry::Point2 centre) {
    if (supports.empty() || !(weight_n > 0)) return std::nullopt;
    const Energy energy{supports, weight_n * at(centre)};
    double lowest_m = supports.front().height_m;
    for (const Support& support : supports) lowest_m = std::min(lowest_m, support.height_m);
    Eigen::Vector3d plane(lowest_m - kFirstSag_m, 0, 0);
    for (int round = 0; round < kMostRounds; ++round) {
        const Eigen::Vector3d slope = energy.slope(plane);
        if (slope.norm() <= kBalance * energy.load.norm()) {
            Rest rest{plane, {}};
            for (const Support& support : supports) {
                rest.force_n.push_back(support.stiffness_npm * energy.pressed_m(support, plane));
            }
            return rest;
        }
        const Eigen::Vector3d step = energy.curvature(plane).ldlt().solve(-slope);
        double share = 1;
        const double before = energy.value(plane);
        for (int halved = 0; halved < kMostHalvings; ++halved, share /= 2) {
            const double rounding = kRounding * (std::abs(before) + energy.load.norm());
            if (energy.value(plane + share * step) <= before + rounding) break;
        }
        plane += share * step;
        if (std::abs(plane[0] - lowest_m) > kSlack_m || plane.tail<2>().norm() > kSlack_m) {
            return std::nullopt;
        }
    }
    return std::nullopt;
}

}  // namespace pulseline::simulation
