#include "core/fleet/vehicle/code_pose.hpp"

#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/localisation/dual_camera.hpp"

namespace pulseline::fleet {
namespace {

// A camera's own angle of one code: from the edge fit (vision/edge_fit), used only when one code is
// seen.
constexpr double kSigmaUp_rad = 2e-4;

/// A vehicle cannot stand outside the walls: a camera or the survey is wrong.
bool is_in_hall(const FleetState& fleet, const LiveVehicle& live, const Pose2& pose) {
    const auto* hall = plant::find_hall(fleet.plant, plant::HallId(hall_of(fleet, live)));
    return hall && geometry::contains(hall->outline, pose.position());
}

}  // namespace

std::optional<Pose2> pose_from_codes(const FleetState& fleet, const LiveVehicle& live,
                                     const std::vector<vda5050::CameraReading>& readings) {
    std::vector<localisation::CodeObservation> observations;
    std::vector<localisation::SurveyedCode> survey;
    for (const auto& reading : readings) {
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
    if (!fix || !is_in_hall(fleet, live, fix->pose)) return std::nullopt;
    return fix->pose;
}

}  // namespace pulseline::fleet
