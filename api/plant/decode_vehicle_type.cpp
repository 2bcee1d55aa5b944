#include "api/plant/decode_parts.hpp"

namespace pulseline::api::plant_file::decoding {

using namespace plant;

namespace {

constexpr json::NumberLimits kTilt{-0.5, 0.5};  // radians
constexpr json::NumberLimits kPercent{0, 100};
constexpr json::NumberLimits kShare{0, 1};
constexpr json::IntegerLimits kPixels{0, 100'000};

Wheel decode_wheel(ObjectReader& in) {
    Wheel wheel;
    wheel.name = in.text("name", kName);
    wheel.position = decode_point(in.object("position"));
    wheel.driven = in.boolean("driven");
    wheel.steered = in.boolean("steered");
    wheel.diameter_m = in.number("diameter_m", kMetres);
    return wheel;
}

Caster decode_caster(ObjectReader& in) {
    Caster caster;
    caster.name = in.text("name", kName);
    caster.position = decode_point(in.object("position"));
    caster.diameter_m = in.number("diameter_m", kMetres);
    return caster;
}

AxisControl decode_control(ObjectReader& in) {
    AxisControl control;
    control.cycle_s = in.number_or("cycle_s", control.cycle_s, kQuantity);
    control.drive_gain_per_s =
        in.number_or("drive_gain_per_s", control.drive_gain_per_s, kQuantity);
    control.steering_gain_per_s =
        in.number_or("steering_gain_per_s", control.steering_gain_per_s, kQuantity);
    control.lift_gain_per_s = in.number_or("lift_gain_per_s", control.lift_gain_per_s, kQuantity);
    in.refuse_unknown();
    return control;
}

DriveTemperatures decode_temperatures(ObjectReader& in) {
    DriveTemperatures limits;
    limits.warm_c = in.number("warm_c", kQuantity);
    limits.hot_c = in.number("hot_c", kQuantity);
    in.refuse_unknown();
    return limits;
}

CameraMounting decode_mounting(ObjectReader& in) {
    return {decode_pose(in.object("body_from_camera")), in.number("height_m", kMetres),
            in.number_or("tilt_u_rad", 0, kTilt), in.number_or("tilt_v_rad", 0, kTilt)};
}

// Wider than any camera for machines.
constexpr json::NumberLimits kFrameRate_hz{0.1, 1e4};
constexpr json::NumberLimits kExposure_s{1e-7, 1};

Camera decode_camera(ObjectReader& in) {
    Camera camera;
    static_cast<CameraMounting&>(camera) = decode_mounting(in);
    camera.name = in.text("name", kId);
    camera.f_px = in.number("f_px", kQuantity);
    camera.width_px = static_cast<int>(in.integer("width_px", kPixels));
    camera.height_px = static_cast<int>(in.integer("height_px", kPixels));
    camera.cu_px = in.number("cu_px", kQuantity);
    camera.cv_px = in.number("cv_px", kQuantity);
    camera.k1 = in.number_or("k1", 0, kQuantity);
    camera.frame_rate_hz = in.number_or("frame_rate_hz", camera.frame_rate_hz, kFrameRate_hz);
    camera.exposure_s = in.number_or("exposure_s", camera.exposure_s, kExposure_s);
    if (auto loaded = in.object_if_any("loaded")) {
        camera.loaded = decode_mounting(*loaded);
        loaded->refuse_unknown();
    }
    return camera;
}

Bracket decode_bracket(ObjectReader& in) {
    Bracket bracket;
    bracket.name = in.text("name", kName);
    bracket.position = decode_point(in.object("position"));
    return bracket;
}

Receiver decode_receiver(ObjectReader& in) {
    Receiver receiver;
    receiver.name = in.text("name", kId);
    receiver.position = decode_point(in.object("position"));
    receiver.z_m = in.number("z_m", kMetres);
    return receiver;
}

void decode_limits(ObjectReader& in, VehicleType& type) {
    type.max_speed_mps = in.number("max_speed_mps", kQuantity);
    type.max_accel_mps2 = in.number("max_accel_mps2", kQuantity);
    type.max_turn_rate_radps = in.number("max_turn_rate_radps", kQuantity);
    type.max_turn_accel_radps2 = in.number("max_turn_accel_radps2", kQuantity);
    type.max_steering_rate_radps =
        in.number_or("max_steering_rate_radps", type.max_steering_rate_radps, kQuantity);
    type.min_turn_radius_m = in.number_or("min_turn_radius_m", 0, kQuantity);
    type.max_arc_radius_m = in.number_or("max_arc_radius_m", type.max_arc_radius_m, kQuantity);
    type.clearance_m = in.number("clearance_m", kQuantity);
    type.height_m = in.number_or("height_m", type.height_m, kQuantity);
    type.mass_kg = in.number("mass_kg", kQuantity);
    type.max_load_kg = in.number("max_load_kg", kQuantity);
}

ParkingFoot decode_foot(ObjectReader& in) {
    ParkingFoot foot;
    foot.name = in.text("name", kName);
    foot.position = decode_point(in.object("position"));
    return foot;
}

ParkingGear decode_parking(ObjectReader& in) {
    ParkingGear parking;
    decode_all(in, "feet", kFew, parking.feet, decode_foot);
    parking.stroke_m = in.number("stroke_m", kMetres);
    parking.clearance_m = in.number("clearance_m", kMetres);
    parking.lift_m = in.number("lift_m", kMetres);
    parking.speed_mps = in.number("speed_mps", kQuantity);
    parking.rating_n = in.number("rating_n", kQuantity);
    in.refuse_unknown();
    return parking;
}

BracketLift decode_bracket_lift(ObjectReader& in) {
    BracketLift lift;
    lift.stroke_m = in.number("stroke_m", kMetres);
    lift.speed_mps = in.number("speed_mps", kQuantity);
    in.refuse_unknown();
    return lift;
}

LoadRules decode_load_rules(ObjectReader& in) {
    LoadRules rules;
    rules.bracket_rating_n = in.number_or("bracket_rating_n", 0, kQuantity);
    rules.most_unbalance = in.number_or("most_unbalance", rules.most_unbalance, kShare);
    rules.centre = decode_ring(in, "centre", false);
    in.refuse_unknown();
    return rules;
}

BatteryLimits decode_battery(ObjectReader& in) {
    BatteryLimits limits;
    limits.critical_percent = in.number("critical_percent", kPercent);
    limits.low_percent = in.number("low_percent", kPercent);
    limits.enough_percent = in.number("enough_percent", kPercent);
    in.refuse_unknown();
    return limits;
}

UsualCode decode_usual_code(ObjectReader& in) {
    UsualCode code;
    code.kind = in.one_of("kind", {MarkerKind::kQr, MarkerKind::kAprilTag, MarkerKind::kLandmark});
    code.size_m = in.number("size_m", kMetres);
    in.refuse_unknown();
    return code;
}

SlipSensor decode_slip_sensor(ObjectReader& in) {
    const SlipSensor sensor{in.number("noise_mps", kQuantity)};
    in.refuse_unknown();
    return sensor;
}

LaserScanner decode_scanner(ObjectReader& in) {
    LaserScanner scanner;
    scanner.name = in.text("name", kId);
    scanner.body_from_scanner = decode_pose(in.object("pose"));
    scanner.field_rad = in.number_or("field_rad", scanner.field_rad, kQuantity);
    scanner.step_rad = in.number_or("step_rad", scanner.step_rad, kQuantity);
    scanner.range_m = in.number_or("range_m", scanner.range_m, kMetres);
    scanner.least_range_m = in.number_or("least_range_m", scanner.least_range_m, kMetres);
    scanner.sigma_m = in.number_or("sigma_m", scanner.sigma_m, kMetres);
    scanner.most_error_m = in.number_or("most_error_m", scanner.most_error_m, kMetres);
    return scanner;
}

NavigationScanner decode_navigation_scanner(ObjectReader& in) {
    NavigationScanner scanner;
    scanner.body_from_scanner = decode_pose(in.object("pose"));
    scanner.z_m = in.number_or("z_m", scanner.z_m, kMetres);
    scanner.rate_hz = in.number_or("rate_hz", scanner.rate_hz, kQuantity);
    scanner.step_rad = in.number_or("step_rad", scanner.step_rad, kQuantity);
    scanner.range_m = in.number_or("range_m", scanner.range_m, kMetres);
    scanner.reflector_radius_m =
        in.number_or("reflector_radius_m", scanner.reflector_radius_m, kMetres);
    scanner.sigma_range_m = in.number_or("sigma_range_m", scanner.sigma_range_m, kMetres);
    scanner.sigma_bearing_rad =
        in.number_or("sigma_bearing_rad", scanner.sigma_bearing_rad, kQuantity);
    in.refuse_unknown();
    return scanner;
}

}  // namespace

VehicleType decode_vehicle_type(ObjectReader& in) {
    VehicleType type;
    type.id = decode_key<VehicleTypeId>(in, "id");
    type.name = in.text("name", kName);
    type.names = decode_names(in);
    type.kinematics = in.one_of("kinematics", {Kinematics::kSteeredPlatform, Kinematics::kMecanum,
                                               Kinematics::kDifferential});
    type.footprint = decode_ring(in, "footprint");
    type.load_footprint = decode_ring(in, "load_footprint", false);
    decode_limits(in, type);
    if (auto parking = in.object_if_any("parking")) type.parking = decode_parking(*parking);
    if (auto rules = in.object_if_any("load_rules")) type.load_rules = decode_load_rules(*rules);
    if (auto lift = in.object_if_any("bracket_lift")) {
        type.bracket_lift = decode_bracket_lift(*lift);
    }
    if (auto battery = in.object_if_any("battery")) type.battery = decode_battery(*battery);
    if (auto code = in.object_if_any("usual_code")) type.usual_code = decode_usual_code(*code);
    if (auto sensor = in.object_if_any("slip_sensor")) {
        type.slip_sensor = decode_slip_sensor(*sensor);
    }
    in.items("motion_modes", kFew, [&](const Json& item, const std::string& at) {
        const auto mode = parse_motion_mode(json::read_text(item, at, in.errors(), kId));
        if (mode) {
            type.motion_modes.push_back(*mode);
        } else if (item.is_string()) {
            std::string allowed;
            for (const MotionMode m : kMotionModes) {
                allowed += (allowed.empty() ? "" : ", ") + std::string(to_string(m));
            }
            in.errors().add(at, {"not_one_of", {{"allowed", allowed}}},
                            "Expected one of: " + allowed + ".");
        }
    });
    decode_all(in, "wheels", kFew, type.wheels, decode_wheel);
    decode_all(in, "casters", kFew, type.casters, decode_caster, false);
    if (auto control = in.object_if_any("control")) type.control = decode_control(*control);
    if (auto limits = in.object_if_any("drive_temperatures")) {
        type.drive_temperatures = decode_temperatures(*limits);
    }
    decode_all(in, "cameras", kFew, type.cameras, decode_camera);
    decode_all(in, "receivers", kFew, type.receivers, decode_receiver, false);
    if (in.has("scanners")) {
        decode_all(in, "scanners", kFew, type.scanners, decode_scanner);
    } else {
        type.scanners = usual_scanners(type.footprint);
    }
    if (auto scanner = in.object_if_any("navigation_scanner")) {
        type.navigation_scanner = decode_navigation_scanner(*scanner);
    }
    decode_all(in, "brackets", kFew, type.brackets, decode_bracket);
    return type;
}

}  // namespace pulseline::api::plant_file::decoding
