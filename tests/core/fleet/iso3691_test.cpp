#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/fleet/fleet_world.hpp"

// What a fleet server must and must not do beside vehicles whose own functions protect people
// (ISO 3691-4). Further tests of the same rules have other names:
//   bounded pieces of way        Fleet.OneVehiclePerPieceOfFloor, Transitions.RunningToInterrupted-
//                                ByPauseStopsInsideTheBase
//   nothing on silence           Fleet.NoBaseIsExtendedToASilentVehicle,
//   Fleet.SilenceIsLateLostGone,
//                                TrafficScenarios.ASilentVehicleGetsNoFloorThatBecomesFree
//   nothing on a safety stop     TrafficScenarios.AVehicleWithItsSafetyStopPulledGetsNoFloor-
//                                ThatBecomesFree
//   a person after a restart     Fleet.AfterAServerRestartNothingIsReleasedUntilAPersonAllowsIt,
//                                Fleet.AVehicleThatRestartsInMidLegWaitsForPoseAndPerson,
//                                Schedules.WaitForAPersonAfterARestartAndMakeNoBurst,
//                                LostLegs.AVehicleThatRestartsBeforeItShowedItsOrderWaitsForAPerson
//   modes exclude each other     ManualMode.*
//   no stale command ManualMode.AnUpdateDecidedJustBeforeItIsKnownIsNotSentUntilAPerson-
//                                SaysSo, Fleet.AnOrderThatDidNotReachAPausedVehicleIsNotSentAgain-
//                                UntilItIsResumed
//   not beyond the vehicle data  LaneSpeeds.AreToldWithTheEdges, Closures.ClosedLanesAreGoneRound-
//                                AndKeptOverARestart, PlanMotion.RefusesWhatTheWheelsCannotFollow
//   where it can stand           ImpossiblePose.*, ImpossibleStop.*
namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");
const plant::VehicleId kV2("V2");

class Iso3691 : public ::testing::Test {
protected:
    Iso3691() { world.connect_all(); }

    FakeVehicle& v1() { return world.vehicle("V1"); }
    VehicleView view(const plant::VehicleId& id = kV1) {
        return *world.fleet->vehicle(id, world.now);
    }
    bool was_told(const std::string& type) {
        const auto& done = v1().state.action_states;
        return std::any_of(done.begin(), done.end(), [&](const auto& a) { return a.type == type; });
    }
    /// V1 has an order to station 4 and stands at the beginning of its way.
    void start() {
        world.vehicles_move = false;
        ASSERT_TRUE(world.order("V2", {3}));  // out of its way later
        world.vehicles_move = true;
        world.run(60);
        world.vehicles_move = false;
        ASSERT_TRUE(world.order("V1", {2}));
        world.run(1);
        ASSERT_TRUE(world.store.vehicles.at(kV1).has_leg);
    }
    void cut(const plant::VehicleId& id) {
        world.fleet->vehicle_disconnected(id, world.now);
        world.connected[id] = false;
    }
    void join(const plant::VehicleId& id) {
        world.connected[id] = true;
        world.fleet->vehicle_connected(id, world.now);
    }

    World world;
};

TEST_F(Iso3691, TheSafetyStateIsShownAsReceived) {
    v1().state.e_stop = "AUTOACK";
    v1().state.field_violation = true;
    world.run(1);
    EXPECT_EQ(view().state.e_stop, "AUTOACK");
    EXPECT_TRUE(view().state.field_violation);
}

TEST_F(Iso3691, AndWithItsAge) {
    v1().state.e_stop = "MANUAL";
    world.run(1);
    const Time heard = world.now;
    cut(kV1);
    world.run(30);
    EXPECT_EQ(view().state.e_stop, "MANUAL") << "nobody has said that it is over";
    ASSERT_TRUE(view().pose_at && view().last_heard);
    EXPECT_LE(*view().pose_at, heard);
    EXPECT_LE(*view().last_heard, heard);
}

TEST_F(Iso3691, ASafetyStopBarsAStart) {
    v1().state.e_stop = "MANUAL";
    world.run(1);
    static_cast<void>(world.order("V1", {2}));
    world.run(20);
    EXPECT_EQ(v1().orders_received, 0);
}

TEST_F(Iso3691, AViolatedFieldBarsAStart) {
    v1().state.field_violation = true;
    world.run(1);
    static_cast<void>(world.order("V1", {2}));
    world.run(20);
    EXPECT_EQ(v1().orders_received, 0);
}

TEST_F(Iso3691, AFatalErrorBarsAStart) {
    v1().state.errors.push_back({"driveFault", true, "the drive is hot", {}});
    world.run(1);
    static_cast<void>(world.order("V1", {2}));
    world.run(20);
    EXPECT_EQ(v1().orders_received, 0);
}

TEST_F(Iso3691, NoCommandTouchesASafetyStop) {
    start();
    const auto before = v1().state.action_states.size();
    v1().state.e_stop = "MANUAL";
    v1().state.field_violation = true;
    world.run(30);
    EXPECT_EQ(v1().state.action_states.size(), before) << "something was sent to it";
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(5);
    EXPECT_EQ(v1().state.action_states.size(), before) << "a resume is not a reset";
    EXPECT_EQ(view().state.e_stop, "MANUAL");
}

TEST_F(Iso3691, MotionIsReleasedInBoundedPieces) {
    world.vehicles_move = false;
    cut(kV2);
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(1);
    const Leg& leg = world.store.vehicles.at(kV1).leg_data;
    EXPECT_GT(leg.released_nodes, 1u);
    EXPECT_LT(leg.released_nodes, leg.nodes.size());
}

TEST_F(Iso3691, ALostVehicleWaitsForAPersonWhenItIsHeardAgain) {
    start();
    cut(kV1);
    world.run(15);
    join(kV1);
    world.run(5);
    EXPECT_TRUE(view().needs_resume);
    EXPECT_EQ(view().needs_resume_reason.code, "vehicle_was_lost");
    EXPECT_NE(world.store.orders.rbegin()->second.state, JobState::kRunning);
}

TEST_F(Iso3691, AReconnectEndsNoPause) {
    ASSERT_TRUE(world.fleet->pause_vehicle(kV1, "op", world.now));
    world.run(1);
    cut(kV1);
    world.run(5);
    join(kV1);
    static_cast<void>(world.order("V1", {2}));
    world.run(20);
    EXPECT_TRUE(view().paused);
    EXPECT_EQ(v1().orders_received, 0);
    EXPECT_FALSE(was_told("stopPause"));
}

TEST_F(Iso3691, ARestartOfTheServerEndsNoPause) {
    ASSERT_TRUE(world.fleet->pause_vehicle(kV1, "op", world.now));
    world.run(1);
    world.crash_server();
    static_cast<void>(world.order("V1", {2}));
    world.run(20);
    EXPECT_TRUE(view().paused);
    EXPECT_EQ(v1().orders_received, 0);
    EXPECT_FALSE(was_told("stopPause"));
}

TEST_F(Iso3691, APauseMadeAtTheVehicleIsNotEndedByTheServer) {
    v1().state.paused = true;
    world.run(1);
    static_cast<void>(world.order("V1", {2}));
    world.run(20);
    EXPECT_TRUE(v1().state.paused);
    EXPECT_EQ(v1().orders_received, 0);
}

TEST_F(Iso3691, WhoLetItGoOnIsWrittenDown) {
    ASSERT_TRUE(world.fleet->pause_vehicle(kV1, "ann", world.now));
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "bob", world.now));
    world.settle();
    std::vector<std::string> acts;
    for (const auto& event : world.store.events) {
        if (event.type == "vehicle.paused" || event.type == "vehicle.resumed") {
            acts.push_back(event.type + " " + event.actor + " " + event.vehicle.str());
        }
    }
    EXPECT_EQ(acts, (std::vector<std::string>{"vehicle.paused ann V1", "vehicle.resumed bob V1"}));
}

TEST_F(Iso3691, WhoHadItStandIsShownAndKept) {
    const Time singly = world.now;
    ASSERT_TRUE(world.fleet->pause_vehicle(kV1, "ann", world.now));
    world.run(1);
    const Time both = world.now;
    world.fleet->pause_fleet("bob", world.now);
    world.run(1);
    const auto holds = [&] {
        EXPECT_EQ(view(kV1).paused, (Pause{"ann", singly, false})) << "it was paused before";
        EXPECT_EQ(view(kV2).paused, (Pause{"bob", both, true}));
        EXPECT_EQ(world.fleet->view(world.now).pause, (Pause{"bob", both, true}));
        ASSERT_TRUE(view(kV2).reason);
        EXPECT_EQ(*view(kV2).reason,
                  (Reason{"vehicle_paused", {{"vehicle", "V2"}, {"actor", "bob"}}}));
    };
    holds();
    world.crash_server();
    world.run(1);
    holds();
    ASSERT_TRUE(world.fleet->resume_fleet({kV2}, "bob", world.now));
    EXPECT_FALSE(world.fleet->view(world.now).pause) << "only the other one's own pause is left";
}

TEST_F(Iso3691, APausedVehicleStandsWhenItHasSaidSo) {
    start();
    world.vehicles_move = false;
    v1().state.driving = true;
    world.run(1);
    ASSERT_TRUE(world.fleet->pause_vehicle(kV1, "ann", world.now));
    EXPECT_FALSE(view().stands_paused) << "it has not even been told";
    world.settle();
    world.run(1);
    ASSERT_TRUE(v1().state.paused);
    EXPECT_FALSE(view().stands_paused) << "it brakes";
    v1().state.driving = false;
    world.run(1);
    EXPECT_TRUE(view().stands_paused);
}

TEST_F(Iso3691, AResumeIsForTheVehiclesThatItNames) {
    world.fleet->pause_fleet("op", world.now);
    world.run(1);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(1);
    EXPECT_FALSE(view(kV1).paused);
    EXPECT_TRUE(view(kV2).paused);
}

TEST_F(Iso3691, ASilentVehicleIsNotResumed) {
    start();
    cut(kV1);
    world.run(15);
    const auto refused = world.fleet->resume_fleet({kV1}, "op", world.now);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "vehicle_silent");
}

TEST_F(Iso3691, OneThatIsBackIsNotCalledSilentAndNotResumedBeforeItsReport) {
    start();
    cut(kV1);
    world.run(15);
    world.fleet->vehicle_connected(kV1, world.now);
    const VehicleView back = view();
    EXPECT_EQ(back.link, Link::kLive);
    EXPECT_TRUE(back.needs_resume);
    ASSERT_TRUE(back.reason);
    EXPECT_EQ(back.reason->code, "vehicle_not_reported");
    const auto refused = world.fleet->resume_fleet({kV1}, "op", world.now);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "vehicle_not_reported");
    world.connected[kV1] = true;
    world.run(2);
    EXPECT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
}

TEST_F(Iso3691, OneInSomebodysHandsIsNotResumed) {
    v1().state.operating_mode = "MANUAL";
    world.run(1);
    const auto refused = world.fleet->resume_fleet({kV1}, "op", world.now);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "not_automatic");
}

TEST_F(Iso3691, OneInSomebodysHandsGetsNothing) {
    v1().state.operating_mode = "MANUAL";
    world.run(1);
    static_cast<void>(world.order("V1", {2}));
    world.run(20);
    EXPECT_EQ(v1().orders_received, 0);
}

TEST_F(Iso3691, WhatAVehicleHasForgottenIsNotSentAgain) {
    start();
    const int before = v1().orders_received;
    v1().restart();
    v1().sees_codes = false;
    world.run(30);
    EXPECT_EQ(v1().orders_received, before);
}

TEST_F(Iso3691, ToSayWhereItStandsLetsNothingMove) {
    start();
    const int before = v1().orders_received;
    v1().sees_codes = false;
    v1().restart();
    world.run(2);
    ASSERT_TRUE(world.fleet->init_position(kV1, {*v1().state.pose}, "op", world.now));
    world.run(30);
    EXPECT_TRUE(view().pose_known);
    EXPECT_EQ(v1().orders_received, before);
}

TEST_F(Iso3691, NoEdgeIsFasterThanTheVehicleMay) {
    start();
    const double most =
        plant::find_vehicle_type(world.plant, plant::VehicleTypeId("small"))->max_speed_mps;
    ASSERT_FALSE(v1().order().edges.empty());
    for (const auto& edge : v1().order().edges) EXPECT_LE(edge.max_speed_mps, most);
}

TEST_F(Iso3691, OneTakenOutGetsNothing) {
    ASSERT_TRUE(world.fleet->integrate(kV1, Integration::kRespect, false, "op", world.now));
    static_cast<void>(world.order("V1", {2}));
    world.run(20);
    EXPECT_EQ(v1().orders_received, 0);
}

}  // namespace
}  // namespace pulseline::fleet::testing
