#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"
#include "tests/core/plant/loads.hpp"

namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");
const plant::VehicleId kV2("V2");

plant::Plant resting_plant(bool loaded = false) {
    plant::Plant plant = small_plant();
    for (auto& station : plant.stations) station.resting_place = true;
    if (loaded) plant::builders::put_on(plant, 0, "A-101");
    return plant;
}

struct IntegrationLevels : ::testing::Test {
    explicit IntegrationLevels(plant::Plant plant = resting_plant()) : world(std::move(plant)) {
        world.connect_all();
    }
    Result<VehicleView> set(const plant::VehicleId& id, Integration level, bool off = false) {
        auto done = world.fleet->integrate(id, level, off, "chief", world.now);
        world.settle();
        return done;
    }
    Result<Created> order_for_anybody(int station) {
        NewOrder order;
        order.steps = {{station}};
        return world.order(std::move(order));
    }
    JobOrder stored(const Result<Created>& made) { return world.stored(made->order.id); }
    VehicleView view(const plant::VehicleId& id) { return *world.fleet->vehicle(id, world.now); }
    World world;
};

struct LoadedVehicle : IntegrationLevels {
    LoadedVehicle() : IntegrationLevels(resting_plant(true)) {}
};

TEST_F(IntegrationLevels, ARespectedVehicleKeepsItsFloorAndGetsNothing) {
    ASSERT_TRUE(set(kV1, Integration::kRespect));
    EXPECT_EQ(view(kV1).reason.value().code, "not_integrated");
    const auto refused = world.order("V1", {2});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "not_integrated");
    EXPECT_EQ(refused.error().field, "/vehicle");

    const auto order = order_for_anybody(1);
    ASSERT_TRUE(order);
    world.run(60);
    EXPECT_EQ(stored(order).assigned_vehicle, kV2);
    EXPECT_EQ(stored(order).state, JobState::kRunning);
    EXPECT_EQ(stored(order).reason.code, "floor_held") << "V1 stands on station 1";
    EXPECT_EQ(world.vehicle("V1").orders_received, 0) << "it is not asked to make way";
}

TEST_F(IntegrationLevels, TheOrderOfAVehicleTakenOutUnderWayIsGivenToAnother) {
    world.vehicles_move = false;
    const auto order = order_for_anybody(2);
    ASSERT_TRUE(order);
    world.run(2);
    ASSERT_EQ(stored(order).assigned_vehicle, kV1);
    ASSERT_TRUE(view(kV1).leg);

    ASSERT_TRUE(set(kV1, Integration::kRespect));
    EXPECT_EQ(stored(order).state, JobState::kInterrupted);
    EXPECT_EQ(stored(order).reason.code, "vehicle_withdrawn");
    EXPECT_EQ(stored(order).assigned_vehicle, kV1) << "until it has confirmed and stands";

    world.vehicles_move = true;
    world.run(90);
    EXPECT_EQ(stored(order).assigned_vehicle, kV2);
    EXPECT_EQ(stored(order).state, JobState::kEnded);
    EXPECT_EQ(world.store.stops.size(), 1u) << "done once";
}

TEST_F(IntegrationLevels, AnOrderForThatVehicleByNameWaitsForIt) {
    const auto order = world.order("V1", {2});
    ASSERT_TRUE(order);
    world.run(2);
    ASSERT_TRUE(set(kV1, Integration::kRespect));
    world.run(20);
    EXPECT_EQ(stored(order).state, JobState::kInterrupted);
    EXPECT_EQ(stored(order).assigned_vehicle, kV1);

    ASSERT_TRUE(set(kV1, Integration::kUtilise));
    world.run(5);
    EXPECT_EQ(stored(order).state, JobState::kInterrupted) << "nothing goes on by itself";
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.settle();
    world.run(60);
    EXPECT_EQ(stored(order).state, JobState::kEnded);
}

TEST_F(LoadedVehicle, KeepsItsOrderBecauseTheLoadIsOnIt) {
    const auto order = order_for_anybody(2);
    ASSERT_TRUE(order);
    world.run(2);
    ASSERT_EQ(stored(order).assigned_vehicle, kV1);
    ASSERT_TRUE(set(kV1, Integration::kRespect));
    world.run(60);
    EXPECT_EQ(stored(order).assigned_vehicle, kV1);
    EXPECT_EQ(stored(order).reason.code, "load_on_withdrawn_vehicle");
}

TEST_F(IntegrationLevels, OffTheFloorIsToBeConfirmedAndFreesIt) {
    const auto unsure = set(kV1, Integration::kNotice);
    ASSERT_FALSE(unsure);
    EXPECT_EQ(unsure.error().reason.code, "off_floor_unconfirmed");
    EXPECT_EQ(unsure.error().field, "/off_floor");
    EXPECT_EQ(view(kV1).integration, Integration::kUtilise);

    ASSERT_TRUE(set(kV1, Integration::kNotice, true));
    const auto order = order_for_anybody(1);
    ASSERT_TRUE(order);
    world.run(90);
    EXPECT_EQ(stored(order).state, JobState::kEnded) << "V2 drives to where V1 was drawn";
    EXPECT_TRUE(view(kV1).at_station.empty());
}

TEST_F(IntegrationLevels, ASilentVehicleTakenOffTheFloorGivesItsOrderAwayAtOnce) {
    const auto order = order_for_anybody(2);
    ASSERT_TRUE(order);
    world.run(2);
    ASSERT_EQ(stored(order).assigned_vehicle, kV1);
    world.connected[kV1] = false;
    world.fleet->vehicle_disconnected(kV1, world.now);
    world.run(20);
    EXPECT_EQ(stored(order).assigned_vehicle, kV1) << "its floor may not be free";

    ASSERT_TRUE(set(kV1, Integration::kIgnore, true));
    world.run(1);
    // A loss is for a person to judge; the order goes on with another only when he says so.
    EXPECT_EQ(stored(order).state, JobState::kInterrupted);
}

TEST_F(IntegrationLevels, AnIgnoredVehicleIsNotListenedTo) {
    ASSERT_TRUE(set(kV1, Integration::kIgnore, true));
    world.vehicle("V1").state.errors.push_back({"motorFault", true, "smoke", {}});
    world.run(5);
    EXPECT_EQ(world.count_events("vehicle.error"), 0);
    EXPECT_EQ(view(kV1).activity, Activity::kUnknown);
    EXPECT_FALSE(view(kV1).pose_known);
}

TEST_F(IntegrationLevels, PutInAgainItHoldsItsFloorAndWaitsForAPerson) {
    ASSERT_TRUE(set(kV1, Integration::kNotice, true));
    world.run(2);
    ASSERT_TRUE(set(kV1, Integration::kUtilise));
    world.run(2);
    EXPECT_EQ(view(kV1).needs_resume_reason.code, "integrated_again");
    EXPECT_EQ(view(kV1).at_station, plant::StationId("s1"));
    const auto order = world.order("V1", {2});
    ASSERT_TRUE(order);
    world.run(10);
    EXPECT_EQ(stored(order).state, JobState::kAllowedToStart);

    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.settle();
    world.run(60);
    EXPECT_EQ(stored(order).state, JobState::kEnded);
}

TEST_F(IntegrationLevels, SurvivesARestart) {
    ASSERT_TRUE(set(kV1, Integration::kNotice, true));
    world.run(1);
    world.crash_server();
    world.run(1);
    EXPECT_EQ(view(kV1).integration, Integration::kNotice);
    ASSERT_TRUE(world.fleet->resume_fleet({kV2}, "op", world.now));
    const auto order = order_for_anybody(1);
    ASSERT_TRUE(order);
    world.run(90);
    EXPECT_EQ(stored(order).state, JobState::kEnded) << "it still holds no floor";
}

TEST_F(IntegrationLevels, AnOrderWithoutAVehicleIsNotResumedByHand) {
    world.vehicles_move = false;
    const auto order = order_for_anybody(2);
    ASSERT_TRUE(order);
    world.run(1);
    ASSERT_TRUE(set(kV2, Integration::kRespect));
    ASSERT_TRUE(set(kV1, Integration::kRespect));
    world.run(5);
    ASSERT_TRUE(stored(order).assigned_vehicle.empty());
    const auto resumed = world.fleet->resume_order(order->order.id, std::nullopt, "op", world.now);
    ASSERT_FALSE(resumed);
    EXPECT_EQ(resumed.error().reason.code, "waits_for_vehicle");

    ASSERT_TRUE(world.fleet->cancel_order(order->order.id, std::nullopt, "op", world.now));
    world.settle();
    EXPECT_EQ(stored(order).state, JobState::kAborted);
}

TEST(ProtectiveField, SomethingInItBarsAStartAndIsSaid) {
    World world(resting_plant());
    world.connect_all();
    FakeVehicle& v1 = world.vehicle("V1");
    v1.state.field_violation = true;
    world.run(1);
    const auto order = world.order("V1", {3});
    ASSERT_TRUE(order);
    world.run(20);
    EXPECT_EQ(v1.orders_received, 0);
    const auto view = world.fleet->vehicle(kV1, world.now);
    EXPECT_EQ(view->activity, Activity::kBlocked);
    EXPECT_EQ(view->reason.value().code, "field_violation");

    v1.state.field_violation = false;
    world.run(60);
    EXPECT_EQ(world.stored(order->order.id).state, JobState::kEnded) << "it goes on by itself";
}

TEST(ManualMode, TakesTheVehicleOutOfTheServersHands) {
    World world(resting_plant());
    world.connect_all();
    const auto order = world.order("V1", {3});
    ASSERT_TRUE(order);
    world.run(2);
    FakeVehicle& v1 = world.vehicle("V1");
    v1.state.operating_mode = "MANUAL";
    world.run(1);
    const int before = v1.orders_received;
    world.run(20);
    EXPECT_EQ(v1.orders_received, before) << "no base is extended";
    EXPECT_EQ(world.stored(order->order.id).state, JobState::kInterrupted);
    EXPECT_EQ(world.stored(order->order.id).reason.code, "driven_by_hand");
    const auto refused = world.fleet->resume_fleet({kV1}, "op", world.now);
    ASSERT_FALSE(refused) << "not while it is in somebody's hands";
    EXPECT_EQ(refused.error().reason.code, "not_automatic");

    v1.restart();  // the hand terminal took its order away
    v1.state.position_initialized = true;
    v1.state.operating_mode = "MANUAL";
    world.run(5);
    EXPECT_EQ(world.stored(order->order.id).state, JobState::kInterrupted);
    v1.state.operating_mode = "AUTOMATIC";
    world.run(10);
    EXPECT_EQ(world.stored(order->order.id).state, JobState::kInterrupted)
        << "nothing moves by itself";
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.settle();
    world.run(60);
    EXPECT_EQ(world.stored(order->order.id).state, JobState::kEnded);
}

TEST(ManualMode, WhoHasItInHandStandsWithTheOrderAndInTheEvents) {
    World world(resting_plant());
    world.connect_all();
    const auto order = world.order("V1", {3});
    ASSERT_TRUE(order);
    world.run(2);
    FakeVehicle& v1 = world.vehicle("V1");
    const auto in_hand = [&](const char* mode, std::optional<std::string> person) {
        v1.state.operating_mode = mode;
        v1.state.in_hand_of = std::move(person);
        world.run(1);
    };
    in_hand("MANUAL", "ann");
    const Params because{{"operating_mode", std::string("MANUAL")}, {"person", std::string("ann")}};
    EXPECT_EQ(world.stored(order->order.id).reason, (Reason{"driven_by_hand", because}));
    in_hand("MANUAL", "bob");
    in_hand("AUTOMATIC", std::nullopt);
    std::vector<std::string> said;
    for (const Event& event : world.store.events) {
        if (event.type != "vehicle.operating_mode") continue;
        std::string words;
        for (const auto& [name, value] : event.params) {
            words += name + " " + std::get<std::string>(value) + " ";
        }
        said.push_back(words);
    }
    EXPECT_EQ(said, (std::vector<std::string>{"from AUTOMATIC to MANUAL person ann ",
                                              "from MANUAL to MANUAL person bob ",
                                              "from MANUAL to AUTOMATIC "}));
}

TEST(ManualMode, GivenBackNothingMovesUntilAPersonSaysSo) {
    World world(resting_plant());
    world.connect_all();
    FakeVehicle& v1 = world.vehicle("V1");
    v1.state.operating_mode = "MANUAL";
    world.run(1);
    v1.state.operating_mode = "AUTOMATIC";
    world.run(1);
    const auto order = world.order("V1", {3});
    ASSERT_TRUE(order);
    world.run(20);
    EXPECT_EQ(v1.orders_received, 0);
    const auto view = world.fleet->vehicle(kV1, world.now);
    EXPECT_TRUE(view->needs_resume);
    EXPECT_EQ(view->needs_resume_reason.code, "driven_by_hand");

    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.settle();
    world.run(60);
    EXPECT_EQ(world.stored(order->order.id).state, JobState::kEnded);
}

TEST(ManualMode, AnUpdateDecidedJustBeforeItIsKnownIsNotSentUntilAPersonSaysSo) {
    World world(resting_plant());
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(2);
    FakeVehicle& v1 = world.vehicle("V1");
    const int released = world.count_events("leg.released");
    const int received = v1.orders_received;

    // Both reports come in one batch, as after a standstill of the server.
    ASSERT_TRUE(v1.step());
    world.fleet->vehicle_state(kV1, v1.state, world.now);
    v1.state.operating_mode = "MANUAL";
    world.fleet->vehicle_state(kV1, v1.state, world.now);
    world.settle();
    ASSERT_GT(world.count_events("leg.released"), released);
    world.run(5);
    v1.state.operating_mode = "AUTOMATIC";
    world.run(5);

    EXPECT_EQ(v1.orders_received, received);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(ManualMode, AnOrderThatDidNotReachItIsNotSentAgainUntilAPersonSaysSo) {
    World world(resting_plant());
    world.connect_all();
    FakeVehicle& v1 = world.vehicle("V1");
    world.connected[kV1] = false;
    ASSERT_TRUE(world.order("V1", {3}));
    ASSERT_TRUE(world.store.vehicles.at(kV1).has_leg);

    world.connected[kV1] = true;
    v1.state.operating_mode = "MANUAL";
    world.run(5);
    v1.state.operating_mode = "AUTOMATIC";
    world.run(5);

    EXPECT_EQ(v1.orders_received, 0);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

}  // namespace
}  // namespace pulseline::fleet::testing
