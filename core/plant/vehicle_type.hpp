#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/key.hpp"
#include "core/geometry/polygon.hpp"
#include "core/geometry/pose2.hpp"

/// What a plant knows of a kind of vehicle: plain data as a plant file states it.
namespace pulseline::plant {

using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;

using VehicleTypeId = Key<struct VehicleTypeTag>;

/// How a vehicle travels one leg. kAuto asks the planner to choose. kOblique
/// keeps the heading on the way and turns at its end, kCombined turns on the way (Wang's oblique
/// and combined moves); both are for vehicles that can move in any direction.
enum class MotionMode {
    kAuto,
    kSelfRotation,
    kLinear,
    kFixedAxisRotation,
    kLateral,
    kOblique,
    kCombined,
    kFree
};
/// All of them in the order people see them in, kAuto first.
inline constexpr std::initializer_list<MotionMode> kMotionModes{
    MotionMode::kAuto,         MotionMode::kLinear,  MotionMode::kFixedAxisRotation,
    MotionMode::kSelfRotation, MotionMode::kLateral, MotionMode::kOblique,
    MotionMode::kCombined,     MotionMode::kFree};
enum class Kinematics { kSteeredPlatform, kMecanum, kDifferential };
enum class MarkerKind { kQr, kAprilTag, kLandmark };

/// What a thing is called in other languages than its `name` is in, by language tag ("zh").
using Names = std::map<std::string, std::string>;

struct Wheel {
    std::string name;  // "FL", "drive front"
    Point2 position;   // body frame, y to the left
    bool driven = false;
    bool steered = false;
    double diameter_m = 0;
};

/// A wheel that swivels and rolls as the vehicle moves: it bears a little of the middle of a long
/// body and tells nothing (Tang 2020, section 2.1).
struct Caster {
    std::string name;  // "middle left front"
    Point2 position;   // body frame
    double diameter_m = 0;
};

/// How the controller of a machine moves its axes (Tang 2020, section 2.1, figures 2 and 3): the
/// vehicle's program sends set points every cycle, and the controller closes the position loop of
/// each axis, which is proportional. The axes are those of the type's wheels, brackets and feet
/// (axes_of).
struct AxisControl {
    double cycle_s = 0.01;           // whole milliseconds
    double drive_gain_per_s = 3.5;   // of what rolls a wheel: the paper's
    double steering_gain_per_s = 8;  // of what turns one about its vertical axis
    double lift_gain_per_s = 10;     // of a bracket or a foot
    bool operator==(const AxisControl&) const = default;
};

/// Of the servo drives of wheels: where people are told, and where a drive switches itself off,
/// until it is cooler than warm_c.
struct DriveTemperatures {
    double warm_c = 65;
    double hot_c = 90;
    bool operator==(const DriveTemperatures&) const = default;
};

/// How a camera hangs over the floor, from calibration: where the foot of its optical centre,
/// straight below it, lies in the body frame, and how the image's +u axis is turned against body x.
struct CameraMounting {
    Pose2 body_from_camera;
    double height_m = 0.455;
    /// Of the optical axis against the plumb line: turned first towards +u, then towards +v.
    double tilt_u_rad = 0;
    double tilt_v_rad = 0;
};

/// Downward camera (core/vision/README.md).
struct Camera : CameraMounting {
    std::string name;  // "front", "back"
    double f_px = 3317.78;
    int width_px = 1280;
    int height_px = 1024;
    double cu_px = 639.5;
    double cv_px = 511.5;
    double k1 = 0;
    // While it drives: pictures a second, and how long each is exposed, by the light of a flash.
    double frame_rate_hz = 60;
    double exposure_s = 2e-4;
    /// When the vehicle carries its load, under which the body gives; none: as without.
    std::optional<CameraMounting> loaded = {};
};

/// Of iGPS, on a vehicle: where its light-sensitive middle sits, from calibration.
struct Receiver {
    std::string name;  // "front left"
    Point2 position;   // body frame
    double z_m = 0.6;  // above the floor
};

/// A laser scanner that sees at which distance something stands around, level with it. As the
/// UST-10LX's data sheet has it, and Li 2022 in section 5.1 (its section 5.2 prints +-4 mm for
/// most_error_m, which is that of the scanner beside it), unless the plant says otherwise.
struct LaserScanner {
    std::string name;         // "front left"
    Pose2 body_from_scanner;  // x in the middle of its field, from calibration
    double field_rad = 270 * 3.14159265358979323846 / 180;
    double step_rad = 0.25 * 3.14159265358979323846 / 180;
    double range_m = 10;
    double least_range_m = 0.06;
    double sigma_m = 0.012;      // one sigma, of one ray
    double most_error_m = 0.04;  // no return is farther off than that
};

/// A laser scanner that looks all round for reflectors, from above what drives about. As the
/// NAV350's data sheet has it, unless the plant says otherwise.
struct NavigationScanner {
    Pose2 body_from_scanner;  // from calibration
    double z_m = 2.0;         // above the floor
    double rate_hz = 8;       // turns a second
    double step_rad = 0.25 * 3.14159265358979323846 / 180;
    double range_m = 70;                // at which it still knows a reflector
    double reflector_radius_m = 0.040;  // all of its hall are alike
    // One sigma, of one ray that is full of reflector.
    double sigma_range_m = 0.008;
    double sigma_bearing_rad = 2e-4;
};

struct Bracket {
    std::string name;  // "front left"
    Point2 position;   // body frame
};

/// How the brackets of a type lift (Tang 2020, section 2.1: a screw lift each).
struct BracketLift {
    double stroke_m = 0.3;    // from the lower end to the upper one
    double speed_mps = 0.01;  // at most
    bool operator==(const BracketLift&) const = default;
};

/// What a load has to be like for a vehicle to drive with it; how it is judged: load_rules.hpp.
struct LoadRules {
    double bracket_rating_n = 0;   // the most on one bracket; 0: the type states none
    double most_unbalance = 0.10;  // of a bracket from the mean of its end, as a share of it
    Polygon centre;  // where its centre of gravity may lie, body frame; empty: between the wheels
    bool operator==(const LoadRules&) const = default;
};

struct ParkingFoot {
    std::string name;  // "front left"
    Point2 position;   // body frame
};

/// A foot further out than this holds its vehicle: by less its reports tremble, and one that
/// was stopped just below its upper switch is far off the floor.
inline constexpr double kFootDown_m = 0.002;

/// Feet on which a vehicle stands while it is worked on (Tang 2020, section 2.1: parking
/// mechanism).
struct ParkingGear {
    std::vector<ParkingFoot> feet;
    double stroke_m = 0.15;     // from the upper switch to the lower one
    double clearance_m = 0.10;  // over even floor, all up
    double lift_m = 0.02;       // by so much all raise the vehicle once they stand
    double speed_mps = 0.02;
    double rating_n = 1.2e5;  // of each of them
};

/// When the fleet sends a vehicle of its own accord to a charger, and takes it away again.
struct BatteryLimits {
    double critical_percent = 15;  // below: it is given no order any more
    double low_percent = 30;       // below: it goes to charge when it has no order
    double enough_percent = 60;    // from here on it may be taken off the charger
};

/// What a vehicle's cameras look for when no order says it.
struct UsualCode {
    MarkerKind kind = MarkerKind::kQr;
    double size_m = 0.060;
};

/// Free-rolling measuring wheels beside the driven ones. They show whether those slip, and are too
/// coarse for odometry.
struct SlipSensor {
    double noise_mps = 0;  // one sigma of one look, each wheel
};

struct VehicleType {
    VehicleTypeId id;
    std::string name;
    Kinematics kinematics = Kinematics::kSteeredPlatform;
    Polygon footprint;       // body frame, vehicle alone
    Polygon load_footprint;  // body frame, outline of what it usually carries; may be empty
    double max_speed_mps = 1.0;
    double max_accel_mps2 = 0.2;
    double max_turn_rate_radps = 0.1;
    double max_turn_accel_radps2 = 0.05;
    double max_steering_rate_radps = 0.8;  // of steered wheels, about their vertical axis
    double min_turn_radius_m = 0;          // of arcs; 0: none
    double max_arc_radius_m = 200;         // above it an arc is a straight line with a hidden drift
    double clearance_m = 0.5;              // distance kept from walls and other vehicles
    double height_m = 1.2;                 // without its load
    double length_m() const;
    std::vector<MotionMode> motion_modes;
    std::vector<Wheel> wheels;
    std::vector<Caster> casters;
    AxisControl control;
    DriveTemperatures drive_temperatures;
    std::vector<Camera> cameras;
    std::vector<Receiver> receivers;     // of iGPS; none: it does not navigate by it
    std::vector<LaserScanner> scanners;  // none: it sees nothing that stands in its way
    std::optional<NavigationScanner> navigation_scanner = {};  // none: not by reflectors
    UsualCode usual_code;
    std::optional<SlipSensor> slip_sensor;  // none: nobody sees a wheel that slips alone
    std::vector<Bracket> brackets;
    std::optional<ParkingGear> parking = {};  // none: it stands on its wheels only
    double mass_kg = 0;
    double max_load_kg = 0;
    LoadRules load_rules;
    BracketLift bracket_lift;
    BatteryLimits battery;
    Names names;
};

/// Where a plant says nothing: two, at opposite corners, each looking away from the body.
std::vector<LaserScanner> usual_scanners(const Polygon& footprint);
/// Of a type with brackets that was stored before its feet were: at the corners of the footprint.
ParkingGear usual_parking(const Polygon& footprint);
/// One servo axis of a type, with the gain of its position loop.
struct Axis {
    std::string name;  // "front drive/drive", "FL/steering", "front left/bracket", "back left/foot"
    double position_gain_per_s = 0;
    bool operator==(const Axis&) const = default;
};
/// All of them: what drives and steers its wheels, then brackets, then feet, each in its order.
std::vector<Axis> axes_of(const VehicleType& type);
/// The convex hull of the wheels' places, body frame.
Polygon wheel_base(const VehicleType& type);
/// The cameras as they hang with or without load.
std::vector<Camera> cameras_of(const VehicleType& type, bool loaded);
/// Footprint of vehicle and load together (convex pieces, body frame).
std::vector<Polygon> outline_with_load(const VehicleType& type, bool loaded);
/// Greatest distance of a point of an outline from the body's origin.
double reach_m(const std::vector<Polygon>& outline);

const char* to_string(MotionMode mode);  // "self_rotation"
std::optional<MotionMode> parse_motion_mode(const std::string& text);
const char* to_string(Kinematics kinematics);  // "steered_platform"
const char* to_string(MarkerKind kind);        // "qr", "apriltag", "landmark"
std::optional<MarkerKind> parse_marker_kind(const std::string& name);

}  // namespace pulseline::plant
