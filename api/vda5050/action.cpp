#include "api/vda5050/action.hpp"

#include <charconv>
#include <cmath>
#include <utility>
#include <variant>

#include "api/vda5050/beacons.hpp"
#include "api/vda5050/limits.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::vda5050 {

// Beside the type, so that the reader finds it.
static const char* to_string(BlockingType type) {
    switch (type) {
        case BlockingType::kNone:
            return "NONE";
        case BlockingType::kSoft:
            return "SOFT";
        case BlockingType::kHard:
            return "HARD";
    }
    return "";
}

namespace {

using geometry::Pose2;

/// Parameters as name -> value.
class Parameters {
public:
    Parameters(json::ObjectReader& action) : object_(Json::object()) {
        action.items_if_any("actionParameters", {0, 100},
                            [&](const Json& item, const std::string& pointer) {
                                json::ObjectReader in(item, pointer, action.errors());
                                const std::string key = in.text("key", {1, 200});
                                const Json* value = in.required("value");
                                if (value != nullptr) object_[key] = *value;
                            });
    }
    const Json& object() const { return object_; }

private:
    Json object_;
};

Json pose_json(const Pose2& pose) {
    return {{"x_m", finite(pose.x_m)},
            {"y_m", finite(pose.y_m)},
            {"heading_rad", finite(pose.heading_rad)}};
}

Json markers_json(const std::vector<SurveyedMarker>& markers) {
    Json list = Json::array();
    for (const auto& marker : markers) {
        list.push_back({{"payload", marker.payload},
                        {"kind", marker.kind},
                        {"size_m", finite(marker.size_m)},
                        {"x_m", finite(marker.pose.x_m)},
                        {"y_m", finite(marker.pose.y_m)},
                        {"angle_rad", finite(marker.pose.heading_rad)},
                        {"sigma_m", finite(marker.sigma_m)},
                        {"sigma_rad", finite(marker.sigma_rad)}});
    }
    return list;
}

Json stop_parameters(const StopTarget& target) {
    return {{"stationId", target.station_id},
            {"stationNumber", target.station_number},
            {"target", pose_json(target.target)},
            {"tolerance",
             {{"x_m", finite(target.tolerance_x_m)},
              {"y_m", finite(target.tolerance_y_m)},
              {"heading_rad", finite(target.tolerance_heading_rad)}}},
            {"markers", markers_json(target.markers)}};
}

Pose2 read_pose(json::ObjectReader& in, const char* heading = "heading_rad") {
    return {in.number("x_m", limits::kPlace_m), in.number("y_m", limits::kPlace_m),
            in.number(heading, limits::kAngle_rad)};
}

std::vector<SurveyedMarker> read_markers(json::ObjectReader& in, json::CountLimits count) {
    std::vector<SurveyedMarker> markers;
    in.items("markers", count, [&](const Json& item, const std::string& pointer) {
        json::ObjectReader marker(item, pointer, in.errors());
        SurveyedMarker read;
        read.payload = marker.text("payload", {1, 200});
        read.kind = marker.text("kind", {1, 64});
        read.size_m = marker.number("size_m", {1e-3, 10});
        read.pose = read_pose(marker, "angle_rad");
        read.sigma_m = marker.number_or("sigma_m", 0, limits::kSigma_m);
        read.sigma_rad = marker.number_or("sigma_rad", 0, limits::kSigma_rad);
        markers.push_back(std::move(read));
    });
    return markers;
}

void read_observed(json::ObjectReader& in, Action& action) {
    action.markers = read_markers(in, {1, 64});
    in.items_if_any("segmentMarkers", {0, 64}, [&](const Json& item, const std::string& pointer) {
        action.segment_markers.push_back(json::read_text(item, pointer, in.errors(), {1, 200}));
    });
    action.boundary_marker = in.text_or("boundaryMarker", "", {0, 200});
}

StopTarget read_stop(json::ObjectReader& in) {
    StopTarget target;
    target.station_id = in.text("stationId", {0, 200});
    target.station_number = static_cast<int>(in.integer("stationNumber", {0, 1'000'000}));
    auto pose = in.object("target");
    target.target = read_pose(pose);
    auto tolerance = in.object("tolerance");
    target.tolerance_x_m = tolerance.number("x_m", limits::kSigma_m);
    target.tolerance_y_m = tolerance.number("y_m", limits::kSigma_m);
    target.tolerance_heading_rad = tolerance.number("heading_rad", limits::kSigma_rad);
    target.markers = read_markers(in, {0, 64});
    return target;
}

/// A number, or its text: strings are seen in the wild for initPosition.
double lenient_number(json::ObjectReader& in, const char* name, json::NumberLimits within) {
    const Json* value = in.required(name);
    if (value == nullptr) return 0;
    const std::string pointer = json::child_pointer(in.pointer(), std::string_view(name));
    if (!value->is_string()) return json::read_number(*value, pointer, in.errors(), within);
    const auto& text = value->get_ref<const std::string&>();
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) {
        in.errors().add(pointer, {"wrong_type", {{"expected", std::string("number")}}},
                        "the value of " + std::string(name) + " is no number");
        return 0;
    }
    return json::read_number(number, pointer, in.errors(), within);
}

InitPosition read_init_position(json::ObjectReader& in) {
    InitPosition init;
    init.pose = {lenient_number(in, "x", limits::kPlace_m),
                 lenient_number(in, "y", limits::kPlace_m),
                 wrap(lenient_number(in, "theta", limits::kAngle_rad))};
    init.map_id = in.text("mapId", {1, 200});
    init.last_node_id = in.text_or("lastNodeId", "", {0, 200});
    init.sigma_xy_m = in.number_or("sigma_xy_m", 0, limits::kSigma_m);
    init.sigma_heading_rad = in.number_or("sigma_heading_rad", 0, limits::kSigma_rad);
    init.worked_out = in.boolean_or("workedOut", false);
    return init;
}

Json init_parameters(const InitPosition& init) {
    Json parameters = {{"x", finite(init.pose.x_m)},
                       {"y", finite(init.pose.y_m)},
                       {"theta", finite(init.pose.heading_rad)},
                       {"mapId", init.map_id},
                       {"lastNodeId", init.last_node_id}};
    if (init.sigma_xy_m > 0) {
        parameters["sigma_xy_m"] = finite(init.sigma_xy_m);
        parameters["sigma_heading_rad"] = finite(init.sigma_heading_rad);
    }
    if (init.worked_out) parameters["workedOut"] = true;
    return parameters;
}

Params plain_parameters(json::ObjectReader& in, const Json& object) {
    Params params;
    for (const auto& [key, value] : object.items()) {
        if (value.is_boolean()) params.push_back({key, value.get<bool>()});
        const auto pointer = json::child_pointer(in.pointer(), std::string_view(key));
        if (value.is_number_integer()) {
            params.push_back({key, json::read_integer(value, pointer, in.errors())});
        }
        if (value.is_number_float()) {
            params.push_back(
                {key, json::read_number(value, pointer, in.errors(), limits::kParameter)});
        }
        if (value.is_string()) params.push_back({key, value.get<std::string>()});
    }
    return params;
}

}  // namespace

Json encode_action(const Action& action) {
    Json object = Json::object();
    for (const auto& param : action.params) {
        std::visit([&](const auto& value) { object[param.name] = value; }, param.value);
    }
    if (action.stop_target) object.update(stop_parameters(*action.stop_target));
    if (action.init_position) object.update(init_parameters(*action.init_position));
    if (!action.markers.empty()) object["markers"] = markers_json(action.markers);
    if (!action.segment_markers.empty()) object["segmentMarkers"] = action.segment_markers;
    if (!action.boundary_marker.empty()) object["boundaryMarker"] = action.boundary_marker;
    if (action.type == kSetTransmitters) {
        object["transmitters"] = transmitters_json(action.transmitters);
    }
    if (action.type == kSetReflectors) object["reflectors"] = reflectors_json(action.reflectors);
    Json parameters = Json::array();
    for (const auto& [key, value] : object.items()) {
        parameters.push_back({{"key", key}, {"value", value}});
    }
    return {{"actionType", action.type},
            {"actionId", action.id},
            {"blockingType", to_string(action.blocking)},
            {"actionParameters", std::move(parameters)}};
}

Action decode_action(const Json& value, const std::string& pointer, json::FieldErrors& errors) {
    json::ObjectReader in(value, pointer, errors);
    Action action;
    action.type = in.text("actionType", {1, 200});
    action.id = in.text("actionId", {1, 200});
    action.blocking =
        in.one_of("blockingType", {BlockingType::kNone, BlockingType::kSoft, BlockingType::kHard});
    const Parameters parameters(in);
    json::ObjectReader read(parameters.object(), pointer + "/actionParameters", errors);
    if (action.type == kMeasureStop || action.type == kAdjustToMarker) {
        action.stop_target = read_stop(read);
    } else if (action.type == kInitPosition) {
        action.init_position = read_init_position(read);
    } else if (action.type == kObserveMarkers) {
        read_observed(read, action);
    } else if (action.type == kSetTransmitters) {
        action.transmitters = read_transmitters(read);
    } else if (action.type == kSetReflectors) {
        action.reflectors = read_reflectors(read);
    } else {
        action.params = plain_parameters(read, parameters.object());
    }
    return action;
}

std::string encode_measurement(const StopMeasurement& measurement) {
    Json result = pose_json(measurement.pose);
    result["sigma_xy_m"] = finite(measurement.sigma_xy_m);
    result["sigma_heading_rad"] = finite(measurement.sigma_heading_rad);
    result["method"] = measurement.method;
    result["markers"] = measurement.markers;
    if (measurement.arrived) result["arrived"] = pose_json(*measurement.arrived);
    return print(result);
}

Result<StopMeasurement> decode_measurement(std::string_view text) {
    const auto parsed = json::parse_json(text);
    if (!parsed) return fail(parsed.error());
    json::FieldErrors errors;
    json::ObjectReader in(*parsed, "", errors);
    StopMeasurement found;
    found.pose = read_pose(in);
    found.pose.heading_rad = wrap(found.pose.heading_rad);
    found.sigma_xy_m = in.number_or("sigma_xy_m", 0, limits::kSigma_m);
    found.sigma_heading_rad = in.number_or("sigma_heading_rad", 0, limits::kSigma_rad);
    found.method = in.text_or("method", "", {0, 64});
    in.items_if_any("markers", {0, 64}, [&](const Json& item, const std::string& pointer) {
        found.markers.push_back(json::read_text(item, pointer, errors, {1, 200}));
    });
    if (auto arrived = in.object_if_any("arrived")) {
        found.arrived = read_pose(*arrived);
        found.arrived->heading_rad = wrap(found.arrived->heading_rad);
    }
    if (auto status = errors.status(); !status) return fail(status.error());
    return found;
}

}  // namespace pulseline::vda5050
