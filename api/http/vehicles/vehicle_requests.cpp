#include "api/http/vehicles/vehicle_requests.hpp"

#include "api/http/vehicles/motion_question_body.hpp"
#include "api/http/wire/body.hpp"

namespace pulseline::api {
namespace {

using json::Json;
using json::ObjectReader;

constexpr std::size_t kMaxResumed = 1000;
constexpr json::TextLimits kVehicleName{1, 64};
// Nobody measures a vehicle's place better than its own codes do.
constexpr double kLeastWithin_m = 0.001;
constexpr double kLeastWithin_rad = 1e-4;

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
