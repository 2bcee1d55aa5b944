#include "api/vda5050/factsheet.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "api/vda5050/limits.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::vda5050 {
namespace {

using plant::Kinematics;
using plant::VehicleType;

// The plant file does not say it; no message depends on it.
constexpr double kWheelWidth_m = 0.15;

/// Of codes VDA 5050 has a word for squares only, and none for iGPS.
Json localization_types(const FactsheetSource& source) {
    const VehicleType& type = *source.type;
    Json types = Json::array();
    if (!type.cameras.empty() && type.usual_code.kind != plant::MarkerKind::kLandmark) {
        types.push_back("DMC");
    }
    if (source.has_map) types.push_back("NATURAL");
    if (type.navigation_scanner) types.push_back("REFLECTOR");
    return types;
}

Json parameter(const char* key, const char* type, bool optional = false) {
    return {{"key", key}, {"valueDataType", type}, {"isOptional", optional}};
}

Json parameters_of(const std::string& action) {
    if (action == kMeasureStop || action == kAdjustToMarker) {
        return Json::array({parameter("stationId", "STRING"), parameter("stationNumber", "INTEGER"),
                            parameter("target", "OBJECT"), parameter("tolerance", "OBJECT"),
                            parameter("markers", "ARRAY")});
    }
    if (action == kInitPosition) {
        return Json::array({parameter("x", "NUMBER"), parameter("y", "NUMBER"),
                            parameter("theta", "NUMBER"), parameter("mapId", "STRING"),
                            parameter("lastNodeId", "STRING", true),
                            parameter("sigma_xy_m", "NUMBER", true),
                            parameter("sigma_heading_rad", "NUMBER", true)});
    }
    if (action == kObserveMarkers) {
        return Json::array({parameter("markers", "ARRAY"),
                            parameter("segmentMarkers", "ARRAY", true),
                            parameter("boundaryMarker", "STRING", true)});
    }
    if (action == kFinePositioning) {
        return Json::array(
            {parameter("stationType", "STRING", true), parameter("stationName", "STRING", true)});
    }
    if (action == kSetReflectors) return Json::array({parameter("reflectors", "ARRAY")});
    if (action == kSetTransmitters) return Json::array({parameter("transmitters", "ARRAY")});
    if (action == kSetBracketHeight) {
        return Json::array({parameter("bracket", "STRING"), parameter("height_m", "NUMBER"),
                            parameter("speed_mps", "NUMBER", true)});
    }
    if (action == kPick) {
        return Json::array({parameter("loadId", "STRING"), parameter("weight", "NUMBER", true)});
    }
    if (action == kLowerParking || action == kRaiseParking) {
        return Json::array({parameter("foot", "STRING", true)});
    }
    return Json::array();
}

Json encode_actions(const FactsheetSource& source) {
    std::vector<std::string> types = source.instant_actions;
    for (const auto* more : {&source.node_actions, &source.edge_actions}) {
        for (const auto& type : *more) {
            if (std::find(types.begin(), types.end(), type) == types.end()) types.push_back(type);
        }
    }
    Json list = Json::array();
    for (const auto& type : types) {
        const auto in = [&](const std::vector<std::string>& some) {
            return std::find(some.begin(), some.end(), type) != some.end();
        };
        Json scopes = Json::array();
        if (in(source.instant_actions)) scopes.push_back("INSTANT");
        if (in(source.node_actions)) scopes.push_back("NODE");
        if (in(source.edge_actions)) scopes.push_back("EDGE");
        // blockingTypes is left out: its schema asks for a list that is a single word.
        list.push_back({{"actionType", type},
                        {"actionScopes", std::move(scopes)},
                        {"actionParameters", parameters_of(type)}});
    }
    return list;
}

Json encode_outline(const char* name, const geometry::Polygon& outline) {
    Json points = Json::array();
    for (const auto& point : outline) {
        points.push_back({{"x", finite(point.x_m)}, {"y", finite(point.y_m)}});
    }
    return {{"set", name}, {"polygonPoints", std::move(points)}};
}

Json encode_geometry(const VehicleType& type) {
    Json wheels = Json::array();
    for (const auto& wheel : type.wheels) {
        const char* kind = type.kinematics == Kinematics::kMecanum ? "MECANUM"
                           : wheel.driven || wheel.steered         ? "DRIVE"
                                                                   : "CASTER";
        wheels.push_back(
            {{"type", kind},
             {"isActiveDriven", wheel.driven},
             {"isActiveSteered", wheel.steered},
             {"position", {{"x", finite(wheel.position.x_m)}, {"y", finite(wheel.position.y_m)}}},
             {"diameter", finite(wheel.diameter_m)},
             {"width", kWheelWidth_m},
             {"constraints", wheel.name}});
    }
    for (const auto& caster : type.casters) {
        const auto& at = caster.position;
        wheels.push_back({{"type", "CASTER"},
                          {"isActiveDriven", false},
                          {"isActiveSteered", false},
                          {"position", {{"x", finite(at.x_m)}, {"y", finite(at.y_m)}}},
                          {"diameter", finite(caster.diameter_m)},
                          {"width", kWheelWidth_m},
                          {"constraints", caster.name}});
    }
    Json envelopes = Json::array({encode_outline("unloaded", type.footprint)});
    if (!type.load_footprint.empty()) {
        envelopes.push_back(encode_outline("load", type.load_footprint));
    }
    return {{"wheelDefinitions", std::move(wheels)}, {"envelopes2d", std::move(envelopes)}};
}

Json encode_physical(const FactsheetSource& source) {
    const VehicleType& type = *source.type;
    const double factor = source.time_factor;
    const auto box = geometry::bounding_box(type.footprint);
    const double accel = finite(type.max_accel_mps2 * factor * factor);
    return {{"speedMin", 0.0},
            {"speedMax", finite(type.max_speed_mps * factor)},
            {"accelerationMax", accel},
            {"decelerationMax", accel},
            {"heightMax", finite(type.height_m)},
            {"width", finite(box.max.y_m - box.min.y_m)},
            {"length", finite(box.max.x_m - box.min.x_m)}};
}

/// 0 where a vehicle does not say it.
double top_speed(json::ObjectReader& physical) {
    const double said = physical.number("speedMax", limits::kSpeed_mps);
    if (said == 0) return 0;
    return physical.number("speedMax", {limits::kLeastTopSpeed_mps, limits::kSpeed_mps.max});
}

}  // namespace

std::string encode_factsheet(const FactsheetSource& source, const Header& header) {
    const VehicleType& type = *source.type;
    Json out = begin_message(header);
    out["typeSpecification"] = {
        {"seriesName", type.name},
        {"agvKinematic", type.kinematics == Kinematics::kDifferential ? "DIFF" : "OMNI"},
        {"agvClass", "CARRIER"},
        {"maxLoadMass", finite(type.max_load_kg)},
        {"localizationTypes", localization_types(source)},
        {"navigationTypes", {"VIRTUAL_LINE_GUIDED"}}};
    out["physicalParameters"] = encode_physical(source);
    out["protocolLimits"] = {{"maxStringLens", Json::object()},
                             {"maxArrayLens", {{"order.nodes", 2000}, {"order.edges", 2000}}},
                             {"timing",
                              {{"minOrderInterval", 0.0},
                               {"minStateInterval", source.min_state_interval_s},
                               {"defaultStateInterval", source.state_interval_s},
                               {"visualizationInterval", source.visualization_interval_s}}}};
    Json parameters = Json::array();
    for (const char* name : {"order.nodes.nodePosition.theta", "order.edges.orientation",
                             "order.edges.trajectory", "order.edges.rotationAllowed"}) {
        parameters.push_back({{"parameter", name}, {"support", "SUPPORTED"}});
    }
    out["protocolFeatures"] = {{"optionalParameters", std::move(parameters)},
                               {"agvActions", encode_actions(source)}};
    out["agvGeometry"] = encode_geometry(type);
    out["loadSpecification"] = Json::object();
    return print(out);
}

Result<Factsheet> decode_factsheet(const Json& payload) {
    json::FieldErrors errors;
    json::ObjectReader in(payload, "", errors);
    Factsheet factsheet;
    auto type = in.object("typeSpecification");
    factsheet.series_name = type.text("seriesName", {0, 200});
    auto physical = in.object("physicalParameters");
    factsheet.speed_max_mps = top_speed(physical);
    factsheet.acceleration_max_mps2 =
        physical.number("accelerationMax", limits::kAcceleration_mps2);
    factsheet.length_m = physical.number("length", limits::kLength_m);
    factsheet.width_m = physical.number("width", limits::kLength_m);
    auto features = in.object("protocolFeatures");
    features.items("agvActions", {0, 500}, [&](const Json& item, const std::string& at) {
        json::ObjectReader action(item, at, errors);
        factsheet.actions.push_back(action.text("actionType", {1, 200}));
        action.items_if_any("actionScopes", {0, 10}, [&](const Json& scope, const std::string&) {
            if (scope == "NODE") factsheet.node_actions.push_back(factsheet.actions.back());
            if (scope == "INSTANT") factsheet.instant_actions.push_back(factsheet.actions.back());
        });
    });
    if (auto status = errors.status(); !status) return fail(status.error());
    factsheet.json = print(payload);
    return factsheet;
}

}  // namespace pulseline::vda5050
