#pragma once

#include "core/plant/plant.hpp"
#include "core/vda5050/messages.hpp"
#include "tests/core/simulation/platform.hpp"

/// A hall with one station, its two codes, and the platform TP-01 that is at home there.
namespace pulseline::agent::testing {

inline plant::Plant small_plant() {
    plant::Plant plant;
    auto type = simulation::testing::platform_type();
    for (const double side : {1.0, -1.0}) {
        plant::Camera camera;
        camera.name = side > 0 ? "front" : "back";
        camera.body_from_camera = {5.346 * side, 0, 0};
        type.cameras.push_back(camera);
        plant::Marker marker;
        marker.id = plant::MarkerId(camera.name);
        marker.payload = side > 0 ? "ST01-F" : "ST01-B";
        marker.hall = plant::HallId("hall");
        marker.pose = {20 + 5.346 * side, 10, 0};
        plant.markers.push_back(marker);
    }
    plant.vehicle_types.push_back(type);
    plant::Station station;
    station.id = plant::StationId("st01");
    station.number = 1;
    station.hall = plant::HallId("hall");
    station.pose = {20, 10, 0};
    plant.stations.push_back(station);
    plant::Vehicle vehicle;
    vehicle.id = plant::VehicleId("TP-01");
    vehicle.type = type.id;
    vehicle.manufacturer = "Tang";
    vehicle.serial_number = "TP-01";
    vehicle.home = station.id;
    plant.vehicles.push_back(vehicle);
    return plant;
}

inline vda5050::StopTarget target_of(const plant::Plant& plant) {
    vda5050::StopTarget target{"st01", 1, plant.stations[0].pose, 0.025, 0.025, 0.0035, {}};
    for (const auto& marker : plant.markers) {
        target.markers.push_back({marker.payload, "qr", marker.size_m, marker.pose, 1e-4, 5e-4});
    }
    return target;
}

}  // namespace pulseline::agent::testing
