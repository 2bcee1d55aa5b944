// Vehicles with a navigation scanner: what they are told of the reflectors, and what the fleet
// makes of what they see.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");

/// The small plant without a code or a camera, with reflectors.
plant::Plant reflecting_plant() {
    plant::Plant plant = small_plant();
    plant.markers.clear();
    for (auto& station : plant.stations) station.markers.clear();
    for (auto& type : plant.vehicle_types) {
        type.cameras.clear();
        type.navigation_scanner = plant::NavigationScanner{};
    }
    for (const geometry::Point2 at :
         {geometry::Point2{2, 3}, geometry::Point2{31, 4.5}, geometry::Point2{37, 21},
          geometry::Point2{24, 33}, geometry::Point2{9, 29.5}, geometry::Point2{1.5, 17}}) {
        plant::Reflector one;
        one.id = plant::ReflectorId("r" + std::to_string(plant.reflectors.size() + 1));
        one.hall = plant::HallId("h1");
        one.position = at;
        plant.reflectors.push_back(one);
    }
    plant::Reflector other = plant.reflectors.front();
    other.id = plant::ReflectorId("r9");
    other.hall = plant::HallId("elsewhere");
    plant.reflectors.push_back(other);
    return plant;
}

std::vector<vda5050::ReflectorSight> seen_from(const World& world, const Pose2& pose) {
    std::vector<vda5050::ReflectorSight> sights;
    for (const auto& one : world.plant.reflectors) {
        if (one.hall.str() == "h1") sights.push_back({inverse(pose) * one.position, 0.003});
    }
    return sights;
}

VehicleView view(World& world) { return *world.fleet->vehicle(kV1, world.now); }

TEST(Reflectors, AVehicleThatAnnouncesItIsToldThoseOfItsHallEachTimeItConnects) {
    World world(reflecting_plant());
    world.connect_all();
    EXPECT_TRUE(world.vehicle("V1").reflectors.empty()) << "it has not announced it";
    for (int i = 0; i < 2; ++i) {
        world.vehicle("V1").reflectors.clear();
        world.announce({"setReflectors"});
        world.run(2);
        ASSERT_EQ(world.vehicle("V1").reflectors.size(), 6u);
        EXPECT_EQ(world.vehicle("V1").reflectors[5].id.str(), "r6");
    }
}

TEST(Reflectors, TellAVehicleWhereItStands) {
    World world(reflecting_plant());
    auto& vehicle = world.vehicle("V1");
    vehicle.sees_codes = false;
    vehicle.state.position_initialized = false;
    vehicle.state.pose.reset();
    const Pose2 stands{12.02, 20.01, 0.004};
    vehicle.state.reflectors = seen_from(world, stands);
    vehicle.state.reflectors.resize(3);
    world.connect_all();
    world.run(3);
    EXPECT_FALSE(view(world).pose_known) << "three may be three others";

    vehicle.state.reflectors = seen_from(world, stands);
    world.run(3);
    ASSERT_TRUE(view(world).pose_known);
    EXPECT_EQ(view(world).pose_basis->kind, PoseBasis::Kind::kReflectors);
    ASSERT_TRUE(vehicle.state.pose);
    EXPECT_LT(geometry::distance(vehicle.state.pose->position(), stands.position()), 1e-6);
}

/// Looking through a whole hall takes long: whoever talks fast has it done no more often.
TEST(Reflectors, AreLookedForInTheWholeHallOnceASecond) {
    World world(reflecting_plant());
    auto& vehicle = world.vehicle("V1");
    vehicle.sees_codes = false;
    vehicle.state.position_initialized = false;
    vehicle.state.pose.reset();
    world.connect_all();
    world.run(std::ceil(seconds(world.now.time_since_epoch())) -
              seconds(world.now.time_since_epoch()) + 1.2);

    vehicle.state.reflectors = seen_from(world, {12.02, 20.01, 0.004});
    world.run(0.6);
    EXPECT_FALSE(view(world).pose_known) << "of this second it has told before";
    world.run(0.6);
    EXPECT_TRUE(view(world).pose_known);
}

TEST(Reflectors, ThatCannotBeTrueTellNothing) {
    const Pose2 stands{12.02, 20.01, 0};
    const auto told = [&](const std::function<void(std::vector<vda5050::ReflectorSight>&)>& spoil) {
        World world(reflecting_plant());
        auto& vehicle = world.vehicle("V1");
        vehicle.state.position_initialized = false;
        vehicle.state.pose.reset();
        vehicle.state.reflectors = seen_from(world, stands);
        spoil(vehicle.state.reflectors);
        world.connect_all();
        world.run(3);
        return view(world).pose_known;
    };
    EXPECT_TRUE(told([](auto&) {}));
    EXPECT_FALSE(told([](auto& all) {
        for (auto& one : all) one.place.x_m *= 1.1;
    })) << "another hall";
    EXPECT_FALSE(told([](auto& all) {
        for (auto& one : all) one = all[0];
    })) << "one of them again and again";
    EXPECT_FALSE(told([](auto& all) {
        for (auto& one : all) one.place.x_m = std::nan("");
    }));
    EXPECT_TRUE(told([](auto& all) { all[2].place.x_m = std::nan(""); })) << "five are left";
}

}  // namespace
}  // namespace pulseline::fleet::testing
