#include "api/http/wire/common_json.hpp"

#include <fmt/format.h>

#include <chrono>

namespace pulseline::api {

std::string rfc3339(Time time) {
    using std::chrono::floor;
    const std::chrono::sys_time<std::chrono::nanoseconds> at{time.time_since_epoch()};
    const auto day = floor<std::chrono::days>(at);
    const std::chrono::year_month_day date{day};
    const std::chrono::hh_mm_ss clock{floor<std::chrono::milliseconds>(at - day)};
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                       clock.hours().count(), clock.minutes().count(), clock.seconds().count(),
                       clock.subseconds().count());
}

Json point_json(const geometry::Point2& point) { return {{"x_m", point.x_m}, {"y_m", point.y_m}}; }

Json pose_json(const geometry::Pose2& pose) {
    return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"heading_rad", pose.heading_rad}};
}

Json ring_json(const geometry::Polygon& ring) { return list_json(ring, point_json); }

Json rings_json(const std::vector<geometry::Polygon>& rings) { return list_json(rings, ring_json); }

Json params_json(const Params& params) {
    Json object = Json::object();
    for (const Param& param : params) {
        std::visit([&](const auto& value) { object[param.name] = value; }, param.value);
    }
    return object;
}

Json reason_json(const Reason& reason) {
    return {{"code", reason.code}, {"params", params_json(reason.params)}};
}

Json tolerance_json(const plant::Tolerance& tolerance) {
    const bool box = tolerance.shape == plant::Tolerance::Shape::kBox;
    return {{"shape", box ? "box" : "ellipse"},
            {"dx_m", tolerance.dx_m},
            {"dy_m", tolerance.dy_m},
            {"dheading_rad", tolerance.dheading_rad}};
}

std::string dump(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Response json_response(int status, const Json& body) {
    return {status, "application/json", {{"Cache-Control", "no-store"}}, dump(body)};
}

}  // namespace pulseline::api
