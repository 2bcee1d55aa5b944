#include "core/plant/validate.hpp"
#include "tests/core/plant/loads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace pulseline::plant {
namespace {

RoadmapNode node(const char* id, double x_m, double y_m) {
    return {NodeId(id), HallId("main"), {x_m, y_m}};
}

Station station(int number, const Pose2& pose) {
    Station s;
    s.id = StationId("st" + std::to_string(number));
    s.number = number;
    s.hall = HallId("main");
    s.pose = pose;
    s.node = NodeId("n" + std::to_string(number));
    s.markers = {MarkerId("m" + std::to_string(number))};
    s.resting_place = true;
    s.vehicle_types = {VehicleTypeId("cart")};
    return s;
}

Marker marker(int number, const Pose2& pose) {
    Marker m;
    m.id = MarkerId("m" + std::to_string(number));
    m.payload = "ST0" + std::to_string(number) + "-F";
    m.hall = HallId("main");
    m.pose = pose;
    return m;
}

/// A hall of 30 m x 20 m with a column in its grid, two stations, one cart.
Plant sound_plant() {
    Plant plant;
    plant.id = "small";
    Hall hall;
    hall.id = HallId("main");
    hall.outline = {{0, 0}, {30, 0}, {30, 20}, {0, 20}};
    hall.grid = {60, 40, 0.5, {0, 0}, std::vector<std::uint8_t>(60 * 40, 0)};
    hall.grid.occupied[20 * 60 + 30] = 1;  // 15 m, 10 m
    plant.halls = {hall};
    VehicleType cart;
    cart.id = VehicleTypeId("cart");
    cart.footprint = geometry::rectangle(4, 2);
    cart.load_footprint = geometry::rectangle(3, 6);
    cart.motion_modes = {MotionMode::kLinear};
    cart.wheels = {{"drive", {1, 0}, true, true, 0.3}};
    Camera front;
    front.name = "front";
    front.body_from_camera = {1.5, 0, 0};
    cart.cameras = {front};
    cart.max_load_kg = 100;
    plant.vehicle_types = {cart};
    plant.stations = {station(1, {6, 10, 0}), station(2, {24, 10, kPi / 2})};
    plant.markers = {marker(1, {7.5, 10, 0}), marker(2, {24, 11.5, 0})};
    plant.areas = {
        {AreaId("z"), AreaKind::kZone, "zone", HallId("main"), {{1, 1}, {9, 1}, {9, 9}}, {}},
        {AreaId("jig"),
         AreaKind::kObstacle,
         "jig",
         HallId("main"),
         {{14, 2}, {16, 2}, {16, 4}, {14, 4}},
         {}}};
    Vehicle first;
    first.id = VehicleId("C-1");
    first.type = VehicleTypeId("cart");
    first.manufacturer = "maker";
    first.serial_number = "C-1";
    first.home = StationId("st1");
    Vehicle second = first;
    second.id = VehicleId("C-2");
    second.serial_number = "C-2";
    second.home = StationId("st2");
    plant.vehicles = {first, second};
    plant.nodes = {node("n1", 6, 10), node("n2", 24, 10), node("mid", 15, 14)};
    plant.edges = {{EdgeId("a"), NodeId("n1"), NodeId("mid"), 0, {}},
                   {EdgeId("b"), NodeId("mid"), NodeId("n1"), 0, {}},
                   {EdgeId("c"), NodeId("mid"), NodeId("n2"), 0, {VehicleTypeId("cart")}},
                   {EdgeId("d"), NodeId("n2"), NodeId("mid"), 0, {}}};
    return plant;
}

struct Case {
    const char* name;
    std::function<void(Plant&)> damage;
    const char* element;
    const char* code;
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const Case kCases[] = {
    {"DuplicateHall", [](Plant& p) { p.halls.push_back(p.halls[0]); }, "/halls/1/id",
     "duplicate_id"},
    {"NoHall", [](Plant& p) { p.halls.clear(); }, "/halls", "no_hall"},
    {"EmptyPlantId", [](Plant& p) { p.id = ""; }, "/id", "empty_id"},
    {"DuplicateStationId", [](Plant& p) { p.stations[1].id = StationId("st1"); }, "/stations/1/id",
     "duplicate_id"},
    {"DuplicateStationNumber", [](Plant& p) { p.stations[1].number = 1; }, "/stations/1/number",
     "duplicate_number"},
    {"NegativeStationNumber", [](Plant& p) { p.stations[1].number = -1; }, "/stations/1/number",
     "negative"},
    {"DuplicatePayload", [](Plant& p) { p.markers[1].payload = "ST01-F"; }, "/markers/1/payload",
     "duplicate_payload"},
    {"EmptyPayload", [](Plant& p) { p.markers[1].payload = ""; }, "/markers/1/payload",
     "empty_payload"},
    {"LandmarkCodeOutOfRange",
     [](Plant& p) {
         p.markers[1].kind = MarkerKind::kLandmark;
         p.markers[1].payload = "255";
     },
     "/markers/1/payload", "bad_payload"},
    {"UnknownHallOfStation", [](Plant& p) { p.stations[0].hall = HallId("x"); }, "/stations/0/hall",
     "unknown_hall"},
    {"UnknownMarker", [](Plant& p) { p.stations[0].markers = {MarkerId("x")}; },
     "/stations/0/markers/0", "unknown_marker"},
    {"UnknownNode", [](Plant& p) { p.stations[0].node = NodeId("x"); }, "/stations/0/node",
     "unknown_node"},
    {"OnFreeFloorOfVehiclesThatNeedLanes", [](Plant& p) { p.stations[0].node = {}; },
     "/stations/0/node", "node_missing"},
    {"UnknownTypeAtStation", [](Plant& p) { p.stations[0].vehicle_types.emplace_back("x"); },
     "/stations/0/vehicle_types/1", "unknown_vehicle_type"},
    {"UnknownTypeOfVehicle", [](Plant& p) { p.vehicles[0].type = VehicleTypeId("x"); },
     "/vehicles/0/type", "unknown_vehicle_type"},
    {"UnknownHome", [](Plant& p) { p.vehicles[0].home = StationId("x"); }, "/vehicles/0/home",
     "unknown_station"},
    {"UnknownHallOfArea", [](Plant& p) { p.areas[0].hall = HallId("x"); }, "/areas/0/hall",
     "unknown_hall"},
    {"UnknownHallOfNode", [](Plant& p) { p.nodes[2].hall = HallId("x"); }, "/roadmap/nodes/2/hall",
     "unknown_hall"},
    {"UnknownNodeOfEdge", [](Plant& p) { p.edges[0].to = NodeId("x"); }, "/roadmap/edges/0/to",
     "unknown_node"},
    {"UnknownTypeOfEdge", [](Plant& p) { p.edges[2].vehicle_types = {VehicleTypeId("x")}; },
     "/roadmap/edges/2/vehicle_types/0", "unknown_vehicle_type"},
    {"CorridorOfNoWidth",
     [](Plant& p) {
         p.edges[0].corridor = {0, 2};
     },
     "/roadmap/edges/0/corridor/left_m", "not_positive"},
    {"CorridorNotFinite",
     [](Plant& p) {
         p.edges[0].corridor = {2, kNan};
     },
     "/roadmap/edges/0/corridor/right_m", "not_finite"},
    {"CorridorOverNoGo",
     [](Plant& p) {
         const Point2 at = find_node(p, p.edges[0].from)->position;
         p.edges[0].corridor = {2, 2};
         p.areas[0].kind = AreaKind::kNoGo;
         p.areas[0].outline = {{at.x_m - 1, at.y_m - 1},
                               {at.x_m + 1, at.y_m - 1},
                               {at.x_m + 1, at.y_m + 1},
                               {at.x_m - 1, at.y_m + 1}};
     },
     "/roadmap/edges/0/corridor", "corridor_over_no_go"},
    {"StationNotFinite", [](Plant& p) { p.stations[0].pose.x_m = kNan; }, "/stations/0/pose/x_m",
     "not_finite"},
    {"OutlineNotFinite", [](Plant& p) { p.areas[0].outline[1].y_m = INFINITY; }, "/areas/0/outline",
     "not_finite"},
    {"ToleranceZero", [](Plant& p) { p.stations[0].tolerance.dy_m = 0; },
     "/stations/0/tolerance/dy_m", "not_positive"},
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
    {"MarkerWithoutSize", [](Plant& p) { p.markers[0].size_m = 0; }, "/markers/0/size_m",
     "not_positive"},
    {"Overloaded", [](Plant& p) { builders::put_on(p, 0, "A-101", 101); }, "/loads/0/mass_kg",
     "overloaded"},
    {"LoadAtTwoPlaces",
     [](Plant& p) {
         builders::put_on(p, 0, "A-101");
         p.loads[0].station = p.stations[0].id;
     },
     "/loads/0/station", "two_places"},
    {"LoadWhereNothingHoldsIt",
     [](Plant& p) {
         builders::put_on(p, 0, "A-101");
         p.loads[0].vehicle = {};
         p.loads[0].station = p.stations[0].id;
     },
     "/loads/0/station", "without_support"},
    {"LoadOnNobody",
     [](Plant& p) {
         builders::put_on(p, 0, "A-101");
         p.loads[0].vehicle = VehicleId("none");
     },
     "/loads/0/vehicle", "unknown_vehicle"},
    {"TwoLoadsOnOne",
     [](Plant& p) {
         builders::put_on(p, 0, "A-101");
         builders::put_on(p, 0, "A-102");
     },
     "/loads/1/vehicle", "place_taken"},
    {"LoadWithItsNameTwice",
     [](Plant& p) {
         builders::put_on(p, 0, "A-101");
         builders::put_on(p, 1, "A-101");
     },
     "/loads/1/id", "duplicate_id"},
    {"LoadForNobody",
     [](Plant& p) {
         builders::put_on(p, 0, "A-101");
         p.loads[0].vehicle_types = {VehicleTypeId("none")};
     },
     "/loads/0/vehicle_types/0", "unknown_vehicle_type"},
    {"LoadLargerThanItsTypeIsPlannedWith",
     [](Plant& p) {
         builders::put_on(p, 0, "A-101");
         p.loads[0].outline = geometry::rectangle(50, 50);
     },
     "/loads/0/vehicle", "load_too_large"},
    {"SupportBelowTheFloor", [](Plant& p) { p.stations[0].support = Support{-0.1}; },
     "/stations/0/support/height_m", "negative"},
    {"TurnsCheaper", [](Plant& p) { p.routing.k_diff = 1; }, "/routing/k_diff", "turns_cheaper"},
    {"AccuracyBelowNothing", [](Plant& p) { p.routing.accuracy_k = -1; }, "/routing/accuracy_k",
     "negative"},
    {"TwoCorners", [](Plant& p) { p.areas[0].outline.resize(2); }, "/areas/0/outline",
     "too_few_points"},
    {"HallCrossesItself", [](Plant& p) { std::swap(p.halls[0].outline[0], p.halls[0].outline[1]); },
     "/halls/0/outline", "not_simple"},
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
    {"GridOfWrongSize", [](Plant& p) { p.halls[0].grid.occupied.pop_back(); },
     "/halls/0/occupancy_yaml", "grid_size"},
    {"TwoCamerasOfOneName",
     [](Plant& p) { p.vehicle_types[0].cameras.push_back(p.vehicle_types[0].cameras[0]); },
     "/vehicle_types/0/cameras/1/name", "duplicate_camera"},
    {"NoMotionMode", [](Plant& p) { p.vehicle_types[0].motion_modes.clear(); },
     "/vehicle_types/0/motion_modes", "no_motion_mode"},
    {"SerialWithASlash", [](Plant& p) { p.vehicles[0].serial_number = "C/1"; },
     "/vehicles/0/serial_number", "bad_identity"},
    {"ManufacturerWithASpace", [](Plant& p) { p.vehicles[0].manufacturer = "my maker"; },
     "/vehicles/0/manufacturer", "bad_identity"},
    {"SameIdentity", [](Plant& p) { p.vehicles[1].serial_number = "C-1"; },
     "/vehicles/1/serial_number", "duplicate_identity"},
    {"SharedHome", [](Plant& p) { p.vehicles[1].home = StationId("st1"); }, "/vehicles/1/home",
     "duplicate_home"},
    {"HomeNoRestingPlace", [](Plant& p) { p.stations[0].resting_place = false; },
     "/vehicles/0/home", "home_no_resting_place"},
    {"ChargerNoRestingPlace",
     [](Plant& p) {
         p.stations[1].resting_place = false;
         p.stations[1].charger = true;
     },
     "/stations/1/charger", "charger_no_resting_place"},
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
    {"HomeOfAnotherType",
     [](Plant& p) {
         VehicleType other = p.vehicle_types[0];
         other.id = VehicleTypeId("other");
         p.vehicle_types.push_back(other);
         p.stations[0].vehicle_types = {other.id};
     },
     "/vehicles/0/home", "home_not_for_type"},
    {"LoadTooWideForHome",
     [](Plant& p) {
         builders::put_on(p, 0, "A-101");
         p.areas[1].outline = {{5, 12}, {7, 12}, {7, 14}, {5, 14}};
     },
     "/vehicles/0/home", "home_too_small"},
    {"HomesTooClose",
     [](Plant& p) {
         p.stations[1].pose = {6, 11.5, 0};
         p.markers[1].pose = {7.5, 11.5, 0};
         p.nodes[1].position = {6, 11.5};
     },
     "/vehicles/1/home", "homes_overlap"},
    {"StationOutsideTheHall",
     [](Plant& p) {
         p.stations[0].pose.x_m = -6;
         p.nodes[0].position.x_m = -6;
     },
     "/stations/0/pose", "outside_hall"},
    {"StationThroughTheWall",
     [](Plant& p) {
         p.stations[0].pose = {1.9, 10, 0};
         p.markers[0].pose = {3.4, 10, 0};
         p.nodes[0].position = {1.9, 10};
     },
     "/stations/0/pose", "no_room"},
    {"StationOnAnObstacle",
     [](Plant& p) {
         p.areas[1].outline = {{4, 10.5}, {5, 10.5}, {5, 12}, {4, 12}};
     },
     "/stations/0/pose", "no_room"},
    {"StationInsideANoGoArea",
     [](Plant& p) {
         p.areas[1].kind = AreaKind::kNoGo;
         p.areas[1].outline = {{0.5, 5}, {12, 5}, {12, 15}, {0.5, 15}};
     },
     "/stations/0/pose", "no_room"},
    {"StationOnAnOccupiedCell", [](Plant& p) { p.halls[0].grid.occupied[20 * 60 + 12] = 1; },
     "/stations/0/pose", "no_room"},
    {"MarkerOutOfView", [](Plant& p) { p.markers[0].pose.y_m += 0.06; }, "/stations/0/markers/0",
     "marker_not_in_view"},
    {"MarkerSeenOnlyIfTurned", [](Plant& p) { p.stations[1].pose.heading_rad = 0; },
     "/stations/1/markers/0", "marker_not_in_view"},
    {"NodeFarFromItsStation", [](Plant& p) { p.nodes[0].position.y_m = 10.6; }, "/stations/0/node",
     "node_too_far"},
    {"NodeOutsideTheHall", [](Plant& p) { p.nodes[2].position.y_m = 21; },
     "/roadmap/nodes/2/position", "outside_hall"},
    {"EdgeWithoutLength", [](Plant& p) { p.nodes[2].position = p.nodes[0].position; },
     "/roadmap/edges/0", "no_length"},
    {"EdgeTwice",
     [](Plant& p) {
         p.edges[1] = {EdgeId("b"), NodeId("n1"), NodeId("mid"), 0, {}};
     },
     "/roadmap/edges/1", "duplicate_edge"},
    {"EdgeBetweenHalls",
     [](Plant& p) {
         p.halls.push_back(p.halls[0]);
         p.halls[1].id = HallId("annexe");
         p.nodes[2].hall = HallId("annexe");
     },
     "/roadmap/edges/0", "other_hall"},
    {"StationNotReached", [](Plant& p) { p.edges.erase(p.edges.begin() + 2); }, "/stations/1/node",
     "unreachable"},
    {"NoWayBack", [](Plant& p) { p.edges.erase(p.edges.begin() + 3); }, "/stations/1/node",
     "unreachable"},
};

TEST(Validate, StationsOnFreeFloorServeWhoeverDrivesThere) {
    Plant plant = sound_plant();
    for (Station& station : plant.stations) station.node = {};
    plant.nodes.clear();
    plant.edges.clear();
    for (VehicleType& type : plant.vehicle_types) {
        type.motion_modes = {MotionMode::kLinear, MotionMode::kFree};
    }
    for (const Fault& fault : validate(plant)) ADD_FAILURE() << fault.element << " " << fault.code;
}

TEST(Validate, SoundPlantHasNoFault) {
    for (const Fault& fault : validate(sound_plant())) {
        ADD_FAILURE() << fault.element << " " << fault.code << ": " << fault.what;
    }
}

class BrokenPlant : public testing::TestWithParam<Case> {};

TEST_P(BrokenPlant, IsNamedWithARemedy) {
    Plant plant = sound_plant();
    GetParam().damage(plant);
    const std::vector<Fault> faults = validate(plant);
    std::string found;
    bool named = false;
    for (const Fault& fault : faults) {
        found += fault.element + " " + fault.code + "\n";
        named = named || (fault.element == GetParam().element && fault.code == GetParam().code);
        EXPECT_FALSE(fault.what.empty());
        EXPECT_FALSE(fault.remedy.empty());
    }

    EXPECT_TRUE(named) << "found instead:\n" << found;
    EXPECT_LE(faults.size(), 5u) << "one fault should not name the whole plant:\n" << found;
}

INSTANTIATE_TEST_SUITE_P(Each, BrokenPlant, testing::ValuesIn(kCases),
                         [](const auto& broken) { return std::string(broken.param.name); });

TEST(Validate, NamesEveryFaultNotJustTheFirst) {
    Plant plant = sound_plant();
    plant.stations[0].number = 2;
    plant.markers[0].payload = "ST02-F";
    plant.vehicles[0].manufacturer = "";
    const auto faults = validate(plant);

    EXPECT_EQ(faults.size(), 3u);
}

}  // namespace
}  // namespace pulseline::plant
