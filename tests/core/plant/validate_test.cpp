#include "core/plant/validate.hpp"

#include "tests/core/plant/broken_plant.hpp"

namespace pulseline::plant {
namespace {

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
    {"GridOfWrongSize", [](Plant& p) { p.halls[0].grid.occupied.pop_back(); },
     "/halls/0/occupancy_yaml", "grid_size"},
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

TEST_P(BrokenPlant, IsNamedWithARemedy) { expect_named(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Each, BrokenPlant, testing::ValuesIn(kCases), name_of);

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
