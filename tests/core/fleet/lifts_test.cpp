#include "core/fleet/vehicle/lifts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/fleet/vehicle/readiness.hpp"
#include "tests/core/fleet/fleet_world.hpp"
#include "tests/core/plant/loads.hpp"

// Brackets and parking feet that a person moves outside an order (Tang 2020, section 2).
namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");

const StepAction kAllUp{"setBracketHeight", {{"bracket", std::string("all")}, {"height_m", 0.05}}};
const StepAction kOneUp{"setBracketHeight",
                        {{"bracket", std::string("front left")}, {"height_m", 0.05}}};
const StepAction kFeetDown{"lowerParking", {}};

plant::Plant with_brackets() {
    plant::Plant plant = small_plant();
    auto& type = plant.vehicle_types.front();
    type.brackets = plant::builders::four_brackets();
    type.parking = plant::usual_parking(type.footprint);
    plant::builders::put_on(plant, 0, "J-1");
    return plant;
}

class Lifts : public ::testing::Test {
protected:
    Lifts() : world(with_brackets()) {
        world.connect_all();
        world.announce({"raiseParking", "lowerParking", "setBracketHeight", "stopLifts"});
        v1().lifts_end = false;
        load(1000, 1000);
        world.run(1);
    }

    FakeVehicle& v1() { return world.vehicle("V1"); }
    void load(double left_n, double right_n) {
        v1().state.brackets.clear();
        for (const auto& bracket : world.plant.vehicle_types.front().brackets) {
            const double force_n = bracket.position.y_m > 0 ? left_n : right_n;
            v1().state.brackets.push_back({bracket.name, force_n / 2, force_n / 2, 0.0});
        }
    }
    Result<VehicleView> move(const StepAction& lift, const std::string& actor = "op") {
        auto moved = world.fleet->move_lifts(kV1, lift, actor, world.now);
        world.settle();
        return moved;
    }
    std::string refusal(const StepAction& lift) {
        const auto moved = move(lift);
        return moved ? "" : moved.error().reason.code;
    }
    LiftMove lift() const { return *world.fleet->vehicle(kV1, world.now)->lift; }
    /// Those that came to the vehicle.
    std::ptrdiff_t told(const std::string& type) {
        const auto& states = v1().state.action_states;
        return std::count_if(states.begin(), states.end(),
                             [&](const auto& action) { return action.type == type; });
    }
    void cut() {
        world.fleet->vehicle_disconnected(kV1, world.now);
        world.connected[kV1] = false;
    }
    void join() {
        world.connected[kV1] = true;
        world.fleet->vehicle_connected(kV1, world.now);
    }

    World world;
};

TEST_F(Lifts, MoveOnceAndTellWhoWantedItAndWhatBecameOfIt) {
    const auto moved = move(kAllUp, "Li Wei");
    ASSERT_TRUE(moved) << moved.error().what;
    world.run(5);
    EXPECT_EQ(told("setBracketHeight"), 1) << "resent until it ends, and done once";
    EXPECT_EQ(lift().state, LiftMove::State::kUnderWay);
    EXPECT_EQ(lift().actor, "Li Wei");
    EXPECT_EQ(lift().what, kAllUp);

    v1().end_lifts();
    world.run(1);
    EXPECT_EQ(lift().state, LiftMove::State::kDone);
    EXPECT_EQ(world.count_events("vehicle.lifts"), 1);
    EXPECT_EQ(std::ranges::count_if(world.store.events,
                                    [](const Event& event) {
                                        return event.type == "vehicle.action" &&
                                               event.params.front() ==
                                                   Param{"action", std::string("setBracketHeight")};
                                    }),
              1);
}

TEST_F(Lifts, OneFootAloneAndBracketsAtTheirSpeedAreToldToTheVehicle) {
    const std::string foot = world.plant.vehicle_types.front().parking->feet.at(1).name;
    const StepAction down{"lowerParking", {{"foot", foot}}};
    ASSERT_TRUE(move(down));
    EXPECT_EQ(lift().what, down);
    v1().end_lifts();
    world.run(1);
    StepAction slow = kAllUp;
    slow.params.push_back({"speed_mps", 0.002});
    ASSERT_TRUE(move(slow));
    EXPECT_EQ(lift().what, slow);
}

TEST_F(Lifts, AVehicleThatRefusesSaysWhy) {
    ASSERT_TRUE(move(kAllUp));
    v1().end_lifts("out_of_stroke: height_m 0.5, stroke_m 0.3");
    world.run(1);
    EXPECT_EQ(lift().state, LiftMove::State::kFailed);
    EXPECT_EQ(lift().why, "out_of_stroke: height_m 0.5, stroke_m 0.3");
}

TEST_F(Lifts, NoOrderStartsWhileTheyMove) {
    ASSERT_TRUE(move(kFeetDown));
    world.run(1);
    const auto order = world.order("V1", {2});
    ASSERT_TRUE(order);
    world.run(10);
    EXPECT_EQ(world.fleet->order(order->order.id)->reason.code, "lifts_moving");
    EXPECT_FALSE(world.store.vehicles.at(kV1).has_leg);
    EXPECT_EQ(world.fleet->vehicle(kV1, world.now)->reason->code, "lifts_moving");

    v1().end_lifts();
    world.run(60);
    EXPECT_EQ(world.stored(order->order.id).state, JobState::kEnded);
}

TEST_F(Lifts, OfOneWhoIsBusyPausedOrAlreadyLiftingStayWhereTheyAre) {
    EXPECT_EQ(refusal({"fly", {}}), "unknown_lift");
    EXPECT_EQ(
        refusal({"setBracketHeight", {{"bracket", std::string("middle")}, {"height_m", 0.1}}}),
        "unknown_bracket");
    EXPECT_EQ(refusal({"setBracketHeight", {{"bracket", std::string("all")}, {"height_m", 0.301}}}),
              "out_of_stroke");
    StepAction fast = kAllUp;
    fast.params.push_back({"speed_mps", 0.0101});
    EXPECT_EQ(refusal(fast), "out_of_speed");
    EXPECT_EQ(refusal({"raiseParking", {{"foot", std::string("middle")}}}), "unknown_foot");
    ASSERT_TRUE(move(kAllUp, "first"));
    const auto second = move(kFeetDown, "second");
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().reason.code, "lifts_moving");
    EXPECT_NE(second.error().what.find("first"), std::string::npos) << second.error().what;
    v1().end_lifts();
    world.run(1);

    ASSERT_TRUE(world.fleet->pause_vehicle(kV1, "op", world.now));
    world.run(1);
    EXPECT_EQ(refusal(kAllUp), "vehicle_paused");
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(1);

    ASSERT_TRUE(world.order("V1", {2}));
    world.run(0.5);
    EXPECT_EQ(refusal(kAllUp), "vehicle_busy");
    EXPECT_EQ(told("setBracketHeight") + told("lowerParking"), 0)
        << "an order forgets what was before it, and nothing has come since";
}

TEST_F(Lifts, WithALoadThatLeansOnlySingleBracketsMove) {
    load(1600, 400);
    world.run(1);
    EXPECT_EQ(refusal(kAllUp), "load_unbalanced");
    EXPECT_EQ(refusal(kFeetDown), "load_unbalanced");
    EXPECT_EQ(refusal(kOneUp), "");
}

TEST_F(Lifts, APauseHoldsThemAndTheyGoOnByAPersonOnly) {
    ASSERT_TRUE(move(kAllUp));
    world.run(1);
    world.fleet->pause_fleet("op", world.now);
    world.run(1);
    EXPECT_EQ(lift().state, LiftMove::State::kFailed);
    EXPECT_EQ(lift().why, "vehicle_paused");
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(5);
    EXPECT_EQ(told("setBracketHeight"), 1);
}

TEST_F(Lifts, AreHeldByWhoeverSees) {
    ASSERT_TRUE(move(kAllUp));
    world.run(1);
    ASSERT_TRUE(world.fleet->stop_lifts(kV1, "somebody else", world.now));
    ASSERT_TRUE(world.fleet->stop_lifts(kV1, "a third", world.now)) << "pressed twice";
    world.run(2);
    EXPECT_EQ(lift().why, "lifts_stopped");
    EXPECT_EQ(told("stopLifts"), 1);
    EXPECT_EQ(world.count_events("vehicle.lifts_stopped"), 2);
    EXPECT_EQ(refusal(kAllUp), "") << "and may be moved on";
}

TEST_F(Lifts, OfACutLineAreNotAskedForAgain) {
    ASSERT_TRUE(move(kAllUp));
    world.run(1);
    cut();
    EXPECT_EQ(lift().state, LiftMove::State::kFailed);
    EXPECT_EQ(lift().why, "link_lost");
    world.run(3);
    EXPECT_EQ(world.fleet->move_lifts(kV1, kAllUp, "op", world.now).error().reason.code,
              "vehicle_silent");
    v1().end_lifts("link_lost");
    join();
    world.run(5);
    EXPECT_EQ(told("setBracketHeight"), 1) << "nobody looks at it any more";
    EXPECT_EQ(world.count_events("vehicle.action_unconfirmed"), 0);
}

TEST_F(Lifts, ThatHadNotReachedTheVehicleWhenTheLineBrokeNeverMove) {
    ASSERT_TRUE(world.fleet->move_lifts(kV1, kAllUp, "op", world.now));
    cut();
    world.settle();
    v1().state.action_states.clear();
    join();
    world.run(15);
    EXPECT_EQ(told("setBracketHeight"), 0);
    EXPECT_FALSE(lift().state == LiftMove::State::kUnderWay);
}

TEST_F(Lifts, OfAVehicleTakenOffTheFloorAreGivenUp) {
    ASSERT_TRUE(move(kAllUp));
    world.run(1);
    ASSERT_TRUE(world.fleet->integrate(kV1, Integration::kIgnore, true, "op", world.now));
    EXPECT_EQ(lift().state, LiftMove::State::kFailed);
}

TEST_F(Lifts, WhoeverWaitsForAPersonMovesNothing) {
    ASSERT_TRUE(move(kAllUp));
    v1().end_lifts();
    v1().state.errors = {{"x", true, "broken", {}}};
    world.run(1);
    v1().state.errors.clear();
    world.run(1);
    EXPECT_EQ(refusal(kAllUp), "needs_person");
    EXPECT_EQ(refusal(kFeetDown), "needs_person");
    EXPECT_EQ(told("setBracketHeight"), 1);
}

// The server dies, and the vehicle broke off what it had begun: the next server says so.
TEST_F(Lifts, ThatWereBrokenOffWhileNoServerListenedAreToldByTheVehicle) {
    ASSERT_TRUE(move(kAllUp));
    world.run(1);
    v1().end_lifts("link_lost");
    world.crash_server();
    world.connect_all();
    world.run(1);
    ASSERT_TRUE(world.fleet->vehicle(kV1, world.now)->lift);
    EXPECT_EQ(lift().state, LiftMove::State::kFailed);
    EXPECT_EQ(lift().why, "link_lost");
    EXPECT_EQ(lift().what.type, "setBracketHeight");
}

TEST_F(Lifts, OfAnOrderAreRefusedWithItsFieldBeforeItDrives) {
    NewOrder order;
    order.vehicle = kV1;
    order.steps = {{2}};
    order.actor = "op";
    const auto refused = [&](const StepAction& action) {
        order.steps[0].after = {{"lowerParking", {}}, action};
        const auto made = world.order(order);
        return made ? std::pair<std::string, std::string>()
                    : std::pair(made.error().reason.code, made.error().field);
    };
    const auto height = [](const std::string& bracket, double height_m) {
        return StepAction{"setBracketHeight", {{"bracket", bracket}, {"height_m", height_m}}};
    };
    const std::string at = "/steps/0/after/1/parameters/";
    EXPECT_EQ(refused(height("all", 0.9)),
              std::pair(std::string("out_of_stroke"), at + "height_m"));
    EXPECT_EQ(refused({"setBracketHeight", {{"bracket", std::string("all")}}}),
              std::pair(std::string("out_of_stroke"), at + "height_m"));
    EXPECT_EQ(refused(height("fifth", 0.1)),
              std::pair(std::string("unknown_bracket"), at + "bracket"));
    auto fast = height("all", 0.1);
    fast.params.push_back({"speed_mps", 0.5});
    EXPECT_EQ(refused(fast), std::pair(std::string("out_of_speed"), at + "speed_mps"));
    EXPECT_EQ(refused({"lowerParking", {{"foot", std::string("fifth")}}}),
              std::pair(std::string("unknown_foot"), at + "foot"));
    EXPECT_TRUE(world.store.orders.empty()) << "nothing half done";
    EXPECT_EQ(refused(height("front left", 0.1)).first, "");
}

}  // namespace
}  // namespace pulseline::fleet::testing
