#pragma once

#include "core/planning/legs/leg_planner.hpp"

namespace pulseline::planning {

/// A hall of 100 m x 60 m: two halves joined by a gap in a wall of obstacles at x = 50, a roadmap
/// through the gap, a pillar between stations 1 and 2, three stations; platform and tug.
class LegWorld {
public:
    explicit LegWorld(double gap_m) {
        using plant::MotionMode;
        plant_.id = "test";
        plant::Hall hall;
        hall.id = plant::HallId("hall");
        hall.outline = {{0, 0}, {100, 0}, {100, 60}, {0, 60}};
        plant_.halls.push_back(hall);
        area("south", {{49, 0}, {51, 0}, {51, 30 - gap_m / 2}, {49, 30 - gap_m / 2}});
        area("north", {{49, 30 + gap_m / 2}, {51, 30 + gap_m / 2}, {51, 60}, {49, 60}});
        area("pillar", {{33, 18}, {35, 18}, {35, 20}, {33, 20}});
        for (const auto& [id, at] :
             std::initializer_list<std::pair<const char*, geometry::Point2>>{{"a", {20, 10}},
                                                                             {"b", {20, 30}},
                                                                             {"c", {80, 30}},
                                                                             {"d", {80, 50}},
                                                                             {"e", {20, 50}}}) {
            plant_.nodes.push_back({plant::NodeId(id), hall.id, at});
        }
        lane("a", "b");
        lane("b", "c");
        lane("c", "d");
        lane("b", "e");
        station(1, "a", {20, 10, 0});
        station(2, "d", {80, 50, kPi / 2});
        station(3, "e", {20, 50, 0});
        plant_.vehicle_types.push_back(type("platform", geometry::rectangle(10.5, 2.5), 0.5));
        plant_.vehicle_types.push_back(type("tug", geometry::rectangle(1.2, 0.8), 0.3));
        plant_.vehicle_types.back().motion_modes = {MotionMode::kLateral, MotionMode::kLinear,
                                                    MotionMode::kFree};
    }

    plant::Plant& plant() { return plant_; }
    void area(const char* id, geometry::Polygon outline,
              plant::AreaKind kind = plant::AreaKind::kObstacle) {
        plant_.areas.push_back(
            {plant::AreaId(id), kind, id, plant::HallId("hall"), std::move(outline), {}});
    }
    LegRequest request(const char* type_id, int from, int to) const {
        LegRequest request;
        request.type = plant::find_vehicle_type(plant_, plant::VehicleTypeId(type_id));
        request.hall = plant::HallId("hall");
        const auto* start = plant::find_station(plant_, from);
        request.start = start->pose;
        request.from_station = start->id;
        request.target = plant::find_station(plant_, to)->id;
        return request;
    }

private:
    void lane(const char* a, const char* b) {
        const auto id = [](const char* x, const char* y) {
            return plant::EdgeId(std::string(x) + "-" + y);
        };
        plant_.edges.push_back({id(a, b), plant::NodeId(a), plant::NodeId(b), 0, {}});
        plant_.edges.push_back({id(b, a), plant::NodeId(b), plant::NodeId(a), 0, {}});
    }
    void station(int number, const char* node, geometry::Pose2 pose) {
        plant::Station station;
        station.id = plant::StationId("st" + std::to_string(number));
        station.number = number;
        station.hall = plant::HallId("hall");
        station.pose = pose;
        station.node = plant::NodeId(node);
        plant_.stations.push_back(station);
    }
    static plant::VehicleType type(const char* id, geometry::Polygon footprint,
                                   double clearance_m) {
        plant::VehicleType type;
        type.id = plant::VehicleTypeId(id);
        type.name = id;
        type.footprint = std::move(footprint);
        type.clearance_m = clearance_m;
        type.motion_modes = {plant::MotionMode::kSelfRotation, plant::MotionMode::kLinear,
                             plant::MotionMode::kFixedAxisRotation};
        return type;
    }

    plant::Plant plant_;
};

}  // namespace pulseline::planning
