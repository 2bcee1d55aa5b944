#include "tests/bench/manoeuvre_scene.hpp"

#include <algorithm>
#include <random>

#include "core/planning/room/obstacles.hpp"

namespace pulseline::bench {
namespace {

using geometry::Polygon;
using geometry::Pose2;

/// Some 32 m long with a span of 28 m: fuselage, swept wings, tailplane.
const Polygon kAircraft{{16, 0},     {13, 1.5},  {4, 1.8},  {-4, 14},  {-7, 14},  {-3, 1.8},
                        {-12, 1.2},  {-14, 5},   {-16, 5},  {-15, 0},  {-16, -5}, {-14, -5},
                        {-12, -1.2}, {-3, -1.8}, {-7, -14}, {-4, -14}, {4, -1.8}, {13, -1.5}};

}  // namespace

ManoeuvreScene::ManoeuvreScene() {
    plant::Hall hall;
    hall.id = plant::HallId("hall");
    hall.outline = {{0, 0}, {120, 0}, {120, 60}, {0, 60}};
    plant.halls.push_back(hall);
    int number = 0;
    for (const Pose2& at : {Pose2{40, 34, 0.3}, Pose2{82, 25, -0.5}}) {
        plant::Area area;
        area.id = plant::AreaId("aircraft-" + std::to_string(++number));
        area.kind = plant::AreaKind::kObstacle;
        area.hall = hall.id;
        area.outline = geometry::transformed(at, kAircraft);
        plant.areas.push_back(area);
    }

    plant::VehicleType type;
    type.id = plant::VehicleTypeId("transport-platform");
    type.footprint = geometry::rectangle(10.5, 2.5);
    type.max_speed_mps = 1.67;
    type.max_turn_rate_radps = 0.12;
    type.max_turn_accel_radps2 = 0.04;
    type.min_turn_radius_m = 5;
    type.clearance_m = 0.5;
    type.motion_modes = {plant::MotionMode::kFree};
    plant.vehicle_types.push_back(type);

    const std::vector<Pose2> places{{8, 50, kPi / 2}, {8, 12, kPi / 2}, {62, 50, 0},   {58, 8, 0.2},
                                    {108, 45, -2.3},  {100, 8, kPi},    {60, 27, 1.2}, {24, 6, 0}};
    for (const Pose2& place : places) {
        parked.push_back({plant::VehicleId("P" + std::to_string(parked.size() + 1)),
                          {geometry::transformed(place, type.footprint)}});
    }
}

bool ManoeuvreScene::is_free(const Pose2& pose) const {
    const planning::Obstacles obstacles(plant, hall());
    const Polygon body = geometry::transformed(pose, platform().footprint);
    const double clearance_m = platform().clearance_m;
    return obstacles.keeps({body}, obstacles.limits(clearance_m)) &&
           std::all_of(parked.begin(), parked.end(), [&](const planning::StandingBody& other) {
               return geometry::distance(body, other.outline.front()) >= clearance_m;
           });
}

ManoeuvreQuery draw_query(const ManoeuvreScene& scene, bool near, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    const auto place = [&] {
        for (;;) {
            const Pose2 pose{uniform(0, 120), uniform(0, 60), uniform(-kPi, kPi)};
            if (scene.is_free(pose)) return pose;
        }
    };
    for (;;) {
        const ManoeuvreQuery query{place(), place(), 0, near};
        const double apart = geometry::distance(query.start.position(), query.goal.position());
        if (near ? apart > 3 && apart < 20 : apart > 40) return query;
    }
}

}  // namespace pulseline::bench
