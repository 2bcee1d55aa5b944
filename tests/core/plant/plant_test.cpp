#include "core/plant/plant.hpp"

#include <gtest/gtest.h>

namespace pulseline::plant {
namespace {

Plant small() {
    Plant plant;
    plant.stations.resize(2);
    plant.stations[0].id = StationId("st01");
    plant.stations[0].number = 1;
    plant.stations[1].id = StationId("st02");
    plant.stations[1].number = 2;
    plant.markers.resize(1);
    plant.markers[0].id = MarkerId("m1");
    plant.markers[0].payload = "ST01-F";
    Vehicle vehicle;
    vehicle.id = VehicleId("TP-01");
    vehicle.manufacturer = "pulseline";
    vehicle.serial_number = "TP-01";
    plant.vehicles = {vehicle};
    return plant;
}

TEST(Plant, CamerasHangOtherwiseUnderLoad) {
    VehicleType type;
    type.cameras.resize(2);
    type.cameras[0].name = "front";
    type.cameras[0].k1 = -0.06;
    type.cameras[0].loaded = CameraMounting{{5.34, 0.001, 0.01}, 0.452, 0.002, -0.003};
    type.cameras[1].height_m = 0.455;

    EXPECT_EQ(cameras_of(type, false)[0].height_m, type.cameras[0].height_m);
    const auto loaded = cameras_of(type, true);
    EXPECT_EQ(loaded[0].name, "front");
    EXPECT_EQ(loaded[0].k1, -0.06);
    EXPECT_EQ(loaded[0].body_from_camera, (Pose2{5.34, 0.001, 0.01}));
    EXPECT_EQ(loaded[0].height_m, 0.452);
    EXPECT_EQ(loaded[0].tilt_u_rad, 0.002);
    EXPECT_EQ(loaded[0].tilt_v_rad, -0.003);
    EXPECT_EQ(loaded[1].height_m, 0.455);
}

TEST(Plant, FindsByKeyNumberPayloadAndIdentity) {
    const Plant plant = small();

    EXPECT_EQ(find_station(plant, StationId("st02"))->number, 2);
    EXPECT_EQ(find_station(plant, 1)->id, StationId("st01"));
    EXPECT_EQ(find_marker_by_payload(plant, "ST01-F")->id, MarkerId("m1"));
    EXPECT_EQ(find_vehicle(plant, "pulseline", "TP-01")->id, VehicleId("TP-01"));
}

TEST(Plant, AbsentIsNull) {
    const Plant plant = small();

    EXPECT_EQ(find_station(plant, StationId("st03")), nullptr);
    EXPECT_EQ(find_station(plant, 3), nullptr);
    EXPECT_EQ(find_hall(plant, HallId("x")), nullptr);
    EXPECT_EQ(find_node(plant, NodeId("x")), nullptr);
    EXPECT_EQ(find_vehicle_type(plant, VehicleTypeId("x")), nullptr);
    EXPECT_EQ(find_vehicle(plant, "pulseline", "TP-02"), nullptr);
}

TEST(Plant, MotionModeNamesGoThereAndBack) {
    for (const MotionMode mode :
         {MotionMode::kAuto, MotionMode::kSelfRotation, MotionMode::kLinear,
          MotionMode::kFixedAxisRotation, MotionMode::kLateral, MotionMode::kFree}) {
        EXPECT_EQ(parse_motion_mode(to_string(mode)), mode);
    }
    EXPECT_EQ(parse_motion_mode("sideways"), std::nullopt);
}

TEST(VehicleType, LengthIsTheExtentAlongBodyX) {
    VehicleType type;
    type.footprint = geometry::rectangle(10.5, 2.5);

    EXPECT_DOUBLE_EQ(type.length_m(), 10.5);
}

TEST(VehicleType, LoadCountsOnlyWhenLoaded) {
    VehicleType type;
    type.footprint = geometry::rectangle(10.5, 2.5);
    type.load_footprint = geometry::rectangle(4, 8);

    EXPECT_EQ(outline_with_load(type, false).size(), 1u);
    EXPECT_EQ(outline_with_load(type, true).size(), 2u);
}

}  // namespace
}  // namespace pulseline::plant
