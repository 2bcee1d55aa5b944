#include "core/fleet/vehicle/seen_pose.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/base/square.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/localisation/dual_camera.hpp"
#include "core/localisation/reflector_pose.hpp"
#include "core/localisation/rigid_fit.hpp"

namespace pulseline::fleet {
namespace {

// A camera's own angle of one code: from the edge fit (vision/edge_fit), used only when one code is
// seen.
constexpr double kSigmaUp_rad = 2e-4;
// One that a vehicle says to know far better than that would outweigh all others.
constexpr double kLeastSigma_m = 1e-5;
constexpr double kLeastSightSigma_m = 1e-3;
// How far a vehicle is from where it says to stand, as far as its reflectors are told apart by it.
constexpr double kTold_m = 0.1;
constexpr double kTold_rad = 0.03;

SeenPose seen_by(PoseBasis::Kind basis, const localisation::PoseFix& fix) {
    return {fix.pose, basis, fix.sigma_xy_m, fix.sigma_heading_rad};
}

std::optional<SeenPose> by_receivers(const LiveVehicle& live) {
    const auto& known = live.type->receivers;
    std::vector<localisation::PlacedPoint> points;
    for (const auto& reading : live.state.receivers) {
        const auto receiver = std::ranges::find(known, reading.receiver, &plant::Receiver::name);
        const bool twice = std::ranges::count(live.state.receivers, reading.receiver,
                                              &vda5050::ReceiverReading::receiver) > 1;
        if (!reading.found || receiver == known.end() || twice) continue;
        points.push_back(
            {receiver->position, reading.place, std::max(reading.sigma_m, kLeastSigma_m)});
    }
    if (points.size() < 2) return std::nullopt;
    const auto fit = localisation::rigid_fit(points);
    const bool finite = std::isfinite(fit.pose.x_m) && std::isfinite(fit.pose.y_m);
    if (!finite || !fit.agrees()) return std::nullopt;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& by = fit.by_place[i];
        covariance += square(points[i].sigma_m) * by * by.transpose();
    }
    localisation::PoseFix fix;
    fix.pose = fit.pose;
    set_covariance(fix, covariance);
    return seen_by(PoseBasis::Kind::kReceivers, fix);
}

std::optional<SeenPose> by_codes(const FleetState& fleet, const LiveVehicle& live) {
    std::vector<localisation::CodeObservation> observations;
    std::vector<localisation::SurveyedCode> survey;
    for (const auto& reading : live.state.cameras) {
        if (!reading.found) continue;
        const auto* marker = plant::find_marker_by_payload(fleet.plant, reading.payload);
        if (!marker || marker->hall.str() != hall_of(fleet, live)) continue;
        observations.push_back(
            {reading.payload, reading.code, reading.angle_rad, reading.sigma_m, kSigmaUp_rad});
        survey.push_back(
            {marker->payload, marker->pose, marker->sigma_xy_m, marker->sigma_heading_rad});
    }
    // All its cameras must agree: with one code missing, a person says where it stands.
    if (observations.empty() || observations.size() < live.type->cameras.size())
        return std::nullopt;
    const auto fix = localisation::locate(observations, survey);
    if (!fix) return std::nullopt;
    return seen_by(PoseBasis::Kind::kCodes, *fix);
}

/// Where it says to stand is enough to tell its reflectors apart; otherwise how they stand to each
/// other has to.
std::optional<SeenPose> by_reflectors(const FleetState& fleet, const LiveVehicle& live,
                                      Reach reach) {
    const auto& scanner = live.type->navigation_scanner;
    if (!scanner || live.state.reflectors.empty()) return std::nullopt;
    std::vector<localisation::SeenReflector> seen;
    for (const auto& sight : live.state.reflectors) {
        if (!std::isfinite(sight.place.x_m) || !std::isfinite(sight.place.y_m)) continue;
        const double sigma_m = std::max(sight.sigma_m, kLeastSightSigma_m);
        seen.push_back({sight.place, square(sigma_m) * Eigen::Matrix2d::Identity()});
    }
    std::vector<plant::Reflector> here;
    std::ranges::copy_if(
        fleet.plant.reflectors, std::back_inserter(here),
        [hall = hall_of(fleet, live)](const auto& one) { return one.hall.str() == hall; });
    if (live.state.position_initialized && live.state.pose) {
        const Eigen::Vector3d variance(square(kTold_m), square(kTold_m), square(kTold_rad));
        const auto near = localisation::locate_by_reflectors(
            seen, here, *scanner, {*live.state.pose, variance.asDiagonal()});
        if (near) return seen_by(PoseBasis::Kind::kReflectors, near->fix);
    }
    if (reach == Reach::kNearIt) return std::nullopt;
    const auto found = localisation::find_by_reflectors(seen, here, *scanner);
    if (!found) return std::nullopt;
    return seen_by(PoseBasis::Kind::kReflectors, found->fix);
}

}  // namespace

std::optional<SeenPose> seen_pose(const FleetState& fleet, const LiveVehicle& live, Reach reach) {
    // A vehicle cannot stand outside the walls: then a sense or the survey is wrong.
    const auto in_hall = [&](const std::optional<SeenPose>& seen) {
        return seen && is_in_hall(fleet, {seen->pose, hall_of(fleet, live)});
    };
    if (const auto seen = by_receivers(live); in_hall(seen)) return seen;
    if (const auto seen = by_codes(fleet, live); in_hall(seen)) return seen;
    if (const auto seen = by_reflectors(fleet, live, reach); in_hall(seen)) return seen;
    return std::nullopt;
}

}  // namespace pulseline::fleet
