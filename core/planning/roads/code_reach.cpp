#include "core/planning/roads/code_reach.hpp"

#include <algorithm>
#include <cmath>

#include "core/kinematics/primitives.hpp"
#include "core/localisation/igps_light.hpp"
#include "core/localisation/reflector_pose.hpp"

namespace pulseline::planning {
namespace {

// What traffic keeps free beside a vehicle (core/fleet/tables/floor_graph.hpp).
constexpr double kBeside_m = 0.1;
constexpr double kByBeacons_m = 1e-4;
constexpr double kByBeacons_rad = 1e-4;
constexpr double kLookEvery_m = 0.5;
constexpr double kFarthestView_m = 0.5;  // of a camera from its foot
constexpr std::size_t kTransmitters = 2;
constexpr std::size_t kReflectors = 3;  // one more than a pose needs: it may be hidden

double mean_height_m(const std::vector<plant::Receiver>& receivers) {
    double sum_m = 0;
    for (const auto& receiver : receivers) sum_m += receiver.z_m;
    return receivers.empty() ? 0 : sum_m / static_cast<double>(receivers.size());
}

}  // namespace

CodeReach::CodeReach(const plant::VehicleType& type, bool loaded)
    : cameras_(plant::cameras_of(type, loaded)),
      receiver_m_(mean_height_m(type.receivers)),
      scanner_(type.navigation_scanner),
      noise_(cameras_.empty() && !has_beacons()
                 ? localisation::OdometryNoise()
                 : localisation::odometry_noise(localisation::DriveErrors(), type)),
      known_{kByBeacons_m, kByBeacons_rad} {
    for (const auto& camera : cameras_) {
        const double own_m = norm(camera.body_from_camera.position());
        if (own_m >= arm_m_) known_ = localisation::known_by_code(camera, {});
        arm_m_ = std::max(arm_m_, own_m);
    }
}

double CodeReach::at_most_m(double size_m) const {
    const auto [known, added] = at_most_m_.try_emplace(size_m, 0);
    for (const auto& camera : cameras_) {
        if (!added) break;
        const double camera_m = localisation::blind_way_m(camera, size_m, {}, noise_);
        known->second = std::max(known->second, camera_m);
    }
    return known->second;
}

double CodeReach::as_straight_m(double from_m, double to_m, std::span<const TurnAt> turns) const {
    std::vector<localisation::TurnBehind> behind;
    for (const TurnAt& turn : turns) {
        if (turn.at_m >= from_m && turn.at_m <= to_m) {
            behind.push_back({turn.turn_rad, to_m - turn.at_m, turn.brakes});
        }
    }
    if (behind.empty()) return to_m - from_m;
    return localisation::as_straight_m(known_, to_m - from_m, arm_m_, behind, noise_);
}

double CodeReach::in_the_dark_m() const {
    if (!in_the_dark_m_) {
        in_the_dark_m_ =
            localisation::sure_way_m({kByBeacons_m, kByBeacons_rad}, 0, kBeside_m, noise_);
    }
    return *in_the_dark_m_;
}

bool CodeReach::is_lit(const plant::Plant& plant, const plant::HallId& hall,
                       geometry::Point2 at) const {
    const auto cell = [](double way_m) {
        return static_cast<int>(std::floor(way_m / kLookEvery_m));
    };
    const auto [known, added] =
        lit_.try_emplace(std::tuple(hall, cell(at.x_m), cell(at.y_m)), false);
    if (added) {
        const Eigen::Vector3d place(at.x_m, at.y_m, receiver_m_);
        known->second =
            (receiver_m_ > 0 &&
             localisation::transmitters_in_view(plant, hall, place).size() >= kTransmitters) ||
            (scanner_ &&
             localisation::reflectors_in_view(plant, hall, *scanner_, {at.x_m, at.y_m, 0}).size() >=
                 kReflectors);
    }
    return known->second;
}

double CodeReach::mean_sigma_m(const plant::Plant& plant, const plant::HallId& hall,
                               const kinematics::Segment& lane) const {
    const bool by_codes = !cameras_.empty() && !plant.markers.empty();
    const bool by_beacons =
        has_beacons() && !(plant.transmitters.empty() && plant.reflectors.empty());
    const double length_m = std::abs(lane.length_m);
    if (length_m <= 0 || !(by_codes || by_beacons)) return 0;
    std::vector<double> told_m{0};  // where on the lane something tells it
    const geometry::Point2 middle = kinematics::pose_at(lane, 0.5).position();
    for (const auto& marker : plant.markers) {
        const double away_m = geometry::distance(marker.pose.position(), middle);
        if (marker.hall != hall || away_m > length_m / 2 + arm_m_ + kFarthestView_m) continue;
        for (const double share : localisation::seen_at(marker, cameras_, lane)) {
            told_m.push_back(share * length_m);
        }
    }
    const int pieces = 1 + static_cast<int>(std::ceil(length_m / kLookEvery_m));
    const auto at_m = [&](int piece) { return (piece + 0.5) * length_m / pieces; };
    for (int i = 0; by_beacons && i < pieces; ++i) {
        const double share = at_m(i) / length_m;
        if (is_lit(plant, hall, kinematics::pose_at(lane, share).position())) {
            told_m.push_back(at_m(i));
        }
    }
    std::ranges::sort(told_m);
    double sum_m = 0;
    for (int i = 0; i < pieces; ++i) {
        const double since_m = at_m(i) - *std::prev(std::ranges::upper_bound(told_m, at_m(i)));
        sum_m += std::hypot(known_.place_m,
                            localisation::motion_sigma_m(known_.heading_rad, since_m, noise_));
    }
    return sum_m / pieces;
}

}  // namespace pulseline::planning
