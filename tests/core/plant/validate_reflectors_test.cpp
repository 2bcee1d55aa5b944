#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/plant/validate.hpp"
#include "tests/core/plant/one_fault.hpp"

namespace pulseline::plant {
namespace {

Reflector reflector(const std::string& id, Point2 position) {
    Reflector r;
    r.id = ReflectorId(id);
    r.hall = HallId("hall");
    r.position = position;
    return r;
}

/// A hall of 20 m x 10 m with three reflectors and a vehicle that looks for them.
Plant plant_with_reflectors() {
    Plant plant;
    plant.id = "small";
    Hall hall;
    hall.id = HallId("hall");
    hall.outline = geometry::rectangle(20, 10);
    plant.halls = {hall};
    VehicleType type;
    type.id = VehicleTypeId("measuring");
    type.kinematics = Kinematics::kMecanum;
    type.footprint = geometry::rectangle(2, 1);
    type.motion_modes = {MotionMode::kLinear};
    type.navigation_scanner = NavigationScanner{};
    plant.vehicle_types = {type};
    Station station;
    station.id = StationId("st1");
    station.number = 1;
    station.hall = hall.id;
    station.node = NodeId("n1");
    station.resting_place = true;
    plant.stations = {station};
    plant.nodes = {{NodeId("n1"), hall.id, {0, 0}}};
    Vehicle vehicle;
    vehicle.id = VehicleId("M-1");
    vehicle.type = type.id;
    vehicle.manufacturer = "maker";
    vehicle.serial_number = "M-1";
    vehicle.home = station.id;
    plant.vehicles = {vehicle};
    plant.reflectors = {reflector("a", {-9, -4}), reflector("b", {9, 4}), reflector("c", {3, 4.5})};
    return plant;
}

NavigationScanner& scanner(Plant& plant) { return *plant.vehicle_types[0].navigation_scanner; }

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const testing::FaultCase kCases[] = {
    {"TwoOfOneId", [](Plant& p) { p.reflectors[1].id = ReflectorId("a"); }, "/reflectors/1/id",
     "duplicate_id"},
    {"WithoutId", [](Plant& p) { p.reflectors[1].id = {}; }, "/reflectors/1/id", "empty_id"},
    {"InNoHall",
     [](Plant& p) {
         p.reflectors.push_back(reflector("d", {}));
         p.reflectors[3].hall = HallId("x");
     },
     "/reflectors/3/hall", "unknown_hall"},
    {"OutsideItsHall", [](Plant& p) { p.reflectors[0].position.y_m = -6; },
     "/reflectors/0/position", "outside_hall"},
    {"Nowhere", [](Plant& p) { p.reflectors[0].position.x_m = kNan; }, "/reflectors/0/position/x_m",
     "not_finite"},
    {"SurveyedExactly", [](Plant& p) { p.reflectors[2].sigma_m = 0; }, "/reflectors/2/sigma_m",
     "not_positive"},
    {"SideBySide",
     [](Plant& p) {
         p.reflectors.push_back(reflector("d", {9, 3.7}));
     },
     "/reflectors/3/position", "reflectors_too_near"},
    {"TooFewForAVehicle", [](Plant& p) { p.reflectors.pop_back(); }, "/vehicles/0/type",
     "too_few_reflectors"},
    {"TooMany",
     [](Plant& p) {
         p.halls[0].outline = geometry::rectangle(500, 10);
         for (int i = 0; i < 198; ++i) {
             p.reflectors.push_back(reflector("r" + std::to_string(i), {10.0 + i, 0.01 * i}));
         }
     },
     "/reflectors/200", "too_many_reflectors"},
    {"ScannerNowhere", [](Plant& p) { scanner(p).body_from_scanner.y_m = kNan; },
     "/vehicle_types/0/navigation_scanner/pose/y_m", "not_finite"},
    {"ScannerInTheFloor", [](Plant& p) { scanner(p).z_m = 0; },
     "/vehicle_types/0/navigation_scanner/z_m", "not_positive"},
    {"ScannerStandsStill", [](Plant& p) { scanner(p).rate_hz = 0; },
     "/vehicle_types/0/navigation_scanner/rate_hz", "not_positive"},
    {"ScannerSeesNothing", [](Plant& p) { scanner(p).range_m = -1; },
     "/vehicle_types/0/navigation_scanner/range_m", "not_positive"},
    {"ReflectorsOfNoSize", [](Plant& p) { scanner(p).reflector_radius_m = 0; },
     "/vehicle_types/0/navigation_scanner/reflector_radius_m", "not_positive"},
    {"ExactRange", [](Plant& p) { scanner(p).sigma_range_m = 0; },
     "/vehicle_types/0/navigation_scanner/sigma_range_m", "not_positive"},
    {"ExactBearing", [](Plant& p) { scanner(p).sigma_bearing_rad = 0; },
     "/vehicle_types/0/navigation_scanner/sigma_bearing_rad", "not_positive"},
    {"RaysOnTopOfEachOther", [](Plant& p) { scanner(p).step_rad = 1e-9; },
     "/vehicle_types/0/navigation_scanner/step_rad", "scanner_step"},
    {"FourRaysATurn", [](Plant& p) { scanner(p).step_rad = 1.5; },
     "/vehicle_types/0/navigation_scanner/step_rad", "scanner_step"},
    {"StepNotFinite", [](Plant& p) { scanner(p).step_rad = kNan; },
     "/vehicle_types/0/navigation_scanner/step_rad", "not_finite"},
};

TEST(Reflectors, ThreeAreEnough) { EXPECT_TRUE(validate(plant_with_reflectors()).empty()); }

class BrokenReflectors : public ::testing::TestWithParam<testing::FaultCase> {};

TEST_P(BrokenReflectors, AreNamedAloneWithARemedy) {
    testing::expect_named_alone(plant_with_reflectors(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Each, BrokenReflectors, ::testing::ValuesIn(kCases), testing::name_of);

}  // namespace
}  // namespace pulseline::plant
