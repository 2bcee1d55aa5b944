#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "core/fleet/state/order_book.hpp"
#include "tests/core/fleet/fleet_world.hpp"

/// The 11 methods over the real fleet: every state x method pair of the table, each of the 13
/// transitions, and what a method does to a vehicle that drives.
namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");

ControlRequest asks(JobMethod method) {
    ControlRequest request;
    request.method = method;
    request.actor = "mes";
    return request;
}

NewOrder to_station(int number) {
    NewOrder order;
    order.vehicle = kV1;
    order.steps = {{number}};
    return order;
}

/// An order in a state, reached as it is in life.
JobOrderId order_in(World& world, JobState state) {
    NewOrder order = to_station(3);
    order.start = state != JobState::kNotAllowedToStart;
    if (state == JobState::kAllowedToStart) order.earliest_start = world.now + from_seconds(3600);
    const JobOrderId id = world.order(order)->order.id;
    if (state == JobState::kRunning) world.run(1.5);
    if (state == JobState::kInterrupted) {
        world.run(1.5);
        EXPECT_TRUE(world.fleet->control_order(id, asks(JobMethod::kPause), world.now));
        world.run(0.5);
    }
    if (state == JobState::kEnded) world.run(60);
    if (state == JobState::kAborted) {
        EXPECT_TRUE(world.fleet->control_order(id, asks(JobMethod::kAbort), world.now));
        world.run(3);
    }
    world.settle();
    EXPECT_EQ(world.stored(id).state, state);
    return id;
}

Result<Created> call(World& world, JobOrderId id, JobMethod method) {
    ControlRequest request = asks(method);
    if (method == JobMethod::kUpdate) {
        NewOrder changed = to_station(2);
        const JobOrder& now = world.stored(id);
        changed.earliest_start = now.earliest_start;
        changed.priority = 9;
        request.update = changed;
    }
    auto answer = world.fleet->control_order(id, request, world.now);
    world.settle();
    return answer;
}

struct Pair {
    std::string state, method, outcome;
};

std::vector<Pair> table() {
    std::ifstream file(PULSELINE_JOB_CONTROL_TABLE);
    std::vector<Pair> pairs;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#' || line.starts_with("state,")) continue;
        std::istringstream fields(line);
        Pair pair;
        std::getline(fields, pair.state, ',');
        std::getline(fields, pair.method, ',');
        std::getline(fields, pair.outcome, ',');
        pairs.push_back(pair);
    }
    return pairs;
}

JobState named(const std::string& name) {
    for (const JobState state :
         {JobState::kNotAllowedToStart, JobState::kAllowedToStart, JobState::kRunning,
          JobState::kInterrupted, JobState::kEnded, JobState::kAborted}) {
        if (name == to_string(state)) return state;
    }
    throw std::runtime_error("no state " + name);
}

int transitions(const World& world, JobOrderId id, const char* from, const char* to) {
    int count = 0;
    for (const Event& event : world.store.events) {
        if (event.order != id || event.type != "job_order.state") continue;
        count += event.params.at(0) == Param{"from", std::string(from)} &&
                 event.params.at(1) == Param{"to", std::string(to)};
    }
    return count;
}

class EveryPair : public ::testing::TestWithParam<Pair> {};

TEST_P(EveryPair, DoesWhatTheTableSays) {
    const Pair& pair = GetParam();
    World world;
    world.connect_all();
    const JobOrderId id = order_in(world, named(pair.state));
    const JobOrder before = world.stored(id);

    const auto answer = call(world, id, *job_method(pair.method));
    world.run(5);

    if (pair.outcome == "-") {
        ASSERT_FALSE(answer);
        EXPECT_EQ(answer.error().code, Errc::kConflict);
        EXPECT_EQ(answer.error().reason.code, "not_in_this_state");
        EXPECT_EQ(answer.error().reason.params.at(0), (Param{"state", pair.state}));
        EXPECT_FALSE(world.stored(id).removed);
        if (before.state != JobState::kRunning) {
            EXPECT_EQ(world.stored(id).revision, before.revision) << "an error changes nothing";
        }
        return;
    }
    ASSERT_TRUE(answer) << answer.error().what;
    const JobOrder& after = world.stored(id);
    if (pair.outcome == "removed") {
        EXPECT_TRUE(after.removed);
        EXPECT_TRUE(is_final(after.state));
        const auto left = world.fleet->orders();
        EXPECT_TRUE(left.empty()) << "it stays in the list";
        EXPECT_EQ(world.count_events("job_order.removed"), 1);
    } else {
        if (pair.state == pair.outcome) {
            EXPECT_STREQ(to_string(after.state), pair.outcome.c_str());
        } else {
            EXPECT_EQ(transitions(world, id, pair.state.c_str(), pair.outcome.c_str()), 1);
        }
        EXPECT_FALSE(after.removed);
    }
    if (is_final(after.state)) {
        EXPECT_FALSE(world.store.vehicles.at(kV1).has_leg) << "its floor is free";
        EXPECT_FALSE(world.vehicle("V1").state.driving);
    }
}

INSTANTIATE_TEST_SUITE_P(OpcTable, EveryPair, ::testing::ValuesIn(table()),
                         [](const auto& one) { return one.param.state + "_" + one.param.method; });

TEST(JobMethods, TheTableHas66PairsOfWhich16Succeed) {
    int allowed = 0;
    for (const Pair& pair : table()) allowed += pair.outcome != "-";
    EXPECT_EQ(table().size(), 66u);
    EXPECT_EQ(allowed, 16);
}

// --- the 13 transitions, one test each: what moves an order along ---

struct Transitions : ::testing::Test {
    Transitions() { world.connect_all(); }
    JobOrderId in(JobState state) { return order_in(world, state); }
    void call(JobOrderId id, JobMethod method) {
        ASSERT_TRUE(testing::call(world, id, method));
        world.run(5);
    }
    World world;
};

TEST_F(Transitions, NotAllowedToStartStaysSoWhenUpdated) {
    const auto id = in(JobState::kNotAllowedToStart);
    call(id, JobMethod::kUpdate);
    EXPECT_EQ(world.stored(id).state, JobState::kNotAllowedToStart);
    EXPECT_EQ(world.stored(id).priority, 9);
    EXPECT_EQ(world.stored(id).steps.at(0).station.str(), "s2");
    EXPECT_EQ(world.count_events("job_order.updated"), 1);
}

TEST_F(Transitions, NotAllowedToStartToAllowedToStartByStart) {
    const auto id = in(JobState::kNotAllowedToStart);
    world.run(5);
    EXPECT_EQ(world.stored(id).state, JobState::kNotAllowedToStart) << "it waits for Start";
    call(id, JobMethod::kStart);
    EXPECT_EQ(transitions(world, id, "NotAllowedToStart", "AllowedToStart"), 1);
    EXPECT_EQ(transitions(world, id, "AllowedToStart", "Running"), 1) << "a free vehicle takes it";
}

TEST_F(Transitions, AllowedToStartToNotAllowedToStartByRevokeStart) {
    const auto id = in(JobState::kAllowedToStart);
    call(id, JobMethod::kRevokeStart);
    EXPECT_EQ(transitions(world, id, "AllowedToStart", "NotAllowedToStart"), 1);
    world.run(3700);
    EXPECT_EQ(world.stored(id).state, JobState::kNotAllowedToStart);
}

TEST_F(Transitions, AllowedToStartStaysSoWhenUpdated) {
    const auto id = in(JobState::kAllowedToStart);
    call(id, JobMethod::kUpdate);
    EXPECT_EQ(world.stored(id).state, JobState::kAllowedToStart);
    EXPECT_EQ(world.stored(id).priority, 9);
}

TEST_F(Transitions, AllowedToStartToRunningByDispatch) {
    const auto id = world.order("V1", {2})->order.id;
    EXPECT_EQ(transitions(world, id, "AllowedToStart", "Running"), 1);
}

TEST_F(Transitions, RunningToInterruptedByPauseStopsInsideTheBase) {
    const auto id = in(JobState::kRunning);
    call(id, JobMethod::kPause);
    EXPECT_EQ(transitions(world, id, "Running", "Interrupted"), 1);
    EXPECT_TRUE(world.vehicle("V1").state.paused);
    EXPECT_TRUE(world.store.vehicles.at(kV1).has_leg) << "the leg goes on from there";
    const int steps = world.vehicle("V1").node_steps;
    world.run(20);
    EXPECT_EQ(world.vehicle("V1").node_steps, steps);
}

TEST_F(Transitions, RunningToEndedWhenAllStepsAreDone) {
    const auto id = in(JobState::kRunning);
    world.run(60);
    EXPECT_EQ(transitions(world, id, "Running", "Ended"), 1);
}

TEST_F(Transitions, RunningToAbortedByAbort) {
    const auto id = in(JobState::kRunning);
    call(id, JobMethod::kAbort);
    EXPECT_EQ(transitions(world, id, "Running", "Aborted"), 1);
    EXPECT_EQ(world.stored(id).steps.at(0).state, StepState::kSkipped);
}

TEST_F(Transitions, InterruptedToRunningByResume) {
    const auto id = in(JobState::kInterrupted);
    call(id, JobMethod::kResume);
    EXPECT_EQ(transitions(world, id, "Interrupted", "Running"), 1);
    world.run(60);
    EXPECT_EQ(world.stored(id).state, JobState::kEnded);
}

TEST_F(Transitions, InterruptedToEndedByStop) {
    const auto id = in(JobState::kInterrupted);
    call(id, JobMethod::kStop);
    EXPECT_EQ(transitions(world, id, "Interrupted", "Ended"), 1);
    EXPECT_FALSE(world.vehicle("V1").state.paused) << "the pause does not outlive its order";
}

TEST_F(Transitions, InterruptedToAbortedByAbort) {
    const auto id = in(JobState::kInterrupted);
    call(id, JobMethod::kAbort);
    EXPECT_EQ(transitions(world, id, "Interrupted", "Aborted"), 1);
}

TEST_F(Transitions, NotAllowedToStartToAbortedByAbort) {
    const auto id = in(JobState::kNotAllowedToStart);
    call(id, JobMethod::kAbort);
    EXPECT_EQ(transitions(world, id, "NotAllowedToStart", "Aborted"), 1);
}

TEST_F(Transitions, AllowedToStartToAbortedByAbort) {
    const auto id = in(JobState::kAllowedToStart);
    call(id, JobMethod::kAbort);
    EXPECT_EQ(transitions(world, id, "AllowedToStart", "Aborted"), 1);
}

// --- ending an order whose vehicle drives ---

struct Ending {
    JobMethod method;
    JobState to;
};
class EndsADrivingOrder : public ::testing::TestWithParam<Ending> {};

TEST_P(EndsADrivingOrder, IsAskedConfirmedAndStandingBeforeItIsFinal) {
    World world;
    world.connect_all();
    const JobOrderId id = order_in(world, JobState::kRunning);
    world.connected[kV1] = false;  // its answers do not come
    ASSERT_TRUE(call(world, id, GetParam().method));

    world.run(5);
    EXPECT_EQ(world.stored(id).state, JobState::kRunning) << "not before the vehicle confirmed";
    EXPECT_TRUE(world.stored(id).cancel_requested);
    EXPECT_TRUE(world.store.vehicles.at(kV1).has_leg) << "its floor stays held";
    EXPECT_EQ(
        world.fleet->control_order(id, asks(JobMethod::kPause), world.now).error().reason.code,
        "end_under_way");

    world.connected[kV1] = true;
    world.run(5);
    EXPECT_EQ(world.stored(id).state, GetParam().to);
    EXPECT_FALSE(world.store.vehicles.at(kV1).has_leg);
    EXPECT_FALSE(world.vehicle("V1").state.driving);
    // The vehicle is free for the next one.
    const auto next = world.order("V1", {2});
    ASSERT_TRUE(next);
    world.run(60);
    EXPECT_EQ(world.stored(next->order.id).state, JobState::kEnded);
}

INSTANTIATE_TEST_SUITE_P(Methods, EndsADrivingOrder,
                         ::testing::Values(Ending{JobMethod::kAbort, JobState::kAborted},
                                           Ending{JobMethod::kStop, JobState::kEnded}),
                         [](const auto& one) { return to_string(one.param.method); });

TEST(JobMethods, AnAbortOvertakesAStopAndNotTheOtherWayRound) {
    World world;
    world.connect_all();
    const JobOrderId id = order_in(world, JobState::kRunning);
    world.connected[kV1] = false;
    ASSERT_TRUE(call(world, id, JobMethod::kStop));
    ASSERT_TRUE(call(world, id, JobMethod::kAbort));

    EXPECT_EQ(call(world, id, JobMethod::kStop).error().reason.code, "end_under_way");

    world.connected[kV1] = true;
    world.run(5);
    EXPECT_EQ(world.stored(id).state, JobState::kAborted);
}

TEST(JobMethods, AStopAskedBeforeARestartStillEndsTheOrder) {
    World world;
    world.connect_all();
    const JobOrderId id = order_in(world, JobState::kRunning);
    world.connected[kV1] = false;
    ASSERT_TRUE(call(world, id, JobMethod::kStop));

    world.crash_server();
    world.connected[kV1] = true;
    world.fleet->vehicle_connected(kV1, world.now);
    world.run(2);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1, plant::VehicleId("V2")}, "op", world.now));
    world.run(5);

    EXPECT_EQ(world.stored(id).state, JobState::kEnded);
}

TEST(JobMethods, AnOrderThatThousandsFollowedAnswersAsOnTheFirstDay) {
    World world;
    world.connect_all();
    NewOrder order = to_station(3);
    order.start = false;
    order.client_order_id = "mes-1";
    order.idempotency_client = "mes";
    order.idempotency_key = "k1";
    const auto ends = [&world](const NewOrder& made) {
        const JobOrderId id = world.order(made)->order.id;
        EXPECT_TRUE(world.fleet->cancel_order(id, std::nullopt, "op", world.now));
        return id;
    };
    const JobOrderId first = ends(order);
    NewOrder other = to_station(2);
    other.start = false;
    for (std::size_t i = 0; i < OrderBook::kMostLoose; ++i) ends(other);
    world.run(0.2);

    const auto again = world.fleet->create(order, world.now);
    ASSERT_TRUE(again);
    EXPECT_TRUE(again->repeated);
    EXPECT_EQ(again->order.id, first);
    EXPECT_EQ(again->order.steps.size(), 1u);

    order.idempotency_key.clear();
    EXPECT_EQ(world.order(order).error().reason.code, "duplicate_client_order_id");
    other.after = {"mes-1"};
    EXPECT_EQ(world.order(other).error().reason.code, "dependency_aborted");
    EXPECT_EQ(world.fleet->order(first)->state, JobState::kAborted);
    EXPECT_FALSE(world.fleet->cancel_order(first, std::nullopt, "op", world.now));

    ASSERT_TRUE(call(world, first, JobMethod::kClear));
    EXPECT_TRUE(world.stored(first).removed);
    EXPECT_EQ(world.fleet->orders().size(), 100u);
}

TEST(JobMethods, TheSameKeyGivesTheSameAnswerAndActsOnce) {
    World world;
    world.connect_all();
    const JobOrderId id = order_in(world, JobState::kNotAllowedToStart);
    ControlRequest request = asks(JobMethod::kCancel);
    request.idempotency_client = "mes";
    request.idempotency_key = "k1";
    request.body_sha256 = "abc";

    ASSERT_TRUE(world.fleet->control_order(id, request, world.now));
    world.settle();
    world.crash_server();
    const auto again = world.fleet->control_order(id, request, world.now);
    request.body_sha256 = "def";
    const auto other = world.fleet->control_order(id, request, world.now);

    ASSERT_TRUE(again);
    EXPECT_TRUE(again->repeated);
    EXPECT_TRUE(again->order.removed);
    EXPECT_EQ(world.count_events("job_order.removed"), 1);
    EXPECT_EQ(other.error().reason.code, "idempotency_key_reused");
}

TEST(JobMethods, ARemovedOrderTakesNoMethod) {
    World world;
    world.connect_all();
    const JobOrderId id = order_in(world, JobState::kNotAllowedToStart);
    ASSERT_TRUE(call(world, id, JobMethod::kCancel));

    for (const JobMethod method : {JobMethod::kStart, JobMethod::kClear, JobMethod::kCancel}) {
        EXPECT_EQ(call(world, id, method).error().reason.code, "job_order_removed");
    }
    EXPECT_TRUE(world.stored(id).removed) << "the row stays";
}

}  // namespace
}  // namespace pulseline::fleet::testing
