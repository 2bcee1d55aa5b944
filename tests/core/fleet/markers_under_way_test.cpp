#include "core/fleet/vehicle/markers_under_way.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::fleet::testing {
namespace {

using geometry::Pose2;
using kinematics::Segment;

/// One camera ahead of the centre, 175 mm x 140 mm of floor.
plant::VehicleType camera_ahead() {
    plant::VehicleType type;
    plant::Camera camera;
    camera.body_from_camera = {1.2, 0, 0};
    type.cameras = {camera};
    return type;
}

plant::Marker code_at(double x_m, double y_m) {
    plant::Marker marker;
    marker.size_m = 0.06;
    marker.pose = {x_m, y_m, 0};
    return marker;
}

bool is_passed(const plant::Marker& marker, const Segment& segment) {
    return !markers_below({&marker}, camera_ahead(), false, segment).empty();
}

Segment straight(double length_m) {
    Segment segment;
    segment.start = {0, 0, 0};
    segment.end = {length_m, 0, 0};
    segment.length_m = length_m;
    return segment;
}

TEST(MarkersUnderWay, AreThoseThatACameraSeesWhole) {
    const Segment way = straight(2);
    EXPECT_TRUE(is_passed(code_at(2.2, 0), way));
    EXPECT_TRUE(is_passed(code_at(1.2, 0.03), way)) << "(140 mm - 60 mm) / 2 beside the way";
    EXPECT_FALSE(is_passed(code_at(2.2, 0.05), way)) << "cut at the border of the picture";
    EXPECT_FALSE(is_passed(code_at(0.5, 0), way)) << "the camera was ahead of it already";
    EXPECT_FALSE(is_passed(code_at(3.5, 0), way)) << "beyond its end";
}

TEST(MarkersUnderWay, AreSeenByACameraThatSwingsWithATurn) {
    Segment turn;
    turn.kind = Segment::Kind::kRotate;
    turn.end = {0, 0, kPi / 2};
    turn.turn_rad = kPi / 2;
    const double diagonal_m = 1.2 * std::sqrt(0.5);
    EXPECT_TRUE(is_passed(code_at(diagonal_m, diagonal_m), turn));
    EXPECT_FALSE(is_passed(code_at(diagonal_m, -diagonal_m), turn)) << "the other way round";
    EXPECT_FALSE(is_passed(code_at(0.2, 0), turn)) << "below the body, not below the camera";
}

const vda5050::OrderMessage* order_of(World& world, const std::vector<std::string>& announced) {
    world.connect_all();
    if (!announced.empty()) world.announce(announced);
    EXPECT_TRUE(world.order("V1", {2}));
    world.run(1);
    return &world.vehicle("V1").order();
}

std::vector<std::string> observed(const vda5050::OrderMessage& order) {
    std::vector<std::string> payloads;
    for (const auto& edge : order.edges) {
        for (const auto& action : edge.actions) {
            EXPECT_EQ(action.type, "observeMarkers");
            EXPECT_FALSE(action.id.empty());
            for (const auto& marker : action.markers) payloads.push_back(marker.payload);
        }
    }
    return payloads;
}

TEST(MarkersUnderWay, AnOrderNamesTheCodesOnEachEdge) {
    World world;
    const auto payloads = observed(*order_of(world, {"observeMarkers"}));
    // Those of the station that it goes to are among them.
    EXPECT_NE(std::find(payloads.begin(), payloads.end(), "ST02-F"), payloads.end());
}

TEST(MarkersUnderWay, AVehicleThatDoesNotAnnounceItIsNotAsked) {
    World silent;
    EXPECT_TRUE(observed(*order_of(silent, {})).empty());
    World other;
    EXPECT_TRUE(observed(*order_of(other, {"raiseParking"})).empty());
}

TEST(MarkersUnderWay, AStoredLegHasNone) {
    World world;
    (void)order_of(world, {"observeMarkers"});
    const auto& stored = world.store.vehicles.at(plant::VehicleId("V1"));
    ASSERT_TRUE(stored.has_leg);
    ASSERT_FALSE(stored.leg_data.edges.empty());
    for (const auto& edge : stored.leg_data.edges) EXPECT_TRUE(edge.actions.empty());
}

}  // namespace
}  // namespace pulseline::fleet::testing
