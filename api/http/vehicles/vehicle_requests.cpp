#include "api/http/vehicles/vehicle_requests.hpp"

#include <utility>

#include "api/http/vehicles/motion_question_body.hpp"
#include "api/http/wire/body.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::api {
namespace {

using json::Json;
using json::ObjectReader;

constexpr std::size_t kMaxResumed = 1000;
constexpr json::TextLimits kVehicleName{1, 64};
constexpr json::TextLimits kPartName{1, 64};  // of a bracket or a foot
// Of any bracket; its type has its own.
constexpr double kMostHeight_m = 5;
constexpr double kLeastSpeed_mps = 1e-5;
constexpr double kMostSpeed_mps = 1;
// Nobody measures a vehicle's place better than its own codes do.
constexpr double kLeastWithin_m = 0.001;
constexpr double kLeastWithin_rad = 1e-4;

enum class Lift { kUnknown, kSetBracketHeight, kLowerParking, kRaiseParking, kPick, kDrop };

const char* to_string(Lift lift) {
    switch (lift) {
        case Lift::kSetBracketHeight:
            return vda5050::kSetBracketHeight;
        case Lift::kLowerParking:
            return vda5050::kLowerParking;
        case Lift::kRaiseParking:
            return vda5050::kRaiseParking;
        case Lift::kPick:
            return vda5050::kPick;
        case Lift::kDrop:
            return vda5050::kDrop;
        case Lift::kUnknown:
            break;
    }
    return "";
}

}  // namespace

Result<fleet::StatedPose> read_stated_pose(const Request& request) {
    return read_object<fleet::StatedPose>(request, [](ObjectReader& in) {
        using fleet::StatedPose;
        StatedPose stated{read_pose_members(in)};
        stated.sigma_xy_m = in.number_or("within_m", StatedPose::kPointedWithin_m,
                                         {kLeastWithin_m, StatedPose::kPointedWithin_m}) /
                            2;
        stated.sigma_heading_rad =
            in.number_or("within_rad", StatedPose::kPointedWithin_rad,
                         {kLeastWithin_rad, StatedPose::kPointedWithin_rad}) /
            2;
        return stated;
    });
}

Result<fleet::StepAction> read_lift_move(const Request& request) {
    return read_object<fleet::StepAction>(request, [](ObjectReader& in) {
        const Lift lift = in.one_of("type", {Lift::kSetBracketHeight, Lift::kLowerParking,
                                             Lift::kRaiseParking, Lift::kPick, Lift::kDrop});
        fleet::StepAction action;
        action.type = to_string(lift);
        if (lift == Lift::kSetBracketHeight) {
            std::string bracket = in.text("bracket", kPartName);
            action.params = {{"bracket", std::move(bracket)},
                             {"height_m", in.number("height_m", {0, kMostHeight_m})}};
            if (in.has("speed_mps")) {
                const double speed_mps = in.number("speed_mps", {kLeastSpeed_mps, kMostSpeed_mps});
                action.params.push_back({"speed_mps", speed_mps});
            }
        } else if (lift == Lift::kPick) {
            action.params = {{"load", in.text("load", kPartName)}};
        } else if (lift != Lift::kDrop && in.has("foot")) {
            action.params = {{"foot", in.text("foot", kPartName)}};
        }
        return action;
    });
}

Result<IntegrationRequest> read_integration(const Request& request) {
    return read_object<IntegrationRequest>(request, [](ObjectReader& in) {
        using fleet::Integration;
        IntegrationRequest wanted;
        wanted.level = in.one_of("level", {Integration::kIgnore, Integration::kNotice,
                                           Integration::kRespect, Integration::kUtilise});
        wanted.off_floor = in.boolean_or("off_floor", false);
        return wanted;
    });
}

Result<std::vector<plant::VehicleId>> read_resume_fleet(const Request& request) {
    return read_object<std::vector<plant::VehicleId>>(request, [](ObjectReader& in) {
        std::vector<plant::VehicleId> vehicles;
        in.items("vehicles", {1, kMaxResumed}, [&](const Json& item, const std::string& pointer) {
            vehicles.emplace_back(json::read_text(item, pointer, in.errors(), kVehicleName));
        });
        return vehicles;
    });
}

Result<fleet::MotionQuestion> read_motion_question(const Request& request) {
    return read_object<fleet::MotionQuestion>(request, read_motion_question_body);
}

}  // namespace pulseline::api
