#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/fleet/fleet_world.hpp"

// Legs that server and vehicle know differently: what the simulation judge found.
namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");
const plant::VehicleId kV2("V2");

/// The server hears the vehicle, whose messages from the server are under way.
void hear_only(World& world, double duration_s) {
    world.connected[kV1] = false;
    const Time end = world.now + from_seconds(duration_s);
    while (world.now < end) {
        world.now += std::chrono::milliseconds(100);
        world.fleet->vehicle_state(kV1, world.vehicle("V1").state, world.now);
        world.fleet->tick(world.now);
        world.settle();
    }
}

/// What the fleet put out is stored, but its messages get lost; gives the id of the instant action
/// among them.
std::string lose_action(World& world) {
    const Outputs out = world.fleet->take_outputs(world.now);
    world.store.commit(out.records);
    for (const auto& message : out.messages) {
        if (message.instant_actions) return message.instant_actions->actions.front().id;
    }
    return {};
}

void give_up_order(FakeVehicle& vehicle) {
    vda5050::Action cancel;
    cancel.type = "cancelOrder";
    cancel.id = "by hand";
    vehicle.receive({kV1, std::nullopt, vda5050::InstantActionsMessage{{cancel}}});
}

void report_action(FakeVehicle& vehicle, const std::string& id, vda5050::ActionStatus status) {
    auto& states = vehicle.state.action_states;
    std::erase_if(states, [&](const vda5050::ActionState& action) { return action.id == id; });
    states.push_back({id, "", status, "", {}});
}

TEST(LostLegs, AFailedCancelOfOneThatTheVehicleStillHasIsAskedForAgain) {
    World world;
    world.connect_all();
    world.vehicles_move = false;
    const auto created = world.order("V1", {3});
    ASSERT_TRUE(created);
    world.run(1);
    ASSERT_TRUE(world.fleet->cancel_order(created->order.id, std::nullopt, "op", world.now));
    const std::string cancel = lose_action(world);
    ASSERT_FALSE(cancel.empty());
    hear_only(world, 12);  // it got nothing of it, and no order is on its way any more

    report_action(world.vehicle("V1"), cancel, vda5050::ActionStatus::kFailed);
    hear_only(world, 0.5);

    EXPECT_TRUE(world.store.vehicles.at(kV1).has_leg) << "it may drive on";
    EXPECT_EQ(world.only_order().state, JobState::kRunning);
}

TEST(LostLegs, AStopThatFailedWhileTheVehicleDrivesIsNotTakenYet) {
    World world;
    world.connect_all();
    world.vehicles_move = false;
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(1);
    const LegId leg = world.store.vehicles.at(kV1).leg;

    world.vehicle("V1").state.driving = true;
    report_action(world.vehicle("V1"), leg.str() + "-measureStop", vda5050::ActionStatus::kFailed);
    hear_only(world, 0.5);

    EXPECT_TRUE(world.store.vehicles.at(kV1).has_leg);
    EXPECT_EQ(world.only_order().state, JobState::kRunning) << world.only_order().reason.code;
}

TEST(LostLegs, OneGivenUpWhileTheServerWasDownIsBegunAnewAfterThePersonsAct) {
    World world;
    world.connect_all();
    world.vehicles_move = false;
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(1);
    ASSERT_GT(world.store.vehicles.at(kV1).leg_data.released_nodes, 1u);
    const LegId leg = world.store.vehicles.at(kV1).leg;

    give_up_order(world.vehicle("V1"));
    world.crash_server();
    world.vehicles_move = true;
    world.run(2);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
    EXPECT_NE(world.store.stops.at(0).leg, leg);
}

TEST(LostLegs, TheCancelOfOneThatWasGivenUpWhileTheServerWasDownEndsTheOrderOnce) {
    World world;
    world.connect_all();
    world.vehicles_move = false;
    const auto created = world.order("V1", {3});
    ASSERT_TRUE(created);
    world.run(1);
    give_up_order(world.vehicle("V1"));
    world.crash_server();
    world.run(2);
    ASSERT_TRUE(world.fleet->cancel_order(created->order.id, std::nullopt, "op", world.now));
    world.run(1);

    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(5);

    EXPECT_EQ(world.only_order().state, JobState::kAborted);
    const Param aborted{"to", std::string("Aborted")};
    const auto ends = [&](const Event& event) {
        return std::count(event.params.begin(), event.params.end(), aborted) > 0;
    };
    EXPECT_EQ(std::count_if(world.store.events.begin(), world.store.events.end(), ends), 1);
}

/// The plant was imported anew without the stations of the only order, and the server started.
void start_without_its_stations(World& world) {
    for (auto& step : world.store.orders.begin()->second.steps)
        step.station = plant::StationId("gone");
    world.crash_server();
    world.connect_all();
}

TEST(LostLegs, AnOrderWhoseStationIsGoneFromThePlantIsAbortedAtTheStart) {
    World world;
    ASSERT_TRUE(world.order("V1", {2, 3}));
    world.settle();

    start_without_its_stations(world);
    world.settle();

    EXPECT_EQ(world.only_order().state, JobState::kAborted);
    EXPECT_EQ(world.only_order().reason.code, "station_gone");
}

TEST(LostLegs, OneUnderWayWhoseStationIsGoneEndsWithItsOrderWhenAPersonLetsItGoOn) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {2, 3}));
    world.run(1);

    start_without_its_stations(world);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kAborted);
    EXPECT_EQ(world.only_order().reason.code, "station_gone");
}

TEST(LostLegs, OneWhoseStopIsStillBeingCorrectedIsNotOver) {
    World world;
    world.connect_all();
    FakeVehicle& vehicle = world.vehicle("V1");
    ASSERT_TRUE(world.order("V1", {2}));
    const auto& record = world.store.vehicles[kV1];
    for (int i = 0; i < 600 && (!record.has_leg || !vehicle.state.node_states.empty()); ++i)
        world.run(0.1);
    world.vehicles_move = false;
    const LegId leg = record.leg;
    // Cancelled where its drive failed: the measurement has failed, the correction goes on.
    report_action(vehicle, leg.str() + "-measureStop", vda5050::ActionStatus::kFailed);
    report_action(vehicle, leg.str() + "-adjustToMarker", vda5050::ActionStatus::kRunning);
    vehicle.state.driving = false;
    world.run(2);
    EXPECT_EQ(record.leg, leg);

    report_action(vehicle, leg.str() + "-adjustToMarker", vda5050::ActionStatus::kFailed);
    world.run(1);
    EXPECT_NE(record.leg, leg);
}

TEST(LostLegs, AnOrderThatIsNotOfThisServerIsCancelledByAPersonsAct) {
    World world;
    world.connect_all();
    FakeVehicle& vehicle = world.vehicle("V1");
    vda5050::OrderMessage other;
    other.order_id = "of another master";
    other.nodes.resize(2);
    other.edges.resize(1);
    other.nodes[1].sequence_id = 2;  // not released: it stands and waits
    vehicle.receive({kV1, other, std::nullopt});
    world.run(1);
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(20);

    const auto waiting = world.fleet->vehicle(kV1, world.now);
    EXPECT_TRUE(waiting->needs_resume);
    EXPECT_EQ(waiting->needs_resume_reason.code, "foreign_order");
    EXPECT_EQ(vehicle.state.order_id, other.order_id);
    EXPECT_FALSE(world.store.vehicles.at(kV1).has_leg);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
    EXPECT_EQ(world.count_events("vehicle.foreign_order_cancelled"), 1);
}

TEST(LostLegs, OneThatMayStillReachTheVehicleIsAskedForAgainAndNotForgotten) {
    World world;
    world.connect_all();
    world.connected[kV1] = false;
    ASSERT_TRUE(world.order("V1", {3}));
    hear_only(world, 15);
    ASSERT_EQ(world.only_order().reason.code, "order_not_accepted");
    const LegId leg = world.store.vehicles.at(kV1).leg;
    hear_only(world, 0.1);

    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.settle();
    EXPECT_EQ(world.store.vehicles.at(kV1).leg, leg);
    world.connected[kV1] = true;
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
    EXPECT_EQ(world.store.stops.at(0).leg, leg);
}

TEST(LostLegs, AnOrderThatASilentVehicleMayHaveGotIsKeptThoughAPersonLetsItGoOn) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.now += std::chrono::milliseconds(100);
    world.fleet->tick(world.now);
    world.settle();
    const LegId leg = world.store.vehicles.at(kV1).leg;
    ASSERT_TRUE(world.store.vehicles.at(kV1).has_leg);
    ASSERT_EQ(world.vehicle("V1").orders_received, 1);
    world.connected[kV1] = false;
    world.run(60);  // it drives its base unheard
    ASSERT_GT(world.vehicle("V1").node_steps, 0);

    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(5);
    EXPECT_EQ(world.store.vehicles.at(kV1).leg, leg) << "its floor is still the vehicle's";
    world.connected[kV1] = true;
    world.fleet->vehicle_connected(kV1, world.now);
    world.run(600);

    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
    ASSERT_FALSE(world.store.stops.empty());
    EXPECT_EQ(world.store.stops.at(0).leg, leg);
}

TEST(LostLegs, ACancelThatOvertookItsOrderIsNotTheEndOfIt) {
    World world;
    world.connect_all();
    world.connected[kV1] = false;
    const auto created = world.order("V1", {3});
    ASSERT_TRUE(created);
    hear_only(world, 0.5);
    ASSERT_TRUE(world.store.vehicles.at(kV1).has_leg);
    ASSERT_TRUE(world.fleet->cancel_order(created->order.id, std::nullopt, "op", world.now));
    const std::string cancel = lose_action(world);
    ASSERT_FALSE(cancel.empty());

    world.vehicle("V1").state.action_states.push_back(
        {cancel, "cancelOrder", vda5050::ActionStatus::kFailed, "noOrderToCancel", {}});
    hear_only(world, 2);
    EXPECT_NE(world.only_order().state, JobState::kAborted) << "the order may still arrive";
    EXPECT_TRUE(world.store.vehicles.at(kV1).has_leg);

    hear_only(world, 15);
    EXPECT_EQ(world.only_order().state, JobState::kAborted);
    EXPECT_FALSE(world.store.vehicles.at(kV1).has_leg);
}

/// It refuses each cancelOrder at once, and says that something of the order is left.
TEST(LostLegs, OneThatRefusesEveryCancelIsNotAskedAsOftenAsItSpeaks) {
    World world;
    world.connect_all();
    const auto created = world.order("V1", {3});
    ASSERT_TRUE(created);
    world.run(2);
    ASSERT_TRUE(world.store.vehicles.at(kV1).has_leg);
    ASSERT_TRUE(world.fleet->cancel_order(created->order.id, std::nullopt, "op", world.now));
    auto& vehicle = world.vehicle("V1");
    vehicle.state.driving = false;
    vehicle.state.velocity_mps = 0;
    int asked = 0;
    const Time end = world.now + std::chrono::seconds(60);
    while (world.now < end) {
        world.now += std::chrono::milliseconds(200);
        const Outputs out = world.fleet->take_outputs(world.now);
        world.store.commit(out.records);
        for (const auto& message : out.messages) {
            if (!message.instant_actions) continue;
            ++asked;
            vehicle.state.action_states.push_back({message.instant_actions->actions.front().id,
                                                   "cancelOrder",
                                                   vda5050::ActionStatus::kFailed,
                                                   "noOrderToCancel",
                                                   {}});
        }
        world.fleet->vehicle_state(kV1, vehicle.state, world.now);
        world.fleet->tick(world.now);
    }
    EXPECT_GE(asked, 2);
    EXPECT_LE(asked, 13);
    EXPECT_TRUE(world.store.vehicles.at(kV1).has_leg) << "it may drive on";
}

TEST(LostLegs, AVehicleThatRestartsBeforeItShowedItsOrderWaitsForAPerson) {
    World world;
    world.connect_all();
    world.connected[kV1] = false;
    ASSERT_TRUE(world.order("V1", {3}));
    hear_only(world, 0.5);

    world.vehicle("V1").restart();
    world.connected[kV1] = true;
    world.fleet->vehicle_connected(kV1, world.now);
    world.run(10);
    EXPECT_TRUE(world.fleet->vehicle(kV1, world.now)->pose_known) << "by its codes";
    EXPECT_TRUE(world.fleet->vehicle(kV1, world.now)->needs_resume);
    EXPECT_EQ(world.vehicle("V1").node_steps, 0);

    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(LostLegs, AVehicleThatRestartsAgainBeforeItKnowsItsPoseWaitsForAPersonAgain) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(0.8);
    FakeVehicle& vehicle = world.vehicle("V1");
    const auto restart = [&] {
        vehicle.restart();
        world.fleet->vehicle_connected(kV1, world.now);
        world.run(2);
    };
    vehicle.sees_codes = false;
    restart();
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(2);
    const int steps = vehicle.node_steps;

    restart();
    ASSERT_TRUE(world.fleet->init_position(kV1, {*vehicle.state.pose}, "op", world.now));
    world.run(10);

    EXPECT_EQ(vehicle.node_steps, steps) << "a position moves nothing";
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(LostLegs, OneThatAVehicleGaveUpByHandAtTheEndOfItsBaseIsBegunAnew) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(1);
    FakeVehicle& vehicle = world.vehicle("V1");
    const auto& record = world.store.vehicles.at(kV1);
    const LegId leg = record.leg;
    while (vehicle.step()) {
    }
    ASSERT_FALSE(vehicle.state.node_states.empty()) << "it waits for the rest";

    vehicle.state.operating_mode = "MANUAL";
    give_up_order(vehicle);
    vehicle.state.pose->y_m += 2;
    world.run(1);
    vehicle.state.operating_mode = "AUTOMATIC";
    world.run(1);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
    ASSERT_FALSE(world.store.stops.empty());
    EXPECT_NE(world.store.stops.at(0).leg, leg) << "it led on from where the vehicle stood before";
}

}  // namespace
}  // namespace pulseline::fleet::testing
