#include "api/http/vehicles/camera_handlers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "api/http/vehicles/unknown.hpp"
#include "api/http/wire/problem.hpp"
#include "api/localization/image_bytes.hpp"
#include "core/plant/marker_geometry.hpp"
#include "core/vision/papers/tang_picture.hpp"

namespace pulseline::api {
namespace {

/// "Sat, 21 Nov 2026 03:50:36 GMT" (RFC 9110).
std::string http_date(Time time) {
    constexpr const char* kDays[] = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
    constexpr const char* kMonths[] = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                       "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    const std::chrono::sys_time<std::chrono::nanoseconds> at{time.time_since_epoch()};
    const auto day = std::chrono::floor<std::chrono::days>(at);
    const std::chrono::year_month_day date{day};
    const std::chrono::hh_mm_ss clock{std::chrono::floor<std::chrono::seconds>(at - day)};
    return fmt::format(
        "{}, {:02} {} {:04} {:02}:{:02}:{:02} GMT", kDays[std::chrono::weekday(day).c_encoding()],
        static_cast<unsigned>(date.day()), kMonths[static_cast<unsigned>(date.month()) - 1],
        static_cast<int>(date.year()), clock.hours().count(), clock.minutes().count(),
        clock.seconds().count());
}

enum class Step { kGrey, kEdges, kCorners };

std::optional<Step> parse_step(const std::string& text) {
    if (text == "grey") return Step::kGrey;
    if (text == "edges") return Step::kEdges;
    if (text == "corners") return Step::kCorners;
    return std::nullopt;
}

Error no_image(const std::string& camera) {
    return unknown("no_image", camera, "This camera has sent no picture yet; try again later.");
}

/// Of the codes that it looks for; all of one vehicle have one size.
double code_size_m(const plant::Plant& plant, const plant::Vehicle& vehicle) {
    const auto* home = plant::find_station(plant, vehicle.home);
    for (const auto& id : home != nullptr ? home->markers : std::vector<plant::MarkerId>{}) {
        if (const auto* marker = plant::find_marker(plant, id)) return marker->size_m;
    }
    return plant::usual_size_m(plant::MarkerKind::kQr);
}

Response step_of(const EncodeContext& context, const Request& request, Step step) {
    const auto* vehicle = plant::find_vehicle(context.plant, plant::VehicleId(request.param("id")));
    const std::string& name = request.param("camera");
    const auto* type = plant::find_vehicle_type(context.plant, vehicle->type);
    const auto camera = std::ranges::find(type->cameras, name, &plant::Camera::name);
    const auto image = context.images.newest(vehicle->id, name);
    if (camera == type->cameras.end() || !image) return problem(no_image(name), request);
    const auto grey = localization::decode_grey(image->bytes, name);
    if (!grey) {
        return problem(unknown("no_image", name,
                               "The newest picture of this camera cannot be read; look at what "
                               "the vehicle sends."),
                       request);
    }
    const auto steps = vision::tang_steps(*grey, *camera, code_size_m(context.plant, *vehicle));
    const cv::Mat shown = step == Step::kGrey    ? steps.smooth
                          : step == Step::kEdges ? steps.edges
                                                 : vision::tang_picture(*grey, steps, *camera);
    return {200,
            "image/png",
            {{"Cache-Control", "no-store"}, {"Last-Modified", http_date(image->taken)}},
            localization::encode_png(shown)};
}

}  // namespace

Response get_camera_image(const InlineContext& context, const Request& request) {
    const plant::VehicleId id(request.param("id"));
    if (plant::find_vehicle(context.plant, id) == nullptr) {
        return problem(unknown_vehicle(id.str()), request);
    }
    const auto image = context.images.newest(id, request.param("camera"));
    if (!image) {
        return problem(no_image(request.param("camera")), request);
    }
    return {200,
            image->mime,
            {{"Cache-Control", "no-store"}, {"Last-Modified", http_date(image->taken)}},
            image->bytes};
}

// Some milliseconds of work, so not the sockets' thread's and not the fleet's.
FleetAnswer get_camera_step(FleetContext& context, const Request& request) {
    const plant::VehicleId id(request.param("id"));
    if (plant::find_vehicle(context.plant, id) == nullptr) {
        return {problem(unknown_vehicle(id.str()), request)};
    }
    const auto step = parse_step(request.param("step"));
    if (!step) {
        return {problem(unknown("unknown_step", request.param("step"),
                                "The steps are grey, edges and corners."),
                        request)};
    }
    FleetAnswer answer;
    answer.encode = [request, step = *step](const EncodeContext& encode) {
        return step_of(encode, request, step);
    };
    return answer;
}

}  // namespace pulseline::api
