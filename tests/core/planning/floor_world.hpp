#pragma once

#include <string>
#include <utility>

#include "core/planning/legs/leg_planner.hpp"

namespace pulseline::planning {

/// A hall without lanes: a measuring vehicle of 2.4 m x 1.4 m that moves in any direction, a tug of
/// 1.2 m x 0.8 m that turns and drives; both keep 0.2 m clear.
class FloorWorld {
public:
    explicit FloorWorld(double width_m = 40, double height_m = 30) {
        using plant::MotionMode;
        plant_.id = "floor";
        plant::Hall hall;
        hall.id = plant::HallId("hall");
        hall.outline = {{0, 0}, {width_m, 0}, {width_m, height_m}, {0, height_m}};
        plant_.halls.push_back(hall);
        type("measuring", geometry::rectangle(2.4, 1.4), plant::Kinematics::kMecanum,
             {MotionMode::kLinear, MotionMode::kLateral, MotionMode::kOblique, MotionMode::kFree});
        type("tug", geometry::rectangle(1.2, 0.8), plant::Kinematics::kDifferential,
             {MotionMode::kSelfRotation, MotionMode::kLinear, MotionMode::kFree});
    }

    plant::Plant& plant() { return plant_; }
    void area(const std::string& id, geometry::Polygon outline) {
        plant_.areas.push_back({plant::AreaId(id),
                                plant::AreaKind::kObstacle,
                                id,
                                plant::HallId("hall"),
                                std::move(outline),
                                {}});
    }
    void box(const std::string& id, double x0, double y0, double x1, double y1) {
        area(id, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
    }
    void station(int number, geometry::Pose2 pose) {
        plant::Station station;
        station.id = plant::StationId("st" + std::to_string(number));
        station.number = number;
        station.hall = plant::HallId("hall");
        station.pose = pose;
        plant_.stations.push_back(station);
    }
    LegRequest request(const char* type_id, geometry::Pose2 from, int to) const {
        LegRequest request;
        request.type = plant::find_vehicle_type(plant_, plant::VehicleTypeId(type_id));
        request.hall = plant::HallId("hall");
        request.start = from;
        request.target = plant::find_station(plant_, to)->id;
        return request;
    }

private:
    void type(const char* id, geometry::Polygon footprint, plant::Kinematics kinematics,
              std::vector<plant::MotionMode> modes) {
        plant::VehicleType type;
        type.id = plant::VehicleTypeId(id);
        type.name = id;
        type.kinematics = kinematics;
        type.footprint = std::move(footprint);
        type.clearance_m = 0.2;
        type.motion_modes = std::move(modes);
        plant_.vehicle_types.push_back(type);
    }

    plant::Plant plant_;
};

}  // namespace pulseline::planning
