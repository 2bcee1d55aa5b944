#include "api/plant/plant_codec.hpp"

namespace pulseline::api::plant_file {

using namespace plant;

namespace {

using json::Json;

Json encode(const Point2& p) { return {{"x_m", p.x_m}, {"y_m", p.y_m}}; }

Json encode(const Pose2& p) {
    return {{"x_m", p.x_m}, {"y_m", p.y_m}, {"heading_rad", p.heading_rad}};
}

Json encode(const Polygon& polygon) {
    Json ring = Json::array();
    for (const Point2& p : polygon) ring.push_back(encode(p));
    return ring;
}

template <class Tag>
Json encode(const std::vector<Key<Tag>>& keys) {
    Json list = Json::array();
    for (const auto& key : keys) list.push_back(key.str());
    return list;
}

void put_names(Json& json, const Names& names) {
    if (!names.empty()) json["names"] = names;
}

Json encode(const Hall& hall, PlantForm form) {
    Json json = {{"id", hall.id.str()}, {"name", hall.name}, {"outline", encode(hall.outline)}};
    put_names(json, hall.names);
    if (form == PlantForm::kFile) {
        if (!hall.occupancy_yaml.empty()) json["occupancy_yaml"] = hall.occupancy_yaml;
    } else if (!hall.grid.empty()) {
        json["grid"] = {{"width", hall.grid.width},
                        {"height", hall.grid.height},
                        {"resolution_m", hall.grid.resolution_m},
                        {"origin", encode(hall.grid.origin)}};
    }
    return json;
}

Json encode(const Station& s) {
    Json json = {{"id", s.id.str()},
                 {"number", s.number},
                 {"name", s.name},
                 {"hall", s.hall.str()},
                 {"pose", encode(s.pose)},
                 {"tolerance",
                  {{"shape", to_string(s.tolerance.shape)},
                   {"dx_m", s.tolerance.dx_m},
                   {"dy_m", s.tolerance.dy_m},
                   {"dheading_rad", s.tolerance.dheading_rad}}},
                 {"markers", encode(s.markers)},
                 {"resting_place", s.resting_place},
                 {"charger", s.charger},
                 {"parks", s.parks},
                 {"vehicle_types", encode(s.vehicle_types)}};
    if (!s.node.empty()) json["node"] = s.node.str();
    if (s.support) json["support"] = {{"height_m", s.support->height_m}};
    put_names(json, s.names);
    return json;
}

Json encode(const Marker& m) {
    return {{"id", m.id.str()},           {"kind", to_string(m.kind)},
            {"payload", m.payload},       {"size_m", m.size_m},
            {"hall", m.hall.str()},       {"pose", encode(m.pose)},
            {"sigma_xy_m", m.sigma_xy_m}, {"sigma_heading_rad", m.sigma_heading_rad}};
}

Json encode(const LightPlane& p) { return {{"a", p.a}, {"b", p.b}, {"offset_m", p.offset_m}}; }

Json encode(const Transmitter& t) {
    return {{"id", t.id.str()},
            {"hall", t.hall.str()},
            {"position", encode(t.position)},
            {"z_m", t.z_m},
            {"roll_rad", t.roll_rad},
            {"pitch_rad", t.pitch_rad},
            {"heading_rad", t.heading_rad},
            {"rate_hz", t.rate_hz},
            {"first", encode(t.first)},
            {"second", encode(t.second)},
            {"range_m", t.range_m},
            {"elevation_rad", t.elevation_rad},
            {"sigma_rad", t.sigma_rad},
            {"sigma_place_m", t.sigma_place_m},
            {"sigma_turn_rad", t.sigma_turn_rad}};
}

Json encode(const Reflector& r) {
    return {{"id", r.id.str()},
            {"hall", r.hall.str()},
            {"position", encode(r.position)},
            {"sigma_m", r.sigma_m}};
}

Json encode(const Area& a) {
    Json json = {{"id", a.id.str()},
                 {"kind", to_string(a.kind)},
                 {"name", a.name},
                 {"hall", a.hall.str()},
                 {"outline", encode(a.outline)}};
    put_names(json, a.names);
    return json;
}

Json encode(const Wheel& w) {
    return {{"name", w.name},
            {"position", encode(w.position)},
            {"driven", w.driven},
            {"steered", w.steered},
            {"diameter_m", w.diameter_m}};
}

Json encode(const CameraMounting& m) {
    return {{"body_from_camera", encode(m.body_from_camera)},
            {"height_m", m.height_m},
            {"tilt_u_rad", m.tilt_u_rad},
            {"tilt_v_rad", m.tilt_v_rad}};
}

Json encode(const Camera& c) {
    Json json = encode(static_cast<const CameraMounting&>(c));
    json.update({{"name", c.name},
                 {"f_px", c.f_px},
                 {"width_px", c.width_px},
                 {"height_px", c.height_px},
                 {"cu_px", c.cu_px},
                 {"cv_px", c.cv_px},
                 {"k1", c.k1},
                 {"frame_rate_hz", c.frame_rate_hz},
                 {"exposure_s", c.exposure_s}});
    if (c.loaded) json["loaded"] = encode(*c.loaded);
    return json;
}

Json encode(const Receiver& r) {
    return {{"name", r.name}, {"position", encode(r.position)}, {"z_m", r.z_m}};
}

Json encode(const LaserScanner& s) {
    return {{"name", s.name},           {"pose", encode(s.body_from_scanner)},
            {"field_rad", s.field_rad}, {"step_rad", s.step_rad},
            {"range_m", s.range_m},     {"least_range_m", s.least_range_m},
            {"sigma_m", s.sigma_m},     {"most_error_m", s.most_error_m}};
}

Json encode(const NavigationScanner& s) {
    return {{"pose", encode(s.body_from_scanner)},
            {"z_m", s.z_m},
            {"rate_hz", s.rate_hz},
            {"step_rad", s.step_rad},
            {"range_m", s.range_m},
            {"reflector_radius_m", s.reflector_radius_m},
            {"sigma_range_m", s.sigma_range_m},
            {"sigma_bearing_rad", s.sigma_bearing_rad}};
}

Json encode(const Caster& c) {
    return {{"name", c.name}, {"position", encode(c.position)}, {"diameter_m", c.diameter_m}};
}

Json encode(const Bracket& b) { return {{"name", b.name}, {"position", encode(b.position)}}; }

Json encode(const ParkingGear& parking) {
    Json feet = Json::array();
    for (const ParkingFoot& foot : parking.feet) {
        feet.push_back({{"name", foot.name}, {"position", encode(foot.position)}});
    }
    return {{"feet", std::move(feet)},
            {"stroke_m", parking.stroke_m},
            {"clearance_m", parking.clearance_m},
            {"lift_m", parking.lift_m},
            {"speed_mps", parking.speed_mps},
            {"rating_n", parking.rating_n}};
}

Json encode(const LoadRules& rules) {
    Json json{{"most_unbalance", rules.most_unbalance}};
    if (rules.bracket_rating_n > 0) json["bracket_rating_n"] = rules.bracket_rating_n;
    if (!rules.centre.empty()) json["centre"] = encode(rules.centre);
    return json;
}

Json encode(const VehicleType& t);
Json encode(const Vehicle& v);
Json encode(const RoadmapNode& n);

Json encode(const Load& load) {
    Json json = encode_load_sheet(load);
    json["id"] = load.id.str();
    if (!load.vehicle.empty()) json["vehicle"] = load.vehicle.str();
    if (!load.station.empty()) json["station"] = load.station.str();
    return json;
}

template <class T>
Json encode_all(const std::vector<T>& items) {
    Json list = Json::array();
    for (const T& item : items) list.push_back(encode(item));
    return list;
}

Json encode(const AxisControl& control) {
    return {{"cycle_s", control.cycle_s},
            {"drive_gain_per_s", control.drive_gain_per_s},
            {"steering_gain_per_s", control.steering_gain_per_s},
            {"lift_gain_per_s", control.lift_gain_per_s}};
}

Json encode(const VehicleType& t) {
    Json modes = Json::array();
    for (const MotionMode mode : t.motion_modes) modes.push_back(to_string(mode));
    Json json = {{"id", t.id.str()},
                 {"name", t.name},
                 {"kinematics", to_string(t.kinematics)},
                 {"footprint", encode(t.footprint)},
                 {"load_footprint", encode(t.load_footprint)},
                 {"max_speed_mps", t.max_speed_mps},
                 {"max_accel_mps2", t.max_accel_mps2},
                 {"max_turn_rate_radps", t.max_turn_rate_radps},
                 {"max_turn_accel_radps2", t.max_turn_accel_radps2},
                 {"max_steering_rate_radps", t.max_steering_rate_radps},
                 {"min_turn_radius_m", t.min_turn_radius_m},
                 {"max_arc_radius_m", t.max_arc_radius_m},
                 {"clearance_m", t.clearance_m},
                 {"height_m", t.height_m},
                 {"motion_modes", std::move(modes)},
                 {"wheels", encode_all(t.wheels)},
                 {"cameras", encode_all(t.cameras)},
                 {"brackets", encode_all(t.brackets)},
                 {"mass_kg", t.mass_kg},
                 {"max_load_kg", t.max_load_kg},
                 {"battery",
                  {{"critical_percent", t.battery.critical_percent},
                   {"low_percent", t.battery.low_percent},
                   {"enough_percent", t.battery.enough_percent}}}};
    if (!t.casters.empty()) json["casters"] = encode_all(t.casters);
    json["control"] = encode(t.control);
    json["drive_temperatures"] = {{"warm_c", t.drive_temperatures.warm_c},
                                  {"hot_c", t.drive_temperatures.hot_c}};
    if (t.parking) json["parking"] = encode(*t.parking);
    if (!t.brackets.empty() || t.load_rules != LoadRules{})
        json["load_rules"] = encode(t.load_rules);
    if (!t.brackets.empty() || t.bracket_lift != BracketLift{}) {
        json["bracket_lift"] = {{"stroke_m", t.bracket_lift.stroke_m},
                                {"speed_mps", t.bracket_lift.speed_mps}};
    }
    if (!t.receivers.empty()) json["receivers"] = encode_all(t.receivers);
    json["scanners"] = encode_all(t.scanners);
    if (t.navigation_scanner) json["navigation_scanner"] = encode(*t.navigation_scanner);
    json["usual_code"] = {{"kind", to_string(t.usual_code.kind)}, {"size_m", t.usual_code.size_m}};
    if (t.slip_sensor) json["slip_sensor"] = {{"noise_mps", t.slip_sensor->noise_mps}};
    put_names(json, t.names);
    return json;
}

Json encode(const Vehicle& v) {
    return {{"id", v.id.str()},
            {"type", v.type.str()},
            {"manufacturer", v.manufacturer},
            {"serial_number", v.serial_number},
            {"name", v.name},
            {"home", v.home.str()}};
}

Json encode(const RoadmapNode& n) {
    return {{"id", n.id.str()}, {"hall", n.hall.str()}, {"position", encode(n.position)}};
}

Json encode(const Corridor& c) { return {{"left_m", c.left_m}, {"right_m", c.right_m}}; }

Json encode(const RoadmapEdge& e, PlantForm form) {
    Json json = {{"id", e.id.str()}, {"from", e.from.str()}, {"to", e.to.str()}};
    if (e.max_speed_mps != 0) json["max_speed_mps"] = e.max_speed_mps;
    if (form == PlantForm::kApi || !e.vehicle_types.empty()) {
        json["vehicle_types"] = encode(e.vehicle_types);
    }
    if (e.corridor) json["corridor"] = encode(*e.corridor);
    return json;
}

/// Arrays of objects at depth <= `open` go over several lines, everything else on one.
void print(const Json& json, int open, const std::string& indent, std::string& out) {
    if (open == 0 || !json.is_structured() || json.empty()) {
        out += json.dump();
        return;
    }
    const bool object = json.is_object();
    const std::string inner = indent + "  ";
    out += object ? "{\n" : "[\n";
    bool first = true;
    for (const auto& [key, value] : json.items()) {
        if (!first) out += ",\n";
        first = false;
        out += inner;
        if (object) out += Json(key).dump() + ": ";
        print(value, value.is_array() || key == "roadmap" ? open - 1 : 0, inner, out);
    }
    out += "\n" + indent + (object ? "}" : "]");
}

}  // namespace

Json encode_load_sheet(const Load& load) {
    Json json = {{"name", load.name}, {"kind", to_string(load.kind)}, {"mass_kg", load.mass_kg}};
    if (!load.model.empty()) json["model"] = load.model;
    if (!(load.centre == Point2{})) json["centre"] = encode(load.centre);
    if (!load.outline.empty()) json["outline"] = encode(load.outline);
    if (!load.vehicle_types.empty()) json["vehicle_types"] = encode(load.vehicle_types);
    put_names(json, load.names);
    return json;
}

Json encode_plant(const Plant& plant, PlantForm form) {
    Json halls = Json::array();
    for (const Hall& hall : plant.halls) halls.push_back(encode(hall, form));
    Json edges = Json::array();
    for (const RoadmapEdge& edge : plant.edges) edges.push_back(encode(edge, form));
    Json json = {{"id", plant.id},
                 {"name", plant.name},
                 {"revision", plant.revision},
                 {"halls", std::move(halls)},
                 {"stations", encode_all(plant.stations)},
                 {"markers", encode_all(plant.markers)},
                 {"areas", encode_all(plant.areas)},
                 {"vehicle_types", encode_all(plant.vehicle_types)},
                 {"vehicles", encode_all(plant.vehicles)},
                 {"roadmap", {{"nodes", encode_all(plant.nodes)}, {"edges", std::move(edges)}}},
                 {"routing",
                  {{"k_same", plant.routing.k_same},
                   {"k_diff", plant.routing.k_diff},
                   {"reference_step_m", plant.routing.reference_step_m},
                   {"turn_threshold_rad", plant.routing.turn_threshold_rad}}}};
    if (plant.routing.accuracy_k > 0) json["routing"]["accuracy_k"] = plant.routing.accuracy_k;
    if (!plant.transmitters.empty()) json["transmitters"] = encode_all(plant.transmitters);
    if (!plant.reflectors.empty()) json["reflectors"] = encode_all(plant.reflectors);
    if (!plant.loads.empty()) json["loads"] = encode_all(plant.loads);
    put_names(json, plant.names);
    return json;
}

std::string plant_to_json(const Plant& plant) {
    std::string out;
    print(encode_plant(plant, PlantForm::kFile), 3, "", out);
    return out + "\n";
}

}  // namespace pulseline::api::plant_file
