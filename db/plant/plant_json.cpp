#include "db/plant/plant_json.hpp"

#include <nlohmann/json.hpp>

#include "db/error.hpp"
#include "db/json_number.hpp"
#include "db/json_text.hpp"

namespace pulseline::db {
namespace {

using Json = nlohmann::json;
using geometry::Point2;

Json number(double value) { return finite(value, "a number of the plant"); }
Json encode(const Point2& p) { return Json::array({number(p.x_m), number(p.y_m)}); }
Point2 decode_point(const Json& j) { return {j.at(0), j.at(1)}; }

template <class T, class Encode>
std::string list_to_json(const std::vector<T>& items, Encode encode_item) {
    Json list = Json::array();
    for (const T& item : items) list.push_back(encode_item(item));
    return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

template <class T, class Decode>
std::vector<T> list_from_json(const std::string& text, Decode decode_item) {
    try {
        std::vector<T> items;
        for (const Json& item : Json::parse(text)) items.push_back(decode_item(item));
        return items;
    } catch (const Json::exception&) {
        throw Error(Error::Kind::kBadValue,
                    "The database holds a damaged plant; import it again or restore a backup.");
    }
}

Json mounting_to_json(const plant::CameraMounting& m) {
    return {{"x_m", number(m.body_from_camera.x_m)},
            {"y_m", number(m.body_from_camera.y_m)},
            {"heading_rad", number(m.body_from_camera.heading_rad)},
            {"height_m", number(m.height_m)},
            {"tilt_u_rad", number(m.tilt_u_rad)},
            {"tilt_v_rad", number(m.tilt_v_rad)}};
}
plant::CameraMounting mounting_from_json(const Json& j) {
    return {{j.at("x_m"), j.at("y_m"), j.at("heading_rad")},
            j.at("height_m"),
            j.value("tilt_u_rad", 0.0),
            j.value("tilt_v_rad", 0.0)};
}

}  // namespace

std::string polygon_to_json(const plant::Polygon& polygon) {
    return list_to_json(polygon, [](const Point2& p) { return encode(p); });
}
plant::Polygon polygon_from_json(const std::string& text) {
    return list_from_json<Point2>(text, decode_point);
}

std::string names_to_json(const std::vector<plant::EdgeId>& edges) {
    return list_to_json(edges, [](const plant::EdgeId& edge) { return Json(edge.str()); });
}
std::vector<plant::EdgeId> edges_from_json(const std::string& text) {
    return list_from_json<plant::EdgeId>(
        text, [](const Json& j) { return plant::EdgeId(j.get<std::string>()); });
}

std::string wheels_to_json(const std::vector<plant::Wheel>& wheels) {
    return list_to_json(wheels, [](const plant::Wheel& w) {
        return Json{{"name", w.name},
                    {"position", encode(w.position)},
                    {"driven", w.driven},
                    {"steered", w.steered},
                    {"diameter_m", number(w.diameter_m)}};
    });
}
std::vector<plant::Wheel> wheels_from_json(const std::string& text) {
    return list_from_json<plant::Wheel>(text, [](const Json& j) {
        return plant::Wheel{j.at("name"), decode_point(j.at("position")), j.at("driven"),
                            j.at("steered"), j.at("diameter_m")};
    });
}

std::string cameras_to_json(const std::vector<plant::Camera>& cameras) {
    return list_to_json(cameras, [](const plant::Camera& c) {
        Json json = mounting_to_json(c);
        json.update({{"name", c.name},
                     {"f_px", number(c.f_px)},
                     {"width_px", c.width_px},
                     {"height_px", c.height_px},
                     {"cu_px", number(c.cu_px)},
                     {"cv_px", number(c.cv_px)},
                     {"k1", number(c.k1)},
                     {"frame_rate_hz", number(c.frame_rate_hz)},
                     {"exposure_s", number(c.exposure_s)}});
        if (c.loaded) json["loaded"] = mounting_to_json(*c.loaded);
        return json;
    });
}
std::vector<plant::Camera> cameras_from_json(const std::string& text) {
    return list_from_json<plant::Camera>(text, [](const Json& j) {
        plant::Camera camera{mounting_from_json(j),
                             j.at("name"),
                             j.at("f_px"),
                             whole<int>(j.at("width_px")),
                             whole<int>(j.at("height_px")),
                             j.at("cu_px"),
                             j.at("cv_px"),
                             j.at("k1")};
        // Stored before cameras had them, they are what they were then for all.
        camera.frame_rate_hz = j.value("frame_rate_hz", camera.frame_rate_hz);
        camera.exposure_s = j.value("exposure_s", camera.exposure_s);
        if (j.contains("loaded")) camera.loaded = mounting_from_json(j.at("loaded"));
        return camera;
    });
}

std::string receivers_to_json(const std::vector<plant::Receiver>& receivers) {
    return list_to_json(receivers, [](const plant::Receiver& r) {
        return Json{{"name", r.name}, {"position", encode(r.position)}, {"z_m", number(r.z_m)}};
    });
}
std::vector<plant::Receiver> receivers_from_json(const std::string& text) {
    return list_from_json<plant::Receiver>(text, [](const Json& j) {
        return plant::Receiver{j.at("name"), decode_point(j.at("position")), j.at("z_m")};
    });
}

std::string scanners_to_json(const std::vector<plant::LaserScanner>& scanners) {
    return list_to_json(scanners, [](const plant::LaserScanner& s) {
        const plant::Pose2& at = s.body_from_scanner;
        return Json{{"name", s.name},
                    {"x_m", number(at.x_m)},
                    {"y_m", number(at.y_m)},
                    {"heading_rad", number(at.heading_rad)},
                    {"field_rad", number(s.field_rad)},
                    {"step_rad", number(s.step_rad)},
                    {"range_m", number(s.range_m)},
                    {"least_range_m", number(s.least_range_m)},
                    {"sigma_m", number(s.sigma_m)},
                    {"most_error_m", number(s.most_error_m)}};
    });
}
std::vector<plant::LaserScanner> scanners_from_json(const std::string& text) {
    return list_from_json<plant::LaserScanner>(text, [](const Json& j) {
        return plant::LaserScanner{
            j.at("name"),      {j.at("x_m"), j.at("y_m"), j.at("heading_rad")},
            j.at("field_rad"), j.at("step_rad"),
            j.at("range_m"),   j.at("least_range_m"),
            j.at("sigma_m"),   j.at("most_error_m")};
    });
}

std::string scanner_to_json(const std::optional<plant::NavigationScanner>& scanner) {
    if (!scanner) return "null";
    const plant::Pose2& at = scanner->body_from_scanner;
    return Json{{"x_m", number(at.x_m)},
                {"y_m", number(at.y_m)},
                {"heading_rad", number(at.heading_rad)},
                {"z_m", number(scanner->z_m)},
                {"rate_hz", number(scanner->rate_hz)},
                {"step_rad", number(scanner->step_rad)},
                {"range_m", number(scanner->range_m)},
                {"reflector_radius_m", number(scanner->reflector_radius_m)},
                {"sigma_range_m", number(scanner->sigma_range_m)},
                {"sigma_bearing_rad", number(scanner->sigma_bearing_rad)}}
        .dump();
}
std::optional<plant::NavigationScanner> scanner_from_json(const std::string& text) {
    const auto scanners = list_from_json<plant::NavigationScanner>(
        "[" + (text == "null" ? "" : text) + "]", [](const Json& j) {
            return plant::NavigationScanner{{j.at("x_m"), j.at("y_m"), j.at("heading_rad")},
                                            j.at("z_m"),
                                            j.at("rate_hz"),
                                            j.at("step_rad"),
                                            j.at("range_m"),
                                            j.at("reflector_radius_m"),
                                            j.at("sigma_range_m"),
                                            j.at("sigma_bearing_rad")};
        });
    if (scanners.empty()) return std::nullopt;
    return scanners.front();
}

std::string brackets_to_json(const std::vector<plant::Bracket>& brackets) {
    return list_to_json(brackets, [](const plant::Bracket& b) {
        return Json{{"name", b.name}, {"position", encode(b.position)}};
    });
}
std::vector<plant::Bracket> brackets_from_json(const std::string& text) {
    return list_from_json<plant::Bracket>(text, [](const Json& j) {
        return plant::Bracket{j.at("name"), decode_point(j.at("position"))};
    });
}

std::string parking_to_json(const std::optional<plant::ParkingGear>& parking) {
    if (!parking) return "null";
    Json feet = Json::array();
    for (const plant::ParkingFoot& foot : parking->feet) {
        feet.push_back({{"name", foot.name}, {"position", encode(foot.position)}});
    }
    return Json{{"feet", feet},
                {"stroke_m", number(parking->stroke_m)},
                {"clearance_m", number(parking->clearance_m)},
                {"lift_m", number(parking->lift_m)},
                {"speed_mps", number(parking->speed_mps)},
                {"rating_n", number(parking->rating_n)}}
        .dump(-1, ' ', false, Json::error_handler_t::replace);
}
std::optional<plant::ParkingGear> parking_from_json(const std::string& text) {
    const auto stored = list_from_json<plant::ParkingGear>(
        "[" + (text == "null" ? "" : text) + "]", [](const Json& j) {
            plant::ParkingGear parking{{},
                                       j.at("stroke_m"),
                                       j.at("clearance_m"),
                                       j.at("lift_m"),
                                       j.at("speed_mps"),
                                       j.at("rating_n")};
            for (const Json& foot : j.at("feet")) {
                parking.feet.push_back({foot.at("name"), decode_point(foot.at("position"))});
            }
            return parking;
        });
    if (stored.empty()) return std::nullopt;
    return stored.front();
}

std::string load_rules_to_json(const plant::LoadRules& rules) {
    Json centre = Json::array();
    for (const Point2& corner : rules.centre) centre.push_back(encode(corner));
    return Json{{"bracket_rating_n", number(rules.bracket_rating_n)},
                {"most_unbalance", number(rules.most_unbalance)},
                {"centre", centre}}
        .dump();
}
plant::LoadRules load_rules_from_json(const std::string& text) {
    const auto stored = list_from_json<plant::LoadRules>(
        "[" + (text == "null" ? "" : text) + "]", [](const Json& j) {
            plant::LoadRules rules{j.at("bracket_rating_n"), j.at("most_unbalance"), {}};
            for (const Json& corner : j.at("centre")) rules.centre.push_back(decode_point(corner));
            return rules;
        });
    return stored.empty() ? plant::LoadRules{} : stored.front();
}

std::string bracket_lift_to_json(const plant::BracketLift& lift) {
    return Json{{"stroke_m", number(lift.stroke_m)}, {"speed_mps", number(lift.speed_mps)}}.dump();
}
plant::BracketLift bracket_lift_from_json(const std::string& text) {
    const auto stored = list_from_json<plant::BracketLift>(
        "[" + (text == "null" ? "" : text) + "]", [](const Json& j) {
            return plant::BracketLift{j.at("stroke_m"), j.at("speed_mps")};
        });
    return stored.empty() ? plant::BracketLift{} : stored.front();
}

std::string casters_to_json(const std::vector<plant::Caster>& casters) {
    return list_to_json(casters, [](const plant::Caster& c) {
        return Json{{"name", c.name},
                    {"position", encode(c.position)},
                    {"diameter_m", number(c.diameter_m)}};
    });
}
std::vector<plant::Caster> casters_from_json(const std::string& text) {
    return list_from_json<plant::Caster>(text, [](const Json& j) {
        return plant::Caster{j.at("name"), decode_point(j.at("position")), j.at("diameter_m")};
    });
}

std::string control_to_json(const plant::AxisControl& control) {
    return Json{{"cycle_s", number(control.cycle_s)},
                {"drive_gain_per_s", number(control.drive_gain_per_s)},
                {"steering_gain_per_s", number(control.steering_gain_per_s)},
                {"lift_gain_per_s", number(control.lift_gain_per_s)}}
        .dump();
}
plant::AxisControl control_from_json(const std::string& text) {
    const auto stored = list_from_json<plant::AxisControl>(
        "[" + (text == "null" ? "" : text) + "]", [](const Json& j) {
            return plant::AxisControl{j.at("cycle_s"), j.at("drive_gain_per_s"),
                                      j.at("steering_gain_per_s"), j.at("lift_gain_per_s")};
        });
    return stored.empty() ? plant::AxisControl{} : stored.front();
}

}  // namespace pulseline::db
