#include "api/http/stops/localization_handlers.hpp"

#include "api/http/stops/stop_requests.hpp"
#include "api/http/wire/base64.hpp"
#include "api/http/wire/common_json.hpp"
#include "api/http/wire/problem.hpp"
#include "api/localization/localization.hpp"

namespace pulseline::api {
namespace {

Json camera_json(const localization::CameraFinding& finding) {
    Json json{{"camera", finding.camera},
              {"found", finding.reading.has_value()},
              {"picture", to_base64(finding.picture)}};
    if (!finding.reading) {
        json["reason"] = reason_json(finding.reading.error().reason);
        return json;
    }
    const vision::MarkerReading& reading = *finding.reading;
    json["kind"] = plant::to_string(reading.kind);
    json["payload"] = reading.payload;
    json["center_px"] = {reading.centre.u, reading.centre.v};
    json["marker"] = pose_json(finding.body_from_marker);
    json["sigma_m"] = finding.sigma_m;
    json["rms_px"] = reading.rms_px;
    json["inliers"] = reading.inliers;
    return json;
}

Json answer_json(const localization::Localization& answer) {
    Json json{{"cameras", list_json(answer.cameras, camera_json)}};
    if (!answer.fix) {
        json["reason"] = reason_json(answer.fix.error().reason);
        return json;
    }
    json["pose"] = pose_json(answer.fix->pose);
    json["sigma_xy_m"] = answer.fix->sigma_xy_m;
    json["sigma_heading_rad"] = answer.fix->sigma_heading_rad;
    json["method"] = localisation::to_string(answer.fix->method);
    if (!answer.station) return json;
    json["station"] = answer.station->number;
    json["deviation"] = {{"dx_m", answer.deviation.dx_m},
                         {"dy_m", answer.deviation.dy_m},
                         {"dheading_rad", answer.deviation.dheading_rad},
                         {"along_m", answer.deviation.along_m},
                         {"left_m", answer.deviation.left_m},
                         {"inside", answer.deviation.inside}};
    return json;
}

}  // namespace

Response localize(const HistoryContext& context, const Request& request) {
    const auto question = read_localization(request);
    if (!question) return problem(400, question.error(), request);
    const auto answer = localization::localize(context.plant, *question);
    // The request is well formed; what it names or holds is not to be had. That is 422, never 404.
    if (!answer) return problem(422, answer.error(), request);
    return json_response(200, answer_json(*answer));
}

}  // namespace pulseline::api
