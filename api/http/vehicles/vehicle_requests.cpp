#include "api/http/vehicles/vehicle_requests.hpp"

#include "api/http/vehicles/motion_question_body.hpp"
#include "api/http/wire/body.hpp"

namespace pulseline::api {
namespace {

using json::Json;
using json::ObjectReader;

constexpr std::size_t kMaxResumed = 1000;
constexpr json::TextLimits kVehicleName{1, 64};

}  // namespace

Result<geometry::Pose2> read_pose(const Request& request) {
    return read_object<geometry::Pose2>(request, read_pose_members);
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
