#include "tests/core/plant/broken_plant.hpp"

// Faults of vehicle types.
namespace pulseline::plant {
namespace {

const Case kCases[] = {
    {"SpeedZero", [](Plant& p) { p.vehicle_types[0].max_speed_mps = 0; },
     "/vehicle_types/0/max_speed_mps", "not_positive"},
    {"ClearanceNegative", [](Plant& p) { p.vehicle_types[0].clearance_m = -0.1; },
     "/vehicle_types/0/clearance_m", "negative"},
    {"ArcRadiiCrossed", [](Plant& p) { p.vehicle_types[0].min_turn_radius_m = 300; },
     "/vehicle_types/0/max_arc_radius_m", "arc_radii"},
    {"CameraWithoutFocus", [](Plant& p) { p.vehicle_types[0].cameras[0].f_px = 0; },
     "/vehicle_types/0/cameras/0/f_px", "not_positive"},
    {"CameraWithoutPictures", [](Plant& p) { p.vehicle_types[0].cameras[0].frame_rate_hz = 0; },
     "/vehicle_types/0/cameras/0/frame_rate_hz", "not_positive"},
    {"CameraWithoutExposure", [](Plant& p) { p.vehicle_types[0].cameras[0].exposure_s = 0; },
     "/vehicle_types/0/cameras/0/exposure_s", "not_positive"},
    {"LoadedCameraInTheFloor",
     [](Plant& p) {
         p.vehicle_types[0].cameras[0].loaded = CameraMounting{{}, 0, 0, 0};
     },
     "/vehicle_types/0/cameras/0/loaded/height_m", "not_positive"},
    {"DifferentialGoesSideways",
     [](Plant& p) {
         p.vehicle_types[0].kinematics = Kinematics::kDifferential;
         p.vehicle_types[0].motion_modes = {MotionMode::kLinear, MotionMode::kOblique};
     },
     "/vehicle_types/0/motion_modes", "mode_not_for_wheels"},
    {"SteeredWheelsTurnOnTheWay",
     [](Plant& p) {
         p.vehicle_types[0].kinematics = Kinematics::kSteeredPlatform;
         p.vehicle_types[0].motion_modes = {MotionMode::kCombined};
     },
     "/vehicle_types/0/motion_modes", "mode_not_for_wheels"},
    {"ScannerNowhere",
     [](Plant& p) {
         p.vehicle_types[0].scanners = {{"nose", {0, kNan, 0}}};
     },
     "/vehicle_types/0/scanners/0/pose/y_m", "not_finite"},
    {"ScannerSeesAllRound",
     [](Plant& p) {
         p.vehicle_types[0].scanners = {{"nose", {}}};
         p.vehicle_types[0].scanners[0].field_rad = 6.3;
     },
     "/vehicle_types/0/scanners/0/field_rad", "scanner_field"},
    {"ScannerOfTooManyRays",
     [](Plant& p) {
         p.vehicle_types[0].scanners = {{"nose", {}}};
         p.vehicle_types[0].scanners[0].step_rad = 1e-6;
     },
     "/vehicle_types/0/scanners/0/step_rad", "scanner_step"},
    {"ScannerEndsBeforeItBegins",
     [](Plant& p) {
         p.vehicle_types[0].scanners = {{"nose", {}}};
         p.vehicle_types[0].scanners[0].range_m = 0.05;
     },
     "/vehicle_types/0/scanners/0/range_m", "scanner_range"},
    {"ScannerBetterThanExact",
     [](Plant& p) {
         p.vehicle_types[0].scanners = {{"nose", {}}};
         p.vehicle_types[0].scanners[0].sigma_m = -0.01;
     },
     "/vehicle_types/0/scanners/0/sigma_m", "negative"},
    {"TwoScannersOfOneName",
     [](Plant& p) {
         p.vehicle_types[0].scanners = {{"nose", {}}, {"nose", {}}};
     },
     "/vehicle_types/0/scanners/1/name", "duplicate_scanner"},
    {"WheelWithoutDiameter", [](Plant& p) { p.vehicle_types[0].wheels[0].diameter_m = 0; },
     "/vehicle_types/0/wheels/0/diameter_m", "not_positive"},
    {"FootprintClockwise",
     [](Plant& p) {
         std::reverse(p.vehicle_types[0].footprint.begin(), p.vehicle_types[0].footprint.end());
     },
     "/vehicle_types/0/footprint", "clockwise"},
    {"FootprintBesideItsOrigin",
     [](Plant& p) {
         p.vehicle_types[0].footprint = {{5, 5}, {6, 5}, {6, 6}, {5, 6}};
     },
     "/vehicle_types/0/footprint", "centre_outside"},
    {"TwoCamerasOfOneName",
     [](Plant& p) { p.vehicle_types[0].cameras.push_back(p.vehicle_types[0].cameras[0]); },
     "/vehicle_types/0/cameras/1/name", "duplicate_camera"},
    {"NoMotionMode", [](Plant& p) { p.vehicle_types[0].motion_modes.clear(); },
     "/vehicle_types/0/motion_modes", "no_motion_mode"},
    {"BatteryLimitsOutOfOrder", [](Plant& p) { p.vehicle_types[0].battery.low_percent = 5; },
     "/vehicle_types/0/battery", "battery_limits"},
    {"FeetOnOneSide",
     [](Plant& p) {
         p.vehicle_types[0].parking = usual_parking(p.vehicle_types[0].footprint);
         for (auto& foot : p.vehicle_types[0].parking->feet) foot.position.x_m += 100;
     },
     "/vehicle_types/0/parking/feet", "feet_do_not_hold"},
    {"FeetTooShort",
     [](Plant& p) {
         p.vehicle_types[0].parking = usual_parking(p.vehicle_types[0].footprint);
         p.vehicle_types[0].parking->lift_m = 0.06;
     },
     "/vehicle_types/0/parking/stroke_m", "stroke_too_short"},
    {"FeetTooWeak",
     [](Plant& p) {
         p.vehicle_types[0].parking = usual_parking(p.vehicle_types[0].footprint);
         p.vehicle_types[0].mass_kg = 60000;
     },
     "/vehicle_types/0/parking/rating_n", "feet_too_weak"},
    {"LoadCentreBeyondTheWheels",
     [](Plant& p) {
         VehicleType& type = p.vehicle_types[0];
         type.brackets = {{"middle", {0, 0}}};
         type.wheels = {{"a", {1, 1}, false, false, 0.2},
                        {"b", {-1, 1}, false, false, 0.2},
                        {"c", {0, -1}, false, false, 0.2}};
         type.load_rules.centre = {{-0.3, -0.9}, {0.3, -0.9}, {0, 0.5}};
     },
     "/vehicle_types/0/load_rules/centre", "outside_wheel_base"},
    {"LoadCentreWithoutBrackets",
     [](Plant& p) {
         p.vehicle_types[0].brackets.clear();
         p.vehicle_types[0].wheels.clear();
         p.vehicle_types[0].load_rules.centre = {{0, 0}, {0.1, 0}, {0, 0.1}};
     },
     "/vehicle_types/0/load_rules/centre", "without_brackets"},
    {"LoadWithNoUnbalanceAtAll", [](Plant& p) { p.vehicle_types[0].load_rules.most_unbalance = 0; },
     "/vehicle_types/0/load_rules/most_unbalance", "not_positive"},
    {"BracketsWithoutStroke", [](Plant& p) { p.vehicle_types[0].bracket_lift.stroke_m = 0; },
     "/vehicle_types/0/bracket_lift/stroke_m", "not_positive"},
    {"CasterWithoutSize",
     [](Plant& p) {
         p.vehicle_types[0].casters = {{"middle", {0, 0}, 0}};
     },
     "/vehicle_types/0/casters/0/diameter_m", "not_positive"},
    {"CastersOfOneName",
     [](Plant& p) {
         p.vehicle_types[0].casters = {{"middle", {0, 0}, 0.2}, {"middle", {1, 0}, 0.2}};
     },
     "/vehicle_types/0/casters/1/name", "duplicate_caster"},
    {"BracketsOfOneName",
     [](Plant& p) {
         auto& brackets = p.vehicle_types[0].brackets;
         brackets = {{"front", {0.1, 0}}, {"front", {0, 0}}};
     },
     "/vehicle_types/0/brackets/1/name", "duplicate_bracket"},
    {"CycleOfNoController", [](Plant& p) { p.vehicle_types[0].control.cycle_s = 0.2; },
     "/vehicle_types/0/control/cycle_s", "cycle"},
    {"CycleOfHalfMilliseconds", [](Plant& p) { p.vehicle_types[0].control.cycle_s = 0.0105; },
     "/vehicle_types/0/control/cycle_s", "cycle"},
    {"AxesWithoutGain", [](Plant& p) { p.vehicle_types[0].control.drive_gain_per_s = 0; },
     "/vehicle_types/0/control/drive_gain_per_s", "not_positive"},
    {"GainThatSwings", [](Plant& p) { p.vehicle_types[0].control.steering_gain_per_s = 26; },
     "/vehicle_types/0/control/steering_gain_per_s", "gain_too_high"},
    {"GainThatSwingsAtItsCycle",
     [](Plant& p) { p.vehicle_types[0].control.cycle_s = 0.03; },  // lifts: 10 /s
     "/vehicle_types/0/control/lift_gain_per_s", "gain_too_high"},
    {"HotBelowWarm",
     [](Plant& p) {
         p.vehicle_types[0].drive_temperatures = {80, 70};
     },
     "/vehicle_types/0/drive_temperatures/hot_c", "temperature_limits"},
};

class BrokenType : public testing::TestWithParam<Case> {};

TEST_P(BrokenType, IsNamedWithARemedy) { expect_named(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Each, BrokenType, testing::ValuesIn(kCases), name_of);

}  // namespace
}  // namespace pulseline::plant
