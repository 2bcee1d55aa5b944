#include "core/localisation/codes_on_way.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/square.hpp"
#include "core/kinematics/motion.hpp"

namespace pulseline::localisation {
namespace {

using geometry::Point2;
using kinematics::Segment;

// Finer than a camera's view is long, so that no code lies between two looks.
constexpr double kLookEvery_m = 0.03;
constexpr double kSigmas = 3;
constexpr double kSurvey_m = 1e-4;  // of a code's place, as plants usually have it
constexpr double kFarthest_m = 1000;

/// Way of a camera along the segment, at most: its foot swings about a turning body.
double foot_way_m(const Segment& segment, const plant::Camera& camera) {
    return std::abs(segment.length_m) +
           std::abs(segment.turn_rad) * norm(camera.body_from_camera.position());
}

/// Calls `act` with each share at which the camera has the code in view, until that says true.
template <class Act>
void look_along(const plant::Marker& marker, const plant::Camera& camera, const Segment& segment,
                Act act) {
    const Point2 at = marker.pose.position();
    const double radius_m = view_radius_m(camera, marker.size_m);
    const double way_m = foot_way_m(segment, camera);
    const int looks = 1 + static_cast<int>(std::ceil(way_m / kLookEvery_m));
    const double look_m = way_m / looks;
    for (int i = 0; i <= looks;) {
        const double share = static_cast<double>(i) / looks;
        const geometry::Pose2 body = kinematics::pose_at(segment, share);
        const double off_m = distance(body * camera.body_from_camera.position(), at);
        if (off_m <= radius_m && act(share)) return;
        if (off_m - radius_m > way_m) return;
        // No look is needed before it can have come into view.
        const double until_m = std::min(off_m - radius_m, way_m);
        i += until_m > look_m ? static_cast<int>(until_m / look_m) : 1;
    }
}

}  // namespace

double view_radius_m(const plant::Camera& camera, double size_m) {
    const double view_m =
        std::min(camera.width_px, camera.height_px) * camera.height_m / camera.f_px;
    return (view_m - size_m) / 2;
}

std::vector<double> seen_at(const plant::Marker& marker, std::span<const plant::Camera> cameras,
                            const Segment& segment) {
    std::vector<double> shares;
    for (const auto& camera : cameras) {
        look_along(marker, camera, segment, [&](double share) {
            shares.push_back(share);
            return false;
        });
    }
    std::sort(shares.begin(), shares.end());
    return shares;
}

bool is_passed(const plant::Marker& marker, std::span<const plant::Camera> cameras,
               const Segment& segment) {
    bool passed = false;
    for (const auto& camera : cameras) {
        look_along(marker, camera, segment, [&](double) { return passed = true; });
        if (passed) return true;
    }
    return false;
}

double across_sigma_m(const KnownPose& known, double way_m, double arm_m,
                      const OdometryNoise& noise) {
    const double reach_m = way_m + arm_m;
    const double wander2 =
        square(noise.heading_rad_per_sqrt_m) * (std::pow(reach_m, 3) - std::pow(arm_m, 3)) / 3;
    const double bent_m = noise.bend_rad_per_m * way_m * (way_m / 2 + arm_m);
    return std::sqrt(square(known.place_m) + square(noise.left_m_per_sqrt_m) * way_m +
                     square(known.heading_rad * reach_m) + wander2 +
                     square(noise.crab_rad * way_m) + square(bent_m));
}

double motion_sigma_m(double heading_rad, double way_m, const OdometryNoise& noise) {
    const double along2 = square(noise.forward_m_per_sqrt_m) * way_m + square(noise.scale * way_m);
    return std::sqrt(square(across_sigma_m({0, heading_rad}, way_m, 0, noise)) + along2);
}

KnownPose known_by_code(const plant::Camera& camera, const plant::Marker& marker,
                        const ErrorBudget& budget) {
    const double radius_m = std::max(0.0, view_radius_m(camera, marker.size_m));
    KnownPose known;
    known.heading_rad = std::hypot(code_sigma_rad(budget, 0), marker.sigma_heading_rad);
    known.place_m = std::hypot(code_sigma_m(budget, camera, radius_m, 0), marker.sigma_xy_m,
                               known.heading_rad * norm(camera.body_from_camera.position()));
    return known;
}

double sure_way_m(const KnownPose& known, double arm_m, double within_m,
                  const OdometryNoise& noise) {
    const auto across_m = [&](double way_m) { return across_sigma_m(known, way_m, arm_m, noise); };
    if (kSigmas * across_m(0) > within_m) return 0;
    double sure_m = 0;
    double unsure_m = kFarthest_m;
    while (unsure_m - sure_m > 0.01) {
        const double middle_m = (sure_m + unsure_m) / 2;
        (kSigmas * across_m(middle_m) <= within_m ? sure_m : unsure_m) = middle_m;
    }
    return sure_m;
}

double turn_sigma_rad(double turn_rad, bool brakes, const OdometryNoise& noise) {
    const double turned2 = square(noise.heading_rad_per_sqrt_rad) * std::abs(turn_rad);
    // It settles where it brakes from its speed, and a little where the turn ends
    // (PoseFilter::rest).
    const double stood2 = square(noise.fine_rad + noise.settle_rad) + square(noise.fine_rad);
    return std::sqrt(turned2 + (brakes ? stood2 : 0));
}

double as_straight_m(const KnownPose& known, double way_m, double arm_m,
                     std::span<const TurnBehind> turns, const OdometryNoise& noise) {
    double turned2 = 0;
    for (const TurnBehind& turn : turns) {
        turned2 +=
            square(turn_sigma_rad(turn.turn_rad, turn.brakes, noise) * (turn.rest_m + arm_m));
    }
    if (turned2 == 0) return way_m;
    const double across_m = std::sqrt(square(across_sigma_m(known, way_m, arm_m, noise)) + turned2);
    double less_m = way_m;
    double more_m = kFarthest_m;
    while (more_m - less_m > 0.01) {
        const double middle_m = (less_m + more_m) / 2;
        (across_sigma_m(known, middle_m, arm_m, noise) < across_m ? less_m : more_m) = middle_m;
    }
    return less_m;
}

double blind_way_m(const plant::Camera& camera, double size_m, const ErrorBudget& budget,
                   const OdometryNoise& noise, double off_m) {
    const double radius_m = view_radius_m(camera, size_m);
    if (radius_m <= off_m) return 0;
    const KnownPose known{std::hypot(code_sigma_m(budget, camera, radius_m, 0), kSurvey_m),
                          std::hypot(code_sigma_rad(budget, 0), budget.marker.survey_rad)};
    return sure_way_m(known, norm(camera.body_from_camera.position()), radius_m - off_m, noise);
}

}  // namespace pulseline::localisation
