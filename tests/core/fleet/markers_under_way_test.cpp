#include "core/fleet/vehicle/markers_under_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::fleet::testing {
namespace {

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

/// A code on the way to station 2, where it passes from station 1.
plant::Plant with_code_half_way() {
    plant::Plant plant = small_plant();
    const auto* from = plant::find_station(plant, 1);
    const auto* to = plant::find_station(plant, 2);
    plant::Marker marker = plant.markers.front();
    marker.id = plant::MarkerId("half-way");
    marker.payload = "half-way";
    const auto middle = 0.5 * (from->pose.position() + to->pose.position());
    marker.pose = {middle.x_m, middle.y_m, 0};
    plant.markers.push_back(marker);
    return plant;
}

TEST(MarkersUnderWay, AnOrderSaysWhichCodesItsWayReliesOn) {
    World world(with_code_half_way());
    const auto& order = *order_of(world, {"observeMarkers"});
    std::vector<std::string> segment_markers;
    std::string boundary;
    for (const auto& edge : order.edges) {
        for (const auto& action : edge.actions) {
            for (const auto& payload : action.segment_markers) segment_markers.push_back(payload);
            if (!action.boundary_marker.empty()) boundary = action.boundary_marker;
            for (const auto& payload : action.segment_markers) {
                EXPECT_NE(
                    std::ranges::find(action.markers, payload, &vda5050::SurveyedMarker::payload),
                    action.markers.end());
            }
        }
    }
    ASSERT_FALSE(segment_markers.empty());
    EXPECT_NE(std::ranges::find(segment_markers, boundary), segment_markers.end());

    const auto view = world.fleet->vehicle(plant::VehicleId("V1"), world.now);
    ASSERT_TRUE(view->leg && view->leg->chain && *view->leg->chain);
    EXPECT_EQ((*view->leg->chain)->markers.back().payload, boundary);
}

/// As fast as its camera reads a code of 60 mm that it relies on, and no slower elsewhere.
TEST(MarkersUnderWay, AFastTypeIsLimitedOverTheCodesThatItsWayReliesOn) {
    auto plant = with_code_half_way();
    for (auto& type : plant.vehicle_types) {
        type.max_speed_mps = 4;
        for (auto& camera : type.cameras) camera.frame_rate_hz = 30;
    }
    World world(plant);
    const auto& order = *order_of(world, {"observeMarkers"});
    int limited = 0;
    for (const auto& edge : order.edges) {
        const bool relies = std::ranges::any_of(
            edge.actions, [](const auto& action) { return !action.segment_markers.empty(); });
        limited += relies;
        EXPECT_NEAR(edge.max_speed_mps, relies ? 2.0897 : 0, 1e-4) << edge.edge_id;
    }
    EXPECT_GT(limited, 0);
    EXPECT_LT(limited, static_cast<int>(order.edges.size()));
}

TEST(MarkersUnderWay, AnEdgesOwnLowerLimitStays) {
    auto plant = with_code_half_way();
    for (auto& type : plant.vehicle_types) type.max_speed_mps = 4;
    for (auto& edge : plant.edges) edge.max_speed_mps = 1.5;
    World world(plant);
    for (const auto& edge : order_of(world, {"observeMarkers"})->edges) {
        EXPECT_LE(edge.max_speed_mps, 2.09);
        const bool relies = std::ranges::any_of(
            edge.actions, [](const auto& action) { return !action.segment_markers.empty(); });
        if (relies) {
            EXPECT_NEAR(edge.max_speed_mps, 1.5, 1e-9);
        }
    }
}

TEST(MarkersUnderWay, WhoReadsThemAtItsOwnSpeedIsNotLimited) {
    World world(with_code_half_way());
    for (const auto& edge : order_of(world, {"observeMarkers"})->edges) {
        EXPECT_EQ(edge.max_speed_mps, 0);
    }
}

TEST(MarkersUnderWay, AVehicleThatDoesNotAnnounceItIsNotAsked) {
    World silent;
    EXPECT_TRUE(observed(*order_of(silent, {})).empty());
    World other;
    EXPECT_TRUE(observed(*order_of(other, {"raiseParking"})).empty());
}

TEST(MarkersUnderWay, AreCountedByTheVehiclesOwnWord) {
    using vda5050::ActionStatus;
    vda5050::StateMessage state;
    EXPECT_EQ(codes_under_way(state).passed, 0);
    const auto passes = [&](const char* type, ActionStatus status, const char* result) {
        vda5050::ActionState action;
        action.type = type;
        action.status = status;
        action.result_description = result;
        state.action_states.push_back(action);
    };
    passes("observeMarkers", ActionStatus::kFinished, "301");
    passes("observeMarkers", ActionStatus::kFinished, "302, 303");
    passes("observeMarkers", ActionStatus::kFinished, "");
    passes("observeMarkers", ActionStatus::kRunning, "");
    passes("measureStop", ActionStatus::kFinished, "{}");
    const CodesUnderWay codes = codes_under_way(state);
    EXPECT_EQ(codes.passed, 3);
    EXPECT_EQ(codes.read, 2);
    EXPECT_EQ(codes.last, "302, 303");
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
