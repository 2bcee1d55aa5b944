#include "core/fleet/orders/start_conditions.hpp"

#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

/// What an order says of its start and its vehicle, over the real fleet.
namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");
const plant::VehicleId kV2("V2");

NewOrder to(int station, const std::string& vehicle = "") {
    NewOrder order;
    order.vehicle = plant::VehicleId(vehicle);
    order.steps = {{station}};
    return order;
}

ControlRequest asks(JobMethod method) {
    ControlRequest request;
    request.method = method;
    request.actor = "mes";
    return request;
}

struct StartConditions : ::testing::Test {
    StartConditions() { world.connect_all(); }
    JobOrderId make(const NewOrder& order) {
        const auto made = world.order(order);
        EXPECT_TRUE(made) << made.error().what;
        return made->order.id;
    }
    const JobOrder& now(JobOrderId id) { return world.stored(id); }
    void expect_refused(const NewOrder& order, const std::string& code, const std::string& field) {
        const std::size_t before = world.store.orders.size();
        const auto made = world.order(order);
        ASSERT_FALSE(made) << code;
        EXPECT_EQ(made.error().reason.code, code);
        EXPECT_EQ(made.error().field, field);
        EXPECT_FALSE(made.error().what.empty());
        EXPECT_EQ(world.store.orders.size(), before) << "nothing is stored";
    }
    /// Servers die; a person lets the vehicles move.
    void crash_and_resume() {
        world.crash_server();
        world.run(1);
        ASSERT_TRUE(world.fleet->resume_fleet({kV1, kV2}, "op", world.now));
        world.settle();
    }
    World world;
};

TEST_F(StartConditions, AnOrderIsNotAssignedBeforeItsEarliestStart) {
    NewOrder order = to(2, "V1");
    order.earliest_start = world.now + from_seconds(100);
    order.due = world.now + from_seconds(200);
    const auto id = make(order);

    world.run(95);
    EXPECT_EQ(now(id).state, JobState::kAllowedToStart);
    EXPECT_EQ(now(id).reason.code, "earliest_start");
    world.run(60);

    EXPECT_EQ(now(id).state, JobState::kEnded);
    EXPECT_GE(now(id).started, *order.earliest_start);
    EXPECT_EQ(now(id).due, order.due);
}

TEST_F(StartConditions, DueBeforeTheEarliestStartIsRefused) {
    NewOrder order = to(2);
    order.earliest_start = world.now + from_seconds(100);
    order.due = world.now + from_seconds(50);
    expect_refused(order, "due_before_start", "/due");
}

TEST_F(StartConditions, VehicleAndTypeHaveToBeKnownAndFit) {
    plant::Plant plant = small_plant();
    plant::VehicleType other = plant.vehicle_types.front();
    other.id = plant::VehicleTypeId("other");
    plant.vehicle_types.push_back(other);
    plant.vehicles.at(1).type = other.id;
    World two(plant);
    two.connect_all();
    NewOrder of_other = to(3);
    of_other.vehicle_type = other.id;

    const auto made = two.order(of_other);
    ASSERT_TRUE(made) << made.error().what;
    EXPECT_EQ(made->order.assigned_vehicle, kV2) << "V1 is nearer, but not of the type";

    NewOrder unfit = of_other;
    unfit.vehicle = kV1;
    EXPECT_EQ(two.order(unfit).error().reason.code, "vehicle_not_of_type");
    EXPECT_EQ(two.order(unfit).error().field, "/vehicle_type");
    unfit.vehicle_type = plant::VehicleTypeId("none");
    EXPECT_EQ(two.order(unfit).error().reason.code, "unknown_vehicle_type");
}

TEST_F(StartConditions, ADependentOrderStartsWhenTheOtherHasEnded) {
    NewOrder first = to(2, "V1");
    first.client_order_id = "WO-1";
    const auto one = make(first);
    NewOrder second = to(3, "V2");
    second.after = {"WO-1"};
    const auto two = make(second);

    EXPECT_EQ(now(two).state, JobState::kAllowedToStart);
    EXPECT_EQ(now(two).reason, (Reason{"dependency_open", {{"order", std::string("JO-1")}}}));
    world.run(60);

    EXPECT_EQ(now(one).state, JobState::kEnded);
    EXPECT_EQ(now(two).state, JobState::kEnded);
    EXPECT_GE(now(two).started, now(one).ended);
    EXPECT_EQ(now(two).after.at(0).outcome, JobState::kEnded);
}

TEST_F(StartConditions, AfterAnAbortedOrderItWaitsUntilAPersonUpdatesIt) {
    NewOrder first = to(2, "V1");
    first.earliest_start = world.now + from_seconds(1000);
    const auto one = make(first);
    NewOrder second = to(3, "V2");
    second.after = {one.str()};
    const auto two = make(second);
    ASSERT_TRUE(world.fleet->control_order(one, asks(JobMethod::kAbort), world.now));
    world.run(30);

    EXPECT_EQ(now(two).state, JobState::kAllowedToStart) << "never started on a broken promise";
    EXPECT_EQ(now(two).reason.code, "dependency_aborted");

    ControlRequest update = asks(JobMethod::kUpdate);
    update.update = to(3, "V2");
    ASSERT_TRUE(world.fleet->control_order(two, update, world.now));
    world.run(60);
    EXPECT_EQ(now(two).state, JobState::kEnded);
}

TEST_F(StartConditions, ADependencyTakenOutCountsAsItEnded) {
    const auto one = make(to(2, "V1"));
    NewOrder second = to(3, "V2");
    second.after = {one.str()};
    second.earliest_start = world.now + from_seconds(100);
    const auto two = make(second);
    world.run(60);
    ASSERT_TRUE(world.fleet->control_order(one, asks(JobMethod::kClear), world.now));
    world.run(100);

    EXPECT_EQ(now(two).state, JobState::kEnded);
}

TEST_F(StartConditions, WhatBecameOfADependencyIsKnownAfterTheFleetForgotIt) {
    const auto one = make(to(2, "V1"));
    NewOrder second = to(3, "V2");
    second.after = {one.str()};
    second.start = false;
    const auto two = make(second);
    world.run(60);
    world.now += std::chrono::hours(24 * 8);
    world.store.orders.erase(one);
    crash_and_resume();
    ASSERT_TRUE(world.fleet->control_order(two, asks(JobMethod::kStart), world.now));
    world.run(60);

    EXPECT_FALSE(world.fleet->order(one));
    EXPECT_EQ(now(two).state, JobState::kEnded);
}

TEST_F(StartConditions, UnknownAbortedAndCircularDependenciesAreRefused) {
    NewOrder order = to(2, "V1");
    order.after = {"WO-9"};
    expect_refused(order, "unknown_job_order", "/after/0");

    NewOrder first = to(2, "V1");
    first.start = false;
    const auto one = make(first);
    NewOrder second = to(3, "V2");
    second.start = false;
    second.after = {one.str()};
    const auto two = make(second);
    ControlRequest update = asks(JobMethod::kUpdate);
    update.update = to(2, "V1");
    update.update->after = {two.str()};
    const auto circle = world.fleet->control_order(one, update, world.now);
    ASSERT_FALSE(circle);
    EXPECT_EQ(circle.error().reason.code, "dependency_cycle");
    EXPECT_EQ(circle.error().field, "/order/after");

    ASSERT_TRUE(world.fleet->control_order(one, asks(JobMethod::kAbort), world.now));
    world.settle();
    order.after = {one.str()};
    expect_refused(order, "dependency_aborted", "/after/0");
}

TEST_F(StartConditions, ACircleThroughASequenceIsRefusedToo) {
    NewOrder member = to(2);
    member.start = false;
    member.sequence = "S";
    const auto one = make(member);
    const auto two = make(member);
    ControlRequest update = asks(JobMethod::kUpdate);
    update.update = member;
    update.update->after = {two.str()};

    const auto circle = world.fleet->control_order(one, update, world.now);

    ASSERT_FALSE(circle) << "the second waits for the first by its place";
    EXPECT_EQ(circle.error().reason.code, "dependency_cycle");
}

// --- sequences ---

TEST_F(StartConditions, ASequenceKeepsOneVehicleAndItsOrder) {
    NewOrder member = to(3);
    member.sequence = "wing";
    std::vector<JobOrderId> ids;
    for (const int station : {3, 4, 3}) {
        member.steps = {{station}};
        ids.push_back(make(member));
    }
    const auto other = make(to(2));  // any vehicle
    EXPECT_EQ(now(ids[1]).reason.code, "sequence_earlier");
    world.run(200);

    Time ended{};
    for (const auto& id : ids) {
        EXPECT_EQ(now(id).state, JobState::kEnded);
        EXPECT_EQ(now(id).assigned_vehicle, now(ids[0]).assigned_vehicle);
        EXPECT_GE(now(id).started, ended);
        ended = now(id).ended;
    }
    EXPECT_NE(now(other).assigned_vehicle, now(ids[0]).assigned_vehicle) << "kept for the sequence";
}

TEST_F(StartConditions, TheVehicleOfASequenceTakesNothingElseUntilItIsOver) {
    NewOrder member = to(2);
    member.sequence = "wing";
    const auto first = make(member);
    member.start = false;
    const auto last = make(member);
    world.run(60);
    const std::string kept = now(first).assigned_vehicle.str();
    const auto other = make(to(3, kept));
    world.run(20);

    EXPECT_EQ(now(other).state, JobState::kAllowedToStart);
    EXPECT_EQ(now(other).reason.code, "vehicle_kept");

    ASSERT_TRUE(world.fleet->control_order(last, asks(JobMethod::kCancel), world.now));
    world.run(60);
    EXPECT_EQ(now(other).state, JobState::kEnded);
}

TEST_F(StartConditions, WhatASequenceWaitsForMayHaveItsVehicle) {
    NewOrder member = to(2);
    member.sequence = "wing";
    const auto first = make(member);
    world.run(3);
    const std::string kept = now(first).assigned_vehicle.str();
    const auto needed = make(to(3, kept));
    member.steps = {{4}};
    member.after = {needed.str()};
    if (kept == "V1") member.steps = {{1}};
    const auto last = make(member);
    world.run(200);

    EXPECT_EQ(now(needed).state, JobState::kEnded) << now(needed).reason.code;
    EXPECT_EQ(now(last).state, JobState::kEnded) << now(last).reason.code;
}

TEST_F(StartConditions, AnAbortedMemberDoesNotEndItsSequence) {
    NewOrder member = to(3);
    member.sequence = "wing";
    const auto first = make(member);
    const auto second = make(member);
    world.run(1);
    ASSERT_TRUE(world.fleet->control_order(first, asks(JobMethod::kAbort), world.now));
    world.run(100);

    EXPECT_EQ(now(first).state, JobState::kAborted);
    EXPECT_EQ(now(second).state, JobState::kEnded);
    EXPECT_EQ(now(second).assigned_vehicle, now(first).assigned_vehicle);
}

TEST_F(StartConditions, ASequenceKeepsItsVehicleOverARestart) {
    NewOrder member = to(3);
    member.sequence = "wing";
    const auto first = make(member);
    member.start = false;
    const auto second = make(member);
    world.run(60);
    ASSERT_EQ(now(first).state, JobState::kEnded);
    const auto vehicle = now(first).assigned_vehicle;
    EXPECT_EQ(now(second).sequence_vehicle, vehicle);

    world.now += std::chrono::hours(24 * 8);
    world.store.orders.erase(first);  // the fleet loads ended orders of the last 7 days only
    crash_and_resume();
    ASSERT_TRUE(world.fleet->control_order(second, asks(JobMethod::kStart), world.now));
    world.run(60);

    EXPECT_EQ(now(second).state, JobState::kEnded);
    EXPECT_EQ(now(second).assigned_vehicle, vehicle);
}

TEST_F(StartConditions, AnotherVehicleForTheSameSequenceIsRefused) {
    NewOrder member = to(2, "V1");
    member.sequence = "wing";
    make(member);
    member.vehicle = kV2;
    expect_refused(member, "sequence_on_other_vehicle", "/vehicle");
}

TEST_F(StartConditions, AllFieldsSurviveARestart) {
    world.announce({"raiseParking"});
    NewOrder first = to(2, "V1");
    first.start = false;
    const auto one = make(first);
    NewOrder order = to(3, "V1");
    order.vehicle_type = plant::VehicleTypeId("small");
    order.earliest_start = world.now + from_seconds(500);
    order.due = world.now + from_seconds(900);
    order.after = {one.str()};
    order.sequence = "wing";
    order.priority = 7;
    order.steps.at(0).before = {{"raiseParking", {{"height_m", 0.1}}}};
    const auto id = make(order);
    const JobOrder before = *world.fleet->order(id);

    world.crash_server();
    const JobOrder after = *world.fleet->order(id);

    EXPECT_EQ(after.wanted_type, before.wanted_type);
    EXPECT_EQ(after.earliest_start, order.earliest_start);
    EXPECT_EQ(after.due, order.due);
    EXPECT_EQ(after.after, before.after);
    EXPECT_EQ(after.sequence, "wing");
    EXPECT_EQ(after.steps.at(0).before, order.steps.at(0).before);
    EXPECT_EQ(after.priority, 7);
}

}  // namespace
}  // namespace pulseline::fleet::testing
