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
