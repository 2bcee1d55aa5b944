#include <gtest/gtest.h>

#include <random>

#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/journal/snapshot.hpp"
#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::fleet::journal {
namespace {

using testing::World;

constexpr Time kNow = time_from_ns(1'800'000'000'000'000'000);

std::string bytes_of(const Outputs& out) {
    Writer writer;
    writer.put(out);
    return writer.take();
}

plant::Load papers() {
    plant::Load load;
    load.id = plant::LoadId("A-105");
    load.name = "Five";
    load.names = {{"zh", "5"}};
    load.kind = plant::LoadKind::kInstrument;
    load.model = "T";
    load.mass_kg = 20.5;
    load.centre = {0.1, -0.2};
    load.outline = {{0, 0}, {1, 0}, {0, 1}};
    load.vehicle_types = {plant::VehicleTypeId("small")};
    return load;
}

/// Every call of the journal's vocabulary at least once, into a fleet that makes of it what it can.
std::string every_call(Recorder& recorder) {
    World world;
    world.fleet->journal_into(&recorder);
    Fleet& fleet = *world.fleet;
    const plant::VehicleId v1("V1");
    vda5050::StateMessage state;
    state.header_id = 3;
    state.pose = Pose2{1.25, -2, 0.5};
    state.errors = {{"motor", true, "hot", {{"orderId", "x"}}}};
    state.cameras = {{"front", true, "P1", {1, 0}, 0.1, 1e-4, 0.1, ""}};
    NewOrder order;
    order.steps = {{2, plant::MotionMode::kLinear, {{"lowerParking", {{"speed", 0.5}}}}, {}}};
    order.due = kNow + std::chrono::hours(1);
    order.after = {"first"};
    ControlRequest request;
    request.method = JobMethod::kUpdate;
    request.update = order;
    request.if_revision = -5;
    const JobOrderId id(Uuid{{1, 2, 3}});
    fleet.vehicle_connected(v1, kNow);
    fleet.vehicle_heard(v1, kNow);
    fleet.vehicle_state(v1, state, kNow);
    fleet.vehicle_factsheet(v1, {"series", 1, 2, 3, 4, {"a"}, {"b"}, {"c"}, "{}"}, kNow);
    fleet.vehicle_message_refused(v1, state.errors[0], kNow);
    fleet.vehicle_identity_conflict(v1, kNow);
    fleet.vehicle_disconnected(v1, kNow);
    static_cast<void>(fleet.create(order, kNow));
    static_cast<void>(fleet.control_order(id, request, kNow));
    static_cast<void>(fleet.pause_order(id, 7, "person", kNow));
    static_cast<void>(fleet.resume_order(id, std::nullopt, "person", kNow));
    static_cast<void>(fleet.cancel_order(id, std::nullopt, "person", kNow));
    static_cast<void>(fleet.store_template({"t", "d", "{}", "{}", "me", kNow, false}, kNow));
    static_cast<void>(fleet.delete_template("t", "me", kNow));
    static_cast<void>(fleet.create_schedule({"s", {}, order, "me"}, kNow));
    static_cast<void>(fleet.pause_schedule(ScheduleId(Uuid{{9}}), true, 1, "me", kNow));
    static_cast<void>(fleet.delete_schedule(ScheduleId(Uuid{{9}}), 1, "me", kNow));
    static_cast<void>(fleet.pause_vehicle(v1, "me", kNow));
    static_cast<void>(fleet.init_position(v1, {1, 2, 3}, "me", kNow));
    static_cast<void>(fleet.integrate(v1, Integration::kRespect, true, "me", kNow));
    fleet.pause_fleet("me", kNow);
    static_cast<void>(fleet.resume_fleet({v1}, "me", kNow));
    static_cast<void>(fleet.close_floor({"wet", {}, {{0, 0}, {1, 0}, {0, 1}}, {}}, "me", kNow));
    static_cast<void>(fleet.reopen_floor(ClosureId(Uuid{{7}}), "me", kNow));
    fleet.store_failed({"disk_full", kNow}, kNow);
    fleet.store_works_again(kNow);
    fleet.server_stood_still(kNow, kNow);
    fleet.commands_expired({v1}, {id}, kNow);
    fleet.clock_differs(Duration(-7), kNow);
    fleet.clock_agrees(kNow);
    const StepAction up{"setBracketHeight", {{"bracket", "all"}, {"height_m", 0.1}}};
    static_cast<void>(fleet.move_lifts(v1, up, "me", kNow));
    static_cast<void>(fleet.stop_lifts(v1, "me", kNow));
    const LoadPlace there{v1, plant::StationId("s1")};
    static_cast<void>(fleet.place_load(plant::LoadId("A-101"), there, "me", kNow));
    static_cast<void>(fleet.put_load(papers(), "me", kNow));
    static_cast<void>(fleet.retire_load(plant::LoadId("A-105"), "me", kNow));
    planning::LegPlan plan;
    plan.segments.resize(2);
    plan.route = {plant::NodeId("n1")};
    plan.closures = {"wet"};
    fleet.leg_planned(v1, 3, {plan, {"no_free_way", {{"enclosed", true}}}}, kNow);
    fleet.tick(kNow + Duration(5));
    static_cast<void>(fleet.take_outputs(kNow + Duration(6)));
    return recorder.take();
}

TEST(Journal, EveryCallComesBackAsItWas) {
    Recorder recorder;
    const std::string written = every_call(recorder);

    const auto entries = decode(written);

    ASSERT_TRUE(entries);
    ASSERT_EQ(entries->size(), std::variant_size_v<Call>);
    World again;
    Recorder second;
    again.fleet->journal_into(&second);
    for (const auto& entry : *entries) apply(*again.fleet, entry, [](Outputs&&, Time) {});
    EXPECT_EQ(second.take(), written);
}

TEST(Journal, EveryKindOfMotionComesBack) {
    using Kind = kinematics::Segment::Kind;
    for (const Kind kind : {Kind::kRotate, Kind::kStraight, Kind::kArc, Kind::kCombined}) {
        vda5050::OrderEdge edge;
        edge.edge_id = "e1";
        edge.segment.kind = kind;
        edge.segment.length_m = 2.5;
        edge.corridor = plant::Corridor{1.5, 2};
        Writer writer;
        writer.put(edge);
        const std::string bytes = writer.take();
        Reader reader(bytes);
        vda5050::OrderEdge read;
        reader.get(read);
        EXPECT_TRUE(reader.ok() && reader.at_end()) << reader.why();
        EXPECT_EQ(read.segment, edge.segment);
        EXPECT_EQ(read.corridor, edge.corridor);
    }
}

TEST(Journal, RunsOfTicksTakeAFewBytes) {
    World world;
    Recorder recorder;
    world.fleet->journal_into(&recorder);
    for (int i = 0; i < 36'000; ++i) {
        const Time at = kNow + i * kTickEvery;
        world.fleet->tick(at);
        static_cast<void>(world.fleet->take_outputs(at));
    }

    const std::string written = recorder.take();
    const auto entries = decode(written);

    EXPECT_LT(written.size(), 20u);
    ASSERT_TRUE(entries);
    ASSERT_EQ(entries->size(), 1u);
    EXPECT_EQ(std::get<TickRun>(entries->front()).count, 36'000u);
}

TEST(Journal, TicksThatAreNoRunAreKeptOneByOne) {
    World world;
    Recorder recorder;
    world.fleet->journal_into(&recorder);
    world.fleet->tick(kNow);
    static_cast<void>(world.fleet->take_outputs(kNow));
    world.fleet->tick(kNow + 3 * kTickEvery);  // the thread was busy
    static_cast<void>(world.fleet->take_outputs(kNow + 3 * kTickEvery));
    world.fleet->tick(kNow + 4 * kTickEvery);
    static_cast<void>(world.fleet->take_outputs(kNow + 5 * kTickEvery));  // at another time

    const auto entries = decode(recorder.take());

    ASSERT_TRUE(entries);
    ASSERT_EQ(entries->size(), 4u);
    EXPECT_EQ(std::get<TickRun>((*entries)[0]).first, kNow);
    EXPECT_EQ(std::get<TickRun>((*entries)[1]).first, kNow + 3 * kTickEvery);
    EXPECT_STREQ(name_of(std::get<Input>((*entries)[2]).call), "tick");
    EXPECT_STREQ(name_of(std::get<Input>((*entries)[3]).call), "take_outputs");
}

TEST(Journal, EveryTruncationIsRefusedOrEndsBetweenCalls) {
    Recorder recorder;
    const std::string written = every_call(recorder);
    const std::size_t all = decode(written)->size();
    std::size_t good = 0;
    for (std::size_t size = 0; size < written.size(); ++size) {
        const auto entries = decode(std::string_view(written).substr(0, size));
        if (!entries) {
            EXPECT_EQ(entries.error().reason.code, "journal_broken");
            continue;
        }
        ++good;
        EXPECT_LT(entries->size(), all);
    }
    EXPECT_EQ(good, all);
}

TEST(Journal, HostileBytesAreRefusedWithoutHarm) {
    Recorder recorder;
    const std::string written = every_call(recorder);
    std::mt19937_64 random(3);
    int refused = 0;
    constexpr int kRounds = 20'000;
    for (int round = 0; round < kRounds; ++round) {
        std::string bytes = written;
        for (std::uint64_t changes = 1 + random() % 4; changes > 0; --changes) {
            bytes[random() % bytes.size()] = static_cast<char>(random());
        }
        if (round % 3 == 0) bytes.erase(random() % bytes.size(), 1 + random() % 40);
        if (round % 5 == 0) bytes.insert(random() % bytes.size(), 9, static_cast<char>(0xff));
        if (!decode(bytes)) ++refused;
    }
    EXPECT_GT(refused, kRounds / 10);
}

TEST(Journal, LengthsThatLieAskForNoMemory) {
    Writer writer;
    writer.byte(static_cast<std::uint8_t>(number_of<&Fleet::vehicle_heard>()));
    writer.difference(1);
    writer.number(std::uint64_t{1} << 62);  // of the vehicle's name

    EXPECT_FALSE(decode(writer.bytes()));
}

TEST(Seal, RefusesEveryChangedByte) {
    const std::string bytes = sealed("the state of a fleet");
    ASSERT_EQ(*unsealed(bytes), "the state of a fleet");
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::string changed = bytes;
        changed[i] = static_cast<char>(changed[i] ^ 0x10);
        EXPECT_FALSE(unsealed(changed)) << "byte " << i;
        EXPECT_FALSE(unsealed(std::string_view(bytes).substr(0, i)));
    }
}

/// In the midst of its work.
struct BusyWorld : World {
    BusyWorld() {
        connect_all();
        run(1);
        EXPECT_TRUE(order("V1", {2, 3}));
        EXPECT_TRUE(order("V2", {3}));
        run(3);
    }
};

TEST(Snapshot, OfARestoredFleetIsTheSame) {
    const BusyWorld world;
    const std::string bytes = world.fleet->snapshot();

    const auto restored = Fleet::from_snapshot(world.plant, bytes);

    ASSERT_TRUE(restored);
    EXPECT_EQ((*restored)->snapshot(), bytes);
}

TEST(Snapshot, TheRestoredFleetGoesOnAsTheFirstOneDoes) {
    BusyWorld world;
    const auto restored = Fleet::from_snapshot(world.plant, world.fleet->snapshot());
    ASSERT_TRUE(restored);
    Recorder recorder;
    world.fleet->journal_into(&recorder);
    world.run(60);
    world.fleet->journal_into(nullptr);
    const Outputs rest = world.fleet->take_outputs(world.now);

    const auto entries = decode(recorder.take());
    ASSERT_TRUE(entries);
    std::size_t events = 0;
    for (const auto& entry : *entries) {
        apply(**restored, entry, [&](Outputs&& out, Time) { events += out.records.events.size(); });
    }
    EXPECT_GT(events, 10u);
    EXPECT_EQ(bytes_of((*restored)->take_outputs(world.now)), bytes_of(rest));
    EXPECT_EQ((*restored)->snapshot(), world.fleet->snapshot());
}

TEST(Snapshot, OfAnotherPlantIsRefused) {
    const BusyWorld world;
    plant::Plant other = world.plant;
    other.vehicles.pop_back();

    const auto restored = Fleet::from_snapshot(other, world.fleet->snapshot());

    ASSERT_FALSE(restored);
    EXPECT_EQ(restored.error().reason.code, "journal_broken");
}

TEST(Snapshot, EveryTruncationIsRefused) {
    const BusyWorld world;
    const std::string bytes = world.fleet->snapshot();
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 300) {
        EXPECT_FALSE(Fleet::from_snapshot(world.plant, std::string_view(bytes).substr(0, size)))
            << size;
    }
}

TEST(Replay, FailedCallsAreReplayedTooAndChangeNothing) {
    BusyWorld world;
    Recorder recorder;
    world.fleet->journal_into(&recorder);
    const std::string before = world.fleet->snapshot();

    EXPECT_FALSE(world.fleet->cancel_order(JobOrderId(Uuid{{1}}), std::nullopt, "me", world.now));

    EXPECT_EQ(recorder.inputs(), 1u);
    EXPECT_EQ(world.fleet->snapshot(), before);
}

}  // namespace
}  // namespace pulseline::fleet::journal
