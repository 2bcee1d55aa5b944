#include "api/http/vehicles/motion_preview_handlers.hpp"

#include <utility>

#include "api/http/orders/preview_json.hpp"
#include "api/http/vehicles/vehicle_requests.hpp"
#include "api/http/wire/problem.hpp"

namespace pulseline::api {
namespace {

Json answer_json(const fleet::MotionQuestion& question, const fleet::MotionTask& task,
                 const std::vector<planning::ModeOption>& options) {
    Json json = {{"vehicle", question.vehicle.str()},
                 {"hall", task.request.hall.str()},
                 {"start", pose_json(task.request.start)},
                 {"target", pose_json(task.target)},
                 {"loaded", task.request.loaded},
                 {"options", list_json(options, [](const planning::ModeOption& option) {
                      return mode_option_json(option);
                  })}};
    if (question.station) json["station"] = *question.station;
    return json;
}

}  // namespace

FleetAnswer preview_motions(FleetContext& context, const Request& request) {
    auto question = read_motion_question(request);
    if (!question) return {problem(400, question.error(), request)};
    auto task = context.fleet.motion_task(*question);
    if (!task) return {problem(task.error(), request)};
    return {
        {},
        [question = std::move(*question),
         task = std::move(*task)](const PlanContext& with) -> FleetAnswer {
            return {json_response(200, answer_json(question, task, with.motions.preview(task)))};
        }};
}

}  // namespace pulseline::api
