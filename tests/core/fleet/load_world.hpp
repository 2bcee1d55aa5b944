#pragma once

#include "core/base/gravity.hpp"
#include "tests/core/fleet/fleet_world.hpp"
#include "tests/core/plant/loads.hpp"

/// A hall with one load, two supports, and vehicles with brackets.
namespace pulseline::fleet::testing {

inline const plant::VehicleId kV1("V1");
inline const plant::VehicleId kV2("V2");
inline const plant::LoadId kJig("J-1");
inline const plant::LoadId kOther("J-2");
inline const plant::StationId kS1("s1");
inline const StepAction kPick{"pick", {{"load", std::string("J-1")}}};
inline const StepAction kDrop{"drop", {}};
inline constexpr double kMass_kg = 400;

/// V1 stands empty below J-1, which hangs at station 1; its outline with a load is wider.
inline plant::Plant with_load() {
    plant::Plant plant = small_plant();
    auto& type = plant.vehicle_types.front();
    type.brackets = plant::builders::four_brackets();
    type.wheels = {};
    type.parking = plant::usual_parking(type.footprint);
    type.load_footprint = geometry::rectangle(3.4, 3);
    for (auto& station : plant.stations) {
        if (station.number == 1 || station.number == 3) station.support = plant::Support{};
    }
    plant::builders::put_on(plant, 0, "J-1", kMass_kg);
    plant.loads[0].vehicle = {};
    plant.loads[0].station = kS1;
    plant.loads[0].outline = geometry::rectangle(3, 2.5);
    plant.loads[0].vehicle_types.clear();
    return plant;
}

/// A second load, which is nowhere.
inline plant::Plant with_two_loads() {
    plant::Plant plant = with_load();
    plant.loads.push_back(plant.loads.front());
    plant.loads.back().id = kOther;
    plant.loads.back().name = "J-2";
    plant.loads.back().station = {};  // it comes later
    return plant;
}

/// V2 stands so near beside V1 that a load on that would hang above its floor.
inline plant::Plant with_v2_beside() {
    plant::Plant plant = with_load();
    auto& there = plant.stations[1];
    there.pose.x_m = plant.stations[0].pose.x_m;
    there.pose.y_m = plant.stations[0].pose.y_m + 2.2;
    for (auto& node : plant.nodes) {
        if (node.id == there.node) node.position = there.pose.position();
    }
    plant.vehicles[1].home = there.id;
    return plant;
}

/// What its load cells feel.
inline void weigh(FakeVehicle& vehicle, const plant::Plant& plant, double mass_kg,
                  double height_m) {
    auto& brackets = vehicle.state.brackets;
    brackets.clear();
    for (const auto& bracket : plant.vehicle_types.front().brackets) {
        const double force_n = mass_kg * kGravity_mps2 / 4;
        brackets.push_back({bracket.name, force_n / 2, force_n / 2, height_m});
    }
}

}  // namespace pulseline::fleet::testing
