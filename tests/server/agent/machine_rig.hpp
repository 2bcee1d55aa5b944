#pragma once

#include <gtest/gtest.h>

#include <string>

#include "server/agent/simulated_controller.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/plant/loads.hpp"
#include "tests/server/agent/small_hall.hpp"

/// The simulated controller of a platform with brackets and feet, in a small hall.
namespace pulseline::agent {

using namespace machine;

inline constexpr double kLoad_kg = 18000;

inline plant::Plant hall() {
    plant::Plant plant = testing::small_plant();
    auto& type = plant.vehicle_types[0];
    const auto whole = pulseline::testing::platform();
    type.kinematics = whole.kinematics;
    type.wheels = whole.wheels;
    type.brackets = whole.brackets;
    type.parking = whole.parking;
    type.scanners = plant::usual_scanners(type.footprint);
    type.mass_kg = whole.mass_kg;
    type.max_load_kg = whole.max_load_kg;
    plant::builders::put_on(plant, 0, "A-101", kLoad_kg);
    return plant;
}

/// Somebody puts a box 7 m ahead of the middle of the vehicle.
inline Fault box_after(double time_s) {
    Fault box;
    box.kind = Fault::Kind::kObstacle;
    box.place = {27, 10};
    box.after_s = time_s;
    return box;
}

class ControllerTest : public ::testing::Test {
protected:
    std::string refusal(const Frame& frame) {
        const auto answers = controller.handle(frame);
        const auto* refused = answers.empty() ? nullptr : std::get_if<Refused>(&answers.back());
        return refused ? refused->why.substr(0, refused->why.find(':')) : "";
    }
    Hello hello() const {
        Hello hello;
        for (const auto& axis : plant::axes_of(type)) {
            hello.axes.push_back({axis.name, axis.position_gain_per_s});
        }
        return hello;
    }
    SetPoints points(Mode mode, double speed_mps = 0) {
        SetPoints points;
        points.cycle = ++cycle;
        points.mode = mode;
        if (mode != Mode::kBraked) points.wheels.assign(type.wheels.size(), {speed_mps, 0});
        return points;
    }
    Feedback feedback(const SetPoints& points) {
        const auto answers = controller.handle(points);
        return std::get<Feedback>(answers.back());
    }

    simulation::World world = simulation::make_world(hall(), 1);
    const plant::VehicleType& type = world.plant.vehicle_types[0];
    SimulatedController controller{
        world, world.plant.vehicles[0], type, {20, 10, 0}, {1, {}, false, {box_after(1)}}};
    std::uint32_t cycle = 0;
};

}  // namespace pulseline::agent
