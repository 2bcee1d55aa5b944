#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>

#include "core/plant/validate.hpp"
#include "tests/core/plant/one_fault.hpp"

namespace pulseline::plant {
namespace {

Transmitter transmitter(const char* id, Point2 position, double rate_hz) {
    Transmitter t;
    t.id = TransmitterId(id);
    t.hall = HallId("cell");
    t.position = position;
    t.rate_hz = rate_hz;
    return t;
}

/// A hall of 20 m x 10 m without a marker, two transmitters, a mover with two receivers and no
/// camera.
Plant igps_plant() {
    Plant plant;
    plant.id = "small";
    Hall hall;
    hall.id = HallId("cell");
    hall.outline = geometry::rectangle(20, 10);
    Hall annexe = hall;
    annexe.id = HallId("annexe");
    plant.halls = {hall, annexe};
    VehicleType mover;
    mover.id = VehicleTypeId("mover");
    mover.kinematics = Kinematics::kMecanum;
    mover.footprint = geometry::rectangle(3, 2);
    mover.motion_modes = {MotionMode::kLinear};
    mover.receivers = {{"front", {1.4, 0}, 0.5}, {"rear", {-1.4, 0}, 0.6}};
    plant.vehicle_types = {mover};
    Station station;
    station.id = StationId("st1");
    station.number = 1;
    station.hall = HallId("cell");
    station.node = NodeId("n1");
    station.resting_place = true;
    plant.stations = {station};
    plant.nodes = {{NodeId("n1"), HallId("cell"), {0, 0}}};
    Vehicle vehicle;
    vehicle.id = VehicleId("M-1");
    vehicle.type = mover.id;
    vehicle.manufacturer = "maker";
    vehicle.serial_number = "M-1";
    vehicle.home = station.id;
    plant.vehicles = {vehicle};
    plant.transmitters = {transmitter("t1", {-9, -4}, 38), transmitter("t2", {9, 4}, 38.6)};
    return plant;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const testing::FaultCase kIgpsCases[] = {
    {"TwoTransmittersOfOneId", [](Plant& p) { p.transmitters[1].id = TransmitterId("t1"); },
     "/transmitters/1/id", "duplicate_id"},
    {"TransmitterWithoutId", [](Plant& p) { p.transmitters[1].id = {}; }, "/transmitters/1/id",
     "empty_id"},
    {"TransmitterInNoHall",
     [](Plant& p) {
         p.transmitters.push_back(transmitter("t3", {}, 39));
         p.transmitters[2].hall = HallId("x");
     },
     "/transmitters/2/hall", "unknown_hall"},
    {"TransmitterOutsideItsHall", [](Plant& p) { p.transmitters[0].position.y_m = -6; },
     "/transmitters/0/position", "outside_hall"},
    {"TransmitterNowhere", [](Plant& p) { p.transmitters[0].position.x_m = kNan; },
     "/transmitters/0/position/x_m", "not_finite"},
    {"TransmitterInTheFloor", [](Plant& p) { p.transmitters[0].z_m = 0; }, "/transmitters/0/z_m",
     "not_positive"},
    {"RollNotFinite", [](Plant& p) { p.transmitters[0].roll_rad = kNan; },
     "/transmitters/0/roll_rad", "not_finite"},
    {"PitchNotFinite", [](Plant& p) { p.transmitters[0].pitch_rad = kNan; },
     "/transmitters/0/pitch_rad", "not_finite"},
    {"HeadingNotFinite", [](Plant& p) { p.transmitters[0].heading_rad = kNan; },
     "/transmitters/0/heading_rad", "not_finite"},
    {"TransmitterStandsStill", [](Plant& p) { p.transmitters[0].rate_hz = 0; },
     "/transmitters/0/rate_hz", "not_positive"},
    {"FirstSheetLevel",
     [](Plant& p) {
         p.transmitters[0].first = {0, 0, 1};
     },
     "/transmitters/0/first", "no_light_plane"},
    {"SecondSheetLevel", [](Plant& p) { p.transmitters[1].second = {}; }, "/transmitters/1/second",
     "no_light_plane"},
    {"SheetNotFinite", [](Plant& p) { p.transmitters[1].second.a = kNan; },
     "/transmitters/1/second/a", "not_finite"},
    {"SheetOffsetNotFinite", [](Plant& p) { p.transmitters[1].first.offset_m = kNan; },
     "/transmitters/1/first/offset_m", "not_finite"},
    {"NoRange", [](Plant& p) { p.transmitters[0].range_m = -1; }, "/transmitters/0/range_m",
     "not_positive"},
    {"NoElevation", [](Plant& p) { p.transmitters[0].elevation_rad = 0; },
     "/transmitters/0/elevation_rad", "not_positive"},
    {"ShinesStraightUp", [](Plant& p) { p.transmitters[0].elevation_rad = std::numbers::pi / 2; },
     "/transmitters/0/elevation_rad", "elevation_too_steep"},
    {"NoNoiseOfASheet", [](Plant& p) { p.transmitters[0].sigma_rad = 0; },
     "/transmitters/0/sigma_rad", "not_positive"},
    {"NoNoiseOfThePlace", [](Plant& p) { p.transmitters[0].sigma_place_m = 0; },
     "/transmitters/0/sigma_place_m", "not_positive"},
    {"NoNoiseOfTheTurn", [](Plant& p) { p.transmitters[0].sigma_turn_rad = 0; },
     "/transmitters/0/sigma_turn_rad", "not_positive"},
    {"SameRate", [](Plant& p) { p.transmitters[1].rate_hz = 38.009; }, "/transmitters/1/rate_hz",
     "same_rate"},
    {"ManyTransmitters",
     [](Plant& p) {
         for (int i = 3; i <= 17; ++i) {
             p.transmitters.push_back(
                 transmitter(("t" + std::to_string(i)).c_str(), {0, 0}, 38 + i));
         }
     },
     "/transmitters/16", "too_many_transmitters"},
    {"ReceiverNowhere", [](Plant& p) { p.vehicle_types[0].receivers[1].position.y_m = kNan; },
     "/vehicle_types/0/receivers/1/position/y_m", "not_finite"},
    {"ReceiverInTheFloor", [](Plant& p) { p.vehicle_types[0].receivers[0].z_m = 0; },
     "/vehicle_types/0/receivers/0/z_m", "not_positive"},
    {"ReceiverWithoutName", [](Plant& p) { p.vehicle_types[0].receivers[0].name = ""; },
     "/vehicle_types/0/receivers/0/name", "duplicate_receiver"},
    {"TwoReceiversOfOneName", [](Plant& p) { p.vehicle_types[0].receivers[1].name = "front"; },
     "/vehicle_types/0/receivers/1/name", "duplicate_receiver"},
    {"OneReceiver", [](Plant& p) { p.vehicle_types[0].receivers.pop_back(); },
     "/vehicle_types/0/receivers", "one_receiver"},
    {"ReceiversAboveEachOther",
     [](Plant& p) {
         p.vehicle_types[0].receivers[1].position = {1.4, 0.09};
     },
     "/vehicle_types/0/receivers/1/position", "receivers_too_near"},
    {"OneTransmitter", [](Plant& p) { p.transmitters.pop_back(); }, "/vehicles/0/type",
     "too_few_transmitters"},
    {"TransmittersInTheOtherHall",
     [](Plant& p) {
         for (Transmitter& t : p.transmitters) t.hall = HallId("annexe");
     },
     "/vehicles/0/type", "too_few_transmitters"},
};

void expect_no_fault(const Plant& plant) {
    for (const Fault& fault : validate(plant)) {
        ADD_FAILURE() << fault.element << " " << fault.code << ": " << fault.what;
    }
}

TEST(ValidateIgps, NeedsNoMarkerAndNoCamera) { expect_no_fault(igps_plant()); }

TEST(ValidateIgps, TransmittersOfTwoHallsMayTurnAlike) {
    Plant plant = igps_plant();
    plant.transmitters.push_back(transmitter("t3", {0, 0}, 38));
    plant.transmitters.back().hall = HallId("annexe");

    expect_no_fault(plant);
}

TEST(ValidateIgps, ATypeWithReceiversAndNoVehicleNeedsNoTransmitter) {
    Plant plant = igps_plant();
    plant.vehicles.clear();
    plant.transmitters.clear();

    expect_no_fault(plant);
}

TEST(ValidateIgps, AHallMayHaveSixteenTransmitters) {
    Plant plant = igps_plant();
    for (int i = 3; i <= 16; ++i) {
        plant.transmitters.push_back(
            transmitter(("t" + std::to_string(i)).c_str(), {0, 0}, 38 + 0.6 * i));
    }

    expect_no_fault(plant);
}

class BrokenIgps : public ::testing::TestWithParam<testing::FaultCase> {};

TEST_P(BrokenIgps, IsNamedAloneWithARemedy) {
    testing::expect_named_alone(igps_plant(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Each, BrokenIgps, ::testing::ValuesIn(kIgpsCases), testing::name_of);

}  // namespace
}  // namespace pulseline::plant
