#include "core/fleet/legs/leg_plan_answerer.hpp"

#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

// Free manoeuvres are planned beside the fleet: the order waits, nobody else does.
namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");

plant::Plant hall_of_free_drivers() {
    plant::Plant plant = small_plant();
    plant.vehicle_types.front().motion_modes.push_back(plant::MotionMode::kFree);
    return plant;
}

/// A world whose questions wait until the test answers them, with a free drive ordered.
struct Asked {
    Asked() {
        world.plans_at_once = false;
        world.connect_all();
        order = world.order("V1", {3}, plant::MotionMode::kFree).value().order.id;
        world.run(0.5);
    }
    void answer(const LegPlanQuestion& question) {
        world.fleet->leg_planned(question.vehicle, question.number, world.answerer.answer(question),
                                 world.now);
        world.settle();
    }
    World world{hall_of_free_drivers()};
    JobOrderId order;
};

TEST(LegPlans, AFreeDriveWaitsForItsPlanAndThenGoes) {
    Asked asked;
    World& world = asked.world;
    ASSERT_EQ(world.questions.size(), 1u) << "asked once, however often it is tried";
    EXPECT_EQ(world.questions.front().vehicle, kV1);
    EXPECT_EQ(world.stored(asked.order).state, JobState::kRunning);
    EXPECT_EQ(world.stored(asked.order).reason.code, "plan_under_way");
    EXPECT_FALSE(world.store.vehicles[kV1].has_leg);

    asked.answer(world.questions.front());
    EXPECT_TRUE(world.store.vehicles[kV1].has_leg) << "at once, not at the next tick";
    EXPECT_EQ(world.store.vehicles[kV1].leg_data.mode, plant::MotionMode::kFree);
    world.run(120);

    EXPECT_EQ(world.stored(asked.order).state, JobState::kEnded)
        << world.stored(asked.order).reason.code;
}

/// V2 stands at station 2, between V1 and station 3, and may not move.
struct Barred {
    Barred() {
        plant::Plant plant = hall_of_free_drivers();
        plant.vehicles.back().home = plant::StationId("s2");
        world.emplace(std::move(plant));
        world->connect_all();
        EXPECT_TRUE(world->fleet->pause_vehicle(plant::VehicleId("V2"), "op", world->now));
        world->plans_at_once = false;
        order = world->order("V1", {3}, plant::MotionMode::kFree).value().order.id;
        world->run(0.5);
    }
    void answer(const LegPlanQuestion& question) {
        world->fleet->leg_planned(question.vehicle, question.number,
                                  world->answerer.answer(question), world->now);
        world->settle();
    }
    std::optional<World> world;
    JobOrderId order;
};

TEST(LegPlans, AFreeDriveGoesRoundWhoStandsInItsWay) {
    Barred barred;
    ASSERT_EQ(barred.world->questions.size(), 1u);
    barred.answer(barred.world->questions.front());
    barred.world->run(120);
    EXPECT_EQ(barred.world->stored(barred.order).state, JobState::kEnded)
        << barred.world->stored(barred.order).reason.code;
}

TEST(LegPlans, OneThatOthersBarIsAskedForAnewAndKeepsItsReasonMeanwhile) {
    Barred barred;
    World& world = *barred.world;
    ASSERT_EQ(world.questions.size(), 1u);
    LegPlanQuestion before = world.questions.front();
    before.standing.clear();  // V2 had not come yet
    barred.answer(before);
    EXPECT_EQ(world.stored(barred.order).reason.code, "floor_held");
    world.run(11);

    ASSERT_EQ(world.questions.size(), 2u);
    EXPECT_EQ(world.stored(barred.order).reason.code, "floor_held");
    barred.answer(world.questions.back());
    world.run(120);
    EXPECT_EQ(world.stored(barred.order).state, JobState::kEnded)
        << world.stored(barred.order).reason.code;
}

TEST(LegPlans, WhereThereIsNoWayAnyMoreTheOneThatWasKnownIsKept) {
    Barred barred;
    World& world = *barred.world;
    LegPlanQuestion before = world.questions.front();
    before.standing.clear();
    barred.answer(before);
    world.run(11);
    ASSERT_EQ(world.questions.size(), 2u);
    world.fleet->leg_planned(kV1, world.questions.back().number,
                             {std::nullopt, {"no_free_way", {{"enclosed", true}}}}, world.now);
    world.run(1);
    EXPECT_EQ(world.stored(barred.order).state, JobState::kRunning);
    ASSERT_TRUE(world.fleet->resume_fleet({plant::VehicleId("V2")}, "op", world.now));
    world.run(120);
    EXPECT_EQ(world.stored(barred.order).state, JobState::kEnded)
        << "V2 was asked to leave: " << world.stored(barred.order).reason.code;
}

TEST(LegPlans, OneThatIsNotAnsweredIsAskedForAgainAndTheOldAnswerCountsNoMore) {
    Asked asked;
    World& world = asked.world;
    world.run(5);
    ASSERT_EQ(world.questions.size(), 2u);

    asked.answer(world.questions[0]);
    EXPECT_FALSE(world.store.vehicles[kV1].has_leg);
    asked.answer(world.questions[1]);
    EXPECT_TRUE(world.store.vehicles[kV1].has_leg);
}

TEST(LegPlans, WhereThereIsNoWayAPersonIsToldWhy) {
    Asked asked;
    World& world = asked.world;
    world.fleet->leg_planned(kV1, world.questions.front().number,
                             {std::nullopt, {"no_free_way", {{"enclosed", true}}}}, world.now);
    world.settle();

    EXPECT_EQ(world.stored(asked.order).state, JobState::kInterrupted);
    EXPECT_EQ(world.stored(asked.order).reason.code, "no_free_way");
}

TEST(LegPlans, FloorThatIsClosedMeanwhileIsAskedForAnew) {
    Asked asked;
    World& world = asked.world;
    NewClosure wet;
    wet.name = "wet";
    wet.hall = world.plant.halls.front().id;
    wet.outline = {{30, 30}, {31, 30}, {31, 31}, {30, 31}};
    ASSERT_TRUE(world.fleet->close_floor(wet, "op", world.now));
    world.settle();
    asked.answer(world.questions.front());
    EXPECT_FALSE(world.store.vehicles[kV1].has_leg);

    world.run(0.5);
    ASSERT_EQ(world.questions.size(), 2u);
    EXPECT_EQ(world.questions[1].closures.size(), 1u);
}

TEST(LegPlans, AQuestionAndAnAnswerOutliveTheFleetsRebuilding) {
    Asked asked;
    World& world = asked.world;
    const auto rebuild = [&] {
        auto again = Fleet::from_snapshot(world.plant, world.fleet->snapshot());
        ASSERT_TRUE(again);
        world.fleet = std::move(*again);
    };
    rebuild();
    world.run(0.5);
    EXPECT_EQ(world.questions.size(), 1u);

    world.fleet->pause_vehicle(kV1, "op", world.now);
    asked.answer(world.questions.front());
    rebuild();
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(1);
    EXPECT_EQ(world.questions.size(), 1u) << "the answer was kept";
    EXPECT_TRUE(world.store.vehicles[kV1].has_leg);
}

TEST(LegPlans, AnAnswerThatTheFleetBeforeAskedForCountsNoMore) {
    Asked asked;
    World& world = asked.world;
    const auto old = world.questions;
    ASSERT_EQ(old.size(), 1u);
    world.crash_server();  // what was not stored is gone, and with it perhaps floor that was closed
    world.run(0.5);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(0.5);
    ASSERT_EQ(world.questions.size(), 2u);

    asked.answer(old.front());
    EXPECT_FALSE(world.store.vehicles[kV1].has_leg);
    asked.answer(world.questions.back());
    EXPECT_TRUE(world.store.vehicles[kV1].has_leg);
}

}  // namespace
}  // namespace pulseline::fleet::testing
