#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/core/fleet/fleet_world.hpp"

// What a vehicle says of where it stands and cannot be true changes nothing, until a person has
// looked.
namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");
const plant::VehicleId kV2("V2");
// Stations 1 to 4 stand at 12, 24, 36 and 48 m; V1 at the first, V2 at the last one.
const Pose2 kElsewhere{21, 20, 0};
const Pose2 kAside{12, 29, 0};

const plant::StationId kFirst("s1");

void claim(World& world, const Pose2& pose) {
    world.vehicle("V1").state.pose = pose;
    world.run(1);
}

VehicleView view(World& world) { return *world.fleet->vehicle(kV1, world.now); }

const Event* newest(World& world, const std::string& type) {
    const Event* found = nullptr;
    for (const auto& event : world.store.events) {
        if (event.type == type) found = &event;
    }
    return found;
}

double number(const Event& event, const std::string& name) {
    for (const auto& param : event.params) {
        const auto* value = std::get_if<double>(&param.value);
        if (param.name == name && value) return *value;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// But for rounding: it was told its pose from the codes below it.
bool is_at(const std::optional<Pose2>& pose, const Pose2& there) {
    return pose && geometry::distance(pose->position(), there.position()) < 1e-6 &&
           std::abs(pose->heading_rad - there.heading_rad) < 1e-6;
}

/// V1 drives to station 3 and has passed no more than the first node of its base.
void drive_on_first_edge(World& world) {
    world.connect_all();
    world.vehicles_move = false;
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(1);
    ASSERT_GT(world.store.vehicles.at(kV1).leg_data.released_nodes, 1u);
    world.vehicle("V1").state.driving = true;
    world.vehicle("V1").state.pose->x_m += 0.5;
    world.run(1);
    ASSERT_FALSE(view(world).claimed_pose);
}

TEST(ImpossiblePose, OfAStandingVehicleFreesNothingAndAsksAPerson) {
    World world;
    world.connect_all();
    claim(world, kAside);  // one state from 9 m away

    EXPECT_EQ(view(world).at_station, kFirst) << "it may still be there";
    EXPECT_TRUE(view(world).needs_resume);
    EXPECT_EQ(view(world).needs_resume_reason.code, "pose_jumped");
    EXPECT_TRUE(is_at(view(world).pose, {12, 20, 0}));
    EXPECT_EQ(view(world).claimed_pose, kAside);
    const Event* event = newest(world, "vehicle.pose_jumped");
    ASSERT_TRUE(event);
    EXPECT_EQ(world.count_events("vehicle.pose_jumped"), 1) << "told once";
    EXPECT_NEAR(number(*event, "distance_m"), 9, 1e-9);
    EXPECT_NEAR(number(*event, "known_y_m"), 20, 1e-9);
    EXPECT_NEAR(number(*event, "y_m"), 29, 1e-9);

    ASSERT_TRUE(world.order("V2", {1}));
    world.run(120);
    const JobOrder order = world.only_order();
    EXPECT_EQ(order.state, JobState::kRunning);
    EXPECT_EQ(order.reason.code, "floor_held");
    EXPECT_NE(std::find(order.reason.params.begin(), order.reason.params.end(),
                        Param{"vehicle", std::string("V1")}),
              order.reason.params.end());
    EXPECT_GT(world.vehicle("V2").state.pose->x_m, 14) << "it drove onto it";
}

TEST(ImpossiblePose, IsNotMadePossibleByTheSpeedOfItsOwnJump) {
    World world;
    world.connect_all();
    world.vehicles_move = false;
    world.vehicle("V1").state.velocity_mps = 9;  // as a position that is differentiated says
    claim(world, kAside);

    EXPECT_TRUE(view(world).claimed_pose);
    EXPECT_EQ(view(world).at_station, kFirst);
    EXPECT_TRUE(view(world).needs_resume);
}

TEST(ImpossiblePose, HoldsTheFloorThatItClaimsToo) {
    World world;
    world.connect_all();
    claim(world, {36, 20, 0});  // at station 3
    ASSERT_TRUE(world.order("V2", {3}));
    world.run(60);
    EXPECT_EQ(world.only_order().reason.code, "floor_held");
    EXPECT_NEAR(world.vehicle("V2").state.pose->x_m, 48, 1e-6);
}

TEST(ImpossiblePose, GetsNoOrderOfItsOwn) {
    World world;
    world.connect_all();
    claim(world, kAside);
    const int before = world.vehicle("V1").orders_received;
    static_cast<void>(world.order("V1", {2}));
    world.run(30);
    EXPECT_EQ(world.vehicle("V1").orders_received, before);
}

TEST(ImpossiblePose, IsNotBelievedByAResume) {
    World world;
    world.connect_all();
    claim(world, kAside);
    const auto refused = world.fleet->resume_fleet({kV1}, "op", world.now);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "pose_in_doubt");
    world.run(1);
    EXPECT_EQ(view(world).at_station, kFirst);
}

TEST(ImpossiblePose, OfOneReportKeepsBothFloorsUntilAPersonResumes) {
    World world;
    world.connect_all();
    claim(world, {36, 20, 0});
    claim(world, {12, 20, 0});
    EXPECT_TRUE(view(world).claimed_pose) << "nobody has looked yet";
    ASSERT_TRUE(world.order("V2", {3}));
    world.run(10);
    EXPECT_EQ(world.only_order().reason.code, "floor_held");

    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);
    EXPECT_FALSE(view(world).claimed_pose);
    EXPECT_FALSE(view(world).needs_resume);
    EXPECT_EQ(view(world).at_station, kFirst);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(ImpossiblePose, IsSetRightByAPersonWhoSaysThatItStandsWhereItWas) {
    World world;
    world.connect_all();
    claim(world, {36, 20, 0});
    ASSERT_TRUE(world.fleet->init_position(kV1, {12, 20, 0}, "op", world.now));
    world.run(2);
    EXPECT_FALSE(view(world).claimed_pose);
    EXPECT_TRUE(view(world).needs_resume) << "to say where it is lets nothing move";
    ASSERT_TRUE(world.order("V2", {3}));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << "the floor that it claimed is free";
}

TEST(ImpossiblePose, IsTrueWhenAPersonSaysSoAndFreesWhereItWas) {
    World world;
    world.connect_all();
    claim(world, kAside);  // carried there
    ASSERT_TRUE(world.fleet->init_position(kV1, {kAside}, "op", world.now));
    world.run(2);
    EXPECT_FALSE(view(world).claimed_pose);
    EXPECT_EQ(view(world).pose, kAside);
    EXPECT_EQ(view(world).at_station, plant::StationId{});
    ASSERT_TRUE(world.order("V2", {1}));
    world.run(120);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(ImpossiblePose, IsKnownAfterARestartOfTheServerWithBothFloors) {
    World world;
    world.connect_all();
    claim(world, {36, 20, 0});
    world.crash_server();
    world.run(1);
    EXPECT_EQ(view(world).claimed_pose, (Pose2{36, 20, 0}));
    EXPECT_EQ(view(world).at_station, kFirst);
    ASSERT_TRUE(world.order("V2", {3}));
    world.run(30);
    ASSERT_TRUE(world.fleet->resume_fleet({kV2}, "op", world.now));
    world.run(30);
    EXPECT_NEAR(world.vehicle("V2").state.pose->x_m, 48, 1e-6);
}

TEST(ImpossiblePose, AfterBeingOffWaitsForAPersonToo) {
    World world;
    world.connect_all();
    world.fleet->vehicle_disconnected(kV1, world.now);
    world.connected[kV1] = false;
    world.run(120);
    world.vehicle("V1").restart();
    world.vehicle("V1").state.pose = kElsewhere;
    world.vehicle("V1").state.position_initialized = true;
    world.connected[kV1] = true;
    world.fleet->vehicle_connected(kV1, world.now);
    world.run(1);
    EXPECT_EQ(view(world).claimed_pose, kElsewhere);
    EXPECT_EQ(view(world).at_station, kFirst);
}

TEST(ImpossiblePose, OutsideTheHallOrInAnotherHallOrTurnedRound) {
    for (const auto& [pose, hall] :
         {std::pair{Pose2{12, -1, 0}, "h1"}, std::pair{Pose2{12, 20, 0}, "h9"},
          std::pair{Pose2{12, 20, kPi}, "h1"}}) {
        World world;
        world.connect_all();
        world.vehicle("V1").state.map_id = hall;
        claim(world, pose);
        EXPECT_TRUE(view(world).claimed_pose) << pose.y_m << hall << pose.heading_rad;
        EXPECT_EQ(view(world).at_station, kFirst);
    }
}

TEST(ImpossiblePose, ThatIsNotANumberIsNone) {
    World world;
    world.connect_all();
    claim(world, {std::numeric_limits<double>::infinity(), 20, 0});
    EXPECT_FALSE(view(world).pose_known);
    EXPECT_FALSE(view(world).claimed_pose);
    EXPECT_TRUE(is_at(world.store.vehicles.at(kV1).pose, {12, 20, 0}));
}

TEST(ImpossiblePose, WhileDrivingFreesNothingAndEndsTheDrive) {
    World world;
    drive_on_first_edge(world);
    const LegId leg = world.store.vehicles.at(kV1).leg;
    claim(world, kAside);
    EXPECT_TRUE(view(world).claimed_pose);
    EXPECT_EQ(world.store.vehicles.at(kV1).leg, leg) << "its floor is held";
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    EXPECT_EQ(world.only_order().reason.code, "pose_jumped");
    EXPECT_EQ(world.vehicle("V1").state.action_states.back().type, "cancelOrder");

    world.vehicles_move = true;
    ASSERT_TRUE(world.fleet->init_position(kV1, {13, 20, 0}, "op", world.now));
    world.run(2);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(ImpossiblePose, AheadOnItsOwnBaseFartherThanItCanHaveDriven) {
    World world;
    drive_on_first_edge(world);
    claim(world, {15.8, 20, 0});  // on its base, but 3.3 m in a second
    EXPECT_TRUE(view(world).claimed_pose);
    world.run(10);
    EXPECT_FALSE(world.fleet->resume_fleet({kV1}, "op", world.now)) << "it only said it again";
    claim(world, {16.2, 20, 0});  // a wrong code goes along
    EXPECT_FALSE(world.fleet->resume_fleet({kV1}, "op", world.now));
    EXPECT_TRUE(view(world).claimed_pose);
}

TEST(ImpossiblePose, OfOneReportWhileDrivingIsOverWhenItSaysThatItHasGoneOn) {
    World world;
    drive_on_first_edge(world);
    claim(world, kAside);
    world.vehicle("V1").state.driving = false;
    claim(world, {13.5, 20, 0});
    EXPECT_TRUE(view(world).claimed_pose) << "nobody has looked yet";
    world.vehicles_move = true;
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    EXPECT_FALSE(view(world).claimed_pose);
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(ImpossiblePose, BehindTheNodeThatItSaysItHasPassed) {
    World world;
    drive_on_first_edge(world);
    const auto& leg = world.store.vehicles.at(kV1).leg_data;
    world.vehicle("V1").state.last_node_id = leg.nodes[1].node_id;
    world.vehicle("V1").state.last_node_sequence_id = leg.nodes[1].sequence_id;
    world.run(1);
    EXPECT_TRUE(view(world).claimed_pose);
    EXPECT_EQ(world.store.vehicles.at(kV1).leg_data.passed_nodes, 1u)
        << "the floor behind that node is where it stands";
}

TEST(PossiblePose, OfAPushByHandIsFollowed) {
    World world;
    world.connect_all();
    for (int i = 0; i < 4; ++i) {
        Pose2 pose = *world.vehicle("V1").state.pose;
        pose.y_m += 0.2;
        pose.heading_rad += radians(3);
        claim(world, pose);
    }
    EXPECT_FALSE(view(world).claimed_pose);
    EXPECT_NEAR(view(world).pose->y_m, 20.8, 1e-9);
    EXPECT_EQ(view(world).at_station, plant::StationId{});
}

TEST(PossiblePose, OfADriveByHandIsFollowedAsFastAsItDrives) {
    World world;
    world.connect_all();
    FakeVehicle& vehicle = world.vehicle("V1");
    vehicle.state.operating_mode = "MANUAL";
    world.run(1);
    for (int i = 0; i < 20; ++i) {
        vehicle.state.pose->y_m += 0.5;
        world.run(0.5);
    }
    EXPECT_FALSE(view(world).claimed_pose);
    EXPECT_NEAR(view(world).pose->y_m, 30, 1e-9);

    vehicle.state.pose->y_m -= 9;
    world.run(0.1);
    EXPECT_TRUE(view(world).claimed_pose) << "nobody drives 9 m in a tenth of a second";
}

TEST(PossiblePose, OfReportsThatComeAtOnceAfterAStall) {
    World world;
    world.connect_all();
    FakeVehicle& vehicle = world.vehicle("V1");
    vehicle.state.operating_mode = "MANUAL";
    world.run(1);
    world.now += std::chrono::seconds(8);
    for (int i = 0; i < 8; ++i) {
        vehicle.state.pose->y_m += 1;
        world.fleet->vehicle_state(kV1, vehicle.state, world.now);
    }
    world.run(2);
    EXPECT_FALSE(view(world).claimed_pose);
}

TEST(PossiblePose, OfAReportInTimeBehindOneThatCameLate) {
    World world;
    drive_on_first_edge(world);
    vda5050::StateMessage& state = world.vehicle("V1").state;
    const double top_mps = world.plant.vehicle_types.front().max_speed_mps;
    const double from_x_m = state.pose->x_m;
    const Time start = world.now;
    for (const auto& [told_s, came_s] : {std::pair{0.4, 0.4}, {1.0, 1.45}, {2.5, 2.5}}) {
        state.pose->x_m = from_x_m + top_mps * told_s;
        world.now = start + from_seconds(came_s);
        world.fleet->vehicle_state(kV1, state, world.now);
        EXPECT_FALSE(view(world).claimed_pose) << told_s;
    }
}

/// A stop measured so far beside the station; its own pose follows when `its_pose_too`.
void measure(World& world, const Pose2& off, bool its_pose_too = true) {
    world.connect_all();
    world.vehicle("V1").stop_error = off;
    world.vehicle("V1").pose_follows_stop = its_pose_too;
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
}

TEST(ImpossibleStop, IsRefusedAndNotStored) {
    for (const Pose2& off : {Pose2{1.7e308, 0, 0}, Pose2{1.2, 0, 0}, Pose2{0, -30, 0},
                             Pose2{0, 0, kPi}, Pose2{std::nan(""), 0, 0}}) {
        World world;
        measure(world, off, false);
        EXPECT_TRUE(world.store.stops.empty()) << off.x_m << " " << off.heading_rad;
        EXPECT_EQ(world.only_order().reason.code, "stop_not_measured");
        EXPECT_NE(world.store.vehicles.at(kV1).last_stop_station, plant::StationId("s2"));
    }
}

TEST(ImpossibleStop, ThatItsOwnPoseContradictsIsRefused) {
    World world;
    measure(world, {0.8, 0, 0}, false);
    EXPECT_TRUE(world.store.stops.empty());
    EXPECT_EQ(world.only_order().reason.code, "stop_not_measured");
}

TEST(ImpossibleStop, ThatItsPoseFollowsIsAJump) {
    World world;
    measure(world, {9, 0, 0});
    EXPECT_TRUE(world.store.stops.empty());
    EXPECT_EQ(world.only_order().reason.code, "pose_jumped");
}

TEST(PossibleStop, IsKeptWithItsHeadingWrapped) {
    World world;
    measure(world, {0.003, 0, 2 * kPi + 0.001});
    ASSERT_EQ(world.store.stops.size(), 1u);
    EXPECT_NEAR(world.store.stops[0].measured.heading_rad, 0.001, 1e-9);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
}

}  // namespace
}  // namespace pulseline::fleet::testing
