// Vehicles with receivers of iGPS: what they are told of the transmitters, and what the fleet makes
// of what they see.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");

plant::Transmitter transmitter(const char* id, const char* hall) {
    plant::Transmitter one;
    one.id = plant::TransmitterId(id);
    one.hall = plant::HallId(hall);
    return one;
}

/// The small plant without a code or a camera, in the light of two transmitters.
plant::Plant lit_plant() {
    plant::Plant plant = small_plant();
    plant.markers.clear();
    for (auto& station : plant.stations) station.markers.clear();
    for (auto& type : plant.vehicle_types) {
        type.cameras.clear();
        type.receivers = {{"front", {1.4, 0}, 0.6}, {"rear", {-1.4, 0}, 0.6}};
    }
    plant.transmitters = {transmitter("tx-1", "h1"), transmitter("tx-2", "h1"),
                          transmitter("tx-9", "elsewhere")};
    return plant;
}

std::vector<std::string> known_to(const FakeVehicle& vehicle) {
    std::vector<std::string> ids;
    for (const auto& one : vehicle.transmitters) ids.push_back(one.id.str());
    return ids;
}

vda5050::ReceiverReading seen(const World& world, const char* receiver, const Pose2& pose) {
    const auto& type = world.plant.vehicle_types.front();
    const auto known = std::ranges::find(type.receivers, receiver, &plant::Receiver::name);
    vda5050::ReceiverReading reading;
    reading.receiver = receiver;
    reading.found = true;
    reading.place = pose * known->position;
    reading.z_m = known->z_m;
    reading.sigma_m = 1e-4;
    reading.transmitters = {"tx-1", "tx-2"};
    return reading;
}

VehicleView view(World& world) { return *world.fleet->vehicle(kV1, world.now); }

TEST(Igps, AVehicleThatAnnouncesItIsToldTheTransmittersOfItsHallEachTimeItConnects) {
    World world(lit_plant());
    world.connect_all();
    EXPECT_TRUE(world.vehicle("V1").transmitters.empty()) << "it has not announced it";
    world.announce({"setTransmitters"});
    world.run(2);
    const std::vector<std::string> both{"tx-1", "tx-2"};
    EXPECT_EQ(known_to(world.vehicle("V1")), both);

    world.vehicle("V1").transmitters.clear();
    world.announce({"setTransmitters"});
    world.run(2);
    EXPECT_EQ(known_to(world.vehicle("V1")), both);
}

TEST(Igps, ItIsToldThemAlsoWhenTheServerDiesInBetween) {
    World world(lit_plant());
    world.connect_all();
    world.crash_server();
    world.announce({"setTransmitters"});
    world.run(2);
    EXPECT_EQ(known_to(world.vehicle("V1")).size(), 2U);
}

TEST(Igps, ReceiversTellAVehicleWhereItStands) {
    World world(lit_plant());
    auto& vehicle = world.vehicle("V1");
    vehicle.sees_codes = false;
    vehicle.state.position_initialized = false;
    vehicle.state.pose.reset();
    const Pose2 stands{12.02, 20.01, 0.004};
    vehicle.state.receivers = {seen(world, "front", stands)};
    world.connect_all();
    world.run(3);
    EXPECT_FALSE(view(world).pose_known) << "one receiver tells no direction";

    vehicle.state.receivers.push_back(seen(world, "rear", stands));
    world.run(3);
    ASSERT_TRUE(view(world).pose_known);
    EXPECT_EQ(view(world).pose_basis->kind, PoseBasis::Kind::kReceivers);
    ASSERT_TRUE(vehicle.state.pose);
    EXPECT_LT(geometry::distance(vehicle.state.pose->position(), stands.position()), 1e-9);
    EXPECT_NEAR(vehicle.state.pose->heading_rad, stands.heading_rad, 1e-9);
}

TEST(Igps, ReceiversThatCannotBeTrueTellNothing) {
    const Pose2 stands{12.02, 20.01, 0};
    const auto told =
        [&](const std::function<void(std::vector<vda5050::ReceiverReading>&)>& spoil) {
            World world(lit_plant());
            auto& vehicle = world.vehicle("V1");
            vehicle.state.position_initialized = false;
            vehicle.state.pose.reset();
            vehicle.state.receivers = {seen(world, "front", stands), seen(world, "rear", stands)};
            spoil(vehicle.state.receivers);
            world.connect_all();
            world.run(3);
            return view(world).pose_known;
        };
    EXPECT_TRUE(told([](auto&) {}));
    EXPECT_FALSE(told([](auto& all) { all[0].place.x_m += 0.05; }))
        << "farther apart than they sit";
    EXPECT_FALSE(told([](auto& all) { all[0].receiver = "elsewhere"; }));
    EXPECT_FALSE(told([](auto& all) { all[1] = all[0]; })) << "the same one twice";
    EXPECT_FALSE(told([](auto& all) { all[1].found = false; }));
    EXPECT_FALSE(told([](auto& all) {
        for (auto& one : all) one.place.x_m += 500;
    })) << "outside the walls";
    EXPECT_FALSE(told([](auto& all) { all[0].place.x_m = std::nan(""); }));
}

TEST(Igps, WhoStandsNearlyThereIsCorrectedWithoutADrive) {
    World world(lit_plant());
    auto& vehicle = world.vehicle("V1");
    vehicle.state.position_initialized = true;
    vehicle.state.pose = Pose2{12.03, 20.02, 0.002};
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {1}));
    world.run(1);
    ASSERT_EQ(vehicle.order().nodes.size(), 1U);
    EXPECT_EQ(vehicle.order().nodes.front().actions.size(), 2U);
}

TEST(Igps, AStopWithoutCodesIsMeasured) {
    World world(lit_plant());
    for (auto& [id, vehicle] : world.vehicles) {
        vehicle.state.position_initialized = true;
    }
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
    ASSERT_EQ(world.store.stops.size(), 1U);
    EXPECT_TRUE(world.store.stops.back().inside);
}

}  // namespace
}  // namespace pulseline::fleet::testing
