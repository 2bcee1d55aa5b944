#pragma once

#include <vector>

#include "api/http/wire/message.hpp"
#include "core/base/result.hpp"
#include "core/fleet/fleet.hpp"
#include "core/fleet/views/motion_preview.hpp"

namespace pulseline::api {

struct IntegrationRequest {
    fleet::Integration level = fleet::Integration::kUtilise;
    bool off_floor = false;
};
Result<IntegrationRequest> read_integration(const Request& request);
Result<fleet::StatedPose> read_stated_pose(const Request& request);
/// The action of setBracketHeight, lowerParking or raiseParking that is asked for outside an order.
Result<fleet::StepAction> read_lift_move(const Request& request);
Result<std::vector<plant::VehicleId>> read_resume_fleet(const Request& request);
Result<fleet::MotionQuestion> read_motion_question(const Request& request);

}  // namespace pulseline::api
