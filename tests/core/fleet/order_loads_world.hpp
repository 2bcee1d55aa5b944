#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "tests/core/fleet/load_world.hpp"

/// A hall with two loads, and vehicles that take them over and set them down by orders.
namespace pulseline::fleet::testing {

inline const plant::StationId kS3("s3");
class OrderLoads : public ::testing::Test {
protected:
    OrderLoads() : OrderLoads(with_two_loads()) {}
    explicit OrderLoads(plant::Plant plant) : world(std::move(plant)) {
        world.connect_all();
        world.announce(
            {"setBracketHeight", "raiseParking", "lowerParking", "stopLifts", "pick", "drop"});
        for (auto& [id, vehicle] : world.vehicles) {
            weigh(vehicle, world.plant, 0, 0.1);
            vehicle.on_action = [this, &vehicle = vehicle](const std::string& type) {
                if (type == "pick") weigh(vehicle, world.plant, kMass_kg, 0.15);
                if (type == "drop") weigh(vehicle, world.plant, 0, 0.1);
            };
        }
        world.run(1);
    }

    FakeVehicle& v1() { return world.vehicle("V1"); }
    /// Takes it over at station 1 and sets it down at station 3.
    static NewOrder brings() {
        NewOrder order;
        order.vehicle = kV1;
        order.steps = {{3}};
        order.steps[0].before = {kPick};
        order.steps[0].after = {kDrop};
        return order;
    }
    JobOrder ordered(const NewOrder& order) {
        const auto made = world.order(order);
        EXPECT_TRUE(made) << made.error().what;
        return made ? made->order : JobOrder{};
    }
    std::string refused(const NewOrder& order, const std::string& field) {
        const auto made = world.order(order);
        if (made) return "";
        EXPECT_EQ(made.error().field, field);
        const Preview preview = world.fleet->preview(order, world.now);
        EXPECT_FALSE(preview.accepted) << "and Send says so before";
        return made.error().reason.code;
    }
    LoadRecord jig() const { return world.fleet->load(kJig)->place; }
    std::vector<Event> moves() const {
        std::vector<Event> moves;
        std::ranges::copy_if(world.store.events, std::back_inserter(moves),
                             [](const Event& event) { return event.type == "load.moved"; });
        return moves;
    }

    World world;
};

}  // namespace pulseline::fleet::testing
