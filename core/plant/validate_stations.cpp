#include <algorithm>
#include <cmath>

#include "core/plant/validate_parts.hpp"

namespace pulseline::plant::detail {
namespace {

/// Least share of the marker's size that must lie around its centre inside the camera's picture.
constexpr double kMarkerRoom = 0.5;

bool allowed_at(const Station& station, const VehicleType& type) {
    return station.vehicle_types.empty() ||
           std::find(station.vehicle_types.begin(), station.vehicle_types.end(), type.id) !=
               station.vehicle_types.end();
}

bool touches_grid(const OccupancyGrid& grid, const Polygon& body) {
    if (grid.empty()) return false;
    const geometry::Box box = geometry::bounding_box(body);
    const auto cell = [&](double value, double origin) {
        return static_cast<int>(std::floor((value - origin) / grid.resolution_m));
    };
    const double r = grid.resolution_m;
    for (int row = cell(box.min.y_m, grid.origin.y_m); row <= cell(box.max.y_m, grid.origin.y_m);
         ++row) {
        for (int col = cell(box.min.x_m, grid.origin.x_m);
             col <= cell(box.max.x_m, grid.origin.x_m); ++col) {
            if (!grid.is_occupied(col, row)) continue;
            const Point2 corner{grid.origin.x_m + col * r, grid.origin.y_m + row * r};
            if (geometry::intersects(body, {corner,
                                            {corner.x_m + r, corner.y_m},
                                            {corner.x_m + r, corner.y_m + r},
                                            {corner.x_m, corner.y_m + r}})) {
                return true;
            }
        }
    }
    return false;
}

bool crosses_outline(const Polygon& outline, const Polygon& body) {
    for (const Point2& corner : body) {
        if (!geometry::contains(outline, corner)) return true;
    }
    // All corners inside; a hall's corner that points inwards may still cut the body.
    for (const Point2& corner : outline) {
        const bool shared = std::any_of(body.begin(), body.end(), [&](Point2 p) {
            return geometry::distance(p, corner) < 1e-9;
        });
        if (!shared && geometry::contains(body, corner)) return true;
    }
    return false;
}

/// What the pieces of a standing vehicle touch; empty when nothing.
std::string in_the_way(const Plant& plant, const Hall& hall, const Pose2& pose,
                       const std::vector<Polygon>& pieces) {
    for (const Polygon& piece : pieces) {
        const Polygon body = geometry::transformed(pose, piece);
        if (crosses_outline(hall.outline, body)) return "the hall's wall";
        for (const Area& area : plant.areas) {
            const bool closed = area.kind == AreaKind::kObstacle || area.kind == AreaKind::kNoGo;
            if (closed && area.hall == hall.id && geometry::intersects(area.outline, body)) {
                return "area " + quoted(area.id.str());
            }
        }
        if (touches_grid(hall.grid, body)) return "an occupied cell of the grid";
    }
    return {};
}

bool in_view(const Camera& camera, const Pose2& hall_from_body, const Marker& marker) {
    const Pose2 hall_from_camera = hall_from_body * camera.body_from_camera;
    const Point2 p = inverse(hall_from_camera) * marker.pose.position();
    // Image +u lies along the camera's x, +v clockwise from it, so along -y of a left-handed view.
    const double scale = camera.f_px / camera.height_m;
    const double u = camera.cu_px + scale * p.x_m;
    const double v = camera.cv_px - scale * p.y_m;
    const double room = kMarkerRoom * marker.size_m * scale;
    return u >= room && v >= room && u <= camera.width_px - 1 - room &&
           v <= camera.height_px - 1 - room;
}

void check_view(const Station& station, std::size_t i, const VehicleType& type, const Index& index,
                Faults& faults) {
    if (type.cameras.empty()) return;
    for (std::size_t m = 0; m < station.markers.size(); ++m) {
        const auto* marker = look_up(index.markers, station.markers[m]);
        if (marker == nullptr) continue;
        const bool seen = std::any_of(type.cameras.begin(), type.cameras.end(), [&](const auto& c) {
            return in_view(c, station.pose, **marker);
        });
        if (seen) continue;
        faults.add(
            at("stations", i, "/markers/" + std::to_string(m)), "marker_not_in_view",
            "No camera of a " + quoted(type.id.str()) + " standing there has " +
                quoted(station.markers[m].str()) + " whole in its picture.",
            "Move the marker below a camera, or correct the station's pose or the mounting.");
    }
}

void check_room(const Plant& plant, const Station& station, std::size_t i, const Index& index,
                Faults& faults) {
    if (station.charger && !station.resting_place) {
        faults.add(at("stations", i, "/charger"), "charger_no_resting_place",
                   "Station " + std::to_string(station.number) +
                       " is a charger and no resting place; a vehicle that charges rests there.",
                   "Set resting_place of the station, or leave charger out.");
    }
    const auto* hall = look_up(index.halls, station.hall);
    if (hall == nullptr) return;
    if (!geometry::contains((*hall)->outline, station.pose.position())) {
        faults.add(at("stations", i, "/pose"), "outside_hall",
                   "Station " + std::to_string(station.number) + " lies outside its hall.",
                   "Correct the pose or the hall's outline.");
        return;
    }
    for (const VehicleType& type : plant.vehicle_types) {
        if (!allowed_at(station, type)) continue;
        const std::string what =
            in_the_way(plant, **hall, station.pose, outline_with_load(type, false));
        if (!what.empty()) {
            faults.add(at("stations", i, "/pose"), "no_room",
                       "A " + quoted(type.id.str()) + " standing at station " +
                           std::to_string(station.number) + " would touch " + what + ".",
                       "Move the station, or leave the type out of its vehicle_types.");
        }
        check_view(station, i, type, index, faults);
    }
}

struct Home {
    std::size_t vehicle;
    const Hall* hall;
    std::vector<Polygon> pieces;  // hall frame
};

void check_homes(const Plant& plant, const Index& index, Faults& faults) {
    std::vector<Home> homes;
    for (std::size_t i = 0; i < plant.vehicles.size(); ++i) {
        const Vehicle& vehicle = plant.vehicles[i];
        const auto* station_index = look_up(index.stations, vehicle.home);
        const auto* type = look_up(index.types, vehicle.type);
        if (station_index == nullptr || type == nullptr) continue;
        const Station& station = plant.stations[*station_index];
        const auto* hall = look_up(index.halls, station.hall);
        if (hall == nullptr) continue;
        if (!allowed_at(station, **type)) {
            faults.add(at("vehicles", i, "/home"), "home_not_for_type",
                       quoted(station.id.str()) + " is not for vehicles of type " +
                           quoted(vehicle.type.str()) + ".",
                       "Choose another home or add the type to the station's vehicle_types.");
            continue;
        }
        if (!station.resting_place) {
            faults.add(at("vehicles", i, "/home"), "home_no_resting_place",
                       quoted(station.id.str()) + " is no resting place.",
                       "Set resting_place of the station or choose another home.");
        }
        Home home{i, *hall, {}};
        const auto body = outline_with_load(**type, first_load(plant, vehicle.id) != nullptr);
        const std::string what = in_the_way(plant, **hall, station.pose, body);
        if (!what.empty()) {
            faults.add(
                at("vehicles", i, "/home"), "home_too_small",
                quoted(vehicle.id.str()) + " with its load would touch " + what + " at its home.",
                "Choose a home with more room.");
            continue;
        }
        for (const Polygon& piece : body) {
            home.pieces.push_back(geometry::transformed(station.pose, piece));
        }
        for (const Home& other : homes) {
            const bool meet =
                other.hall == home.hall &&
                std::any_of(home.pieces.begin(), home.pieces.end(), [&](const Polygon& a) {
                    return std::any_of(
                        other.pieces.begin(), other.pieces.end(),
                        [&](const Polygon& b) { return geometry::intersects(a, b); });
                });
            if (meet) {
                faults.add(at("vehicles", i, "/home"), "homes_overlap",
                           quoted(vehicle.id.str()) + " and " +
                               quoted(plant.vehicles[other.vehicle].id.str()) +
                               " would touch when both are at home.",
                           "Choose homes further apart.");
            }
        }
        homes.push_back(std::move(home));
    }
}

}  // namespace

void check_stations(const Plant& plant, const Index& index, Faults& faults) {
    for (std::size_t i = 0; i < plant.stations.size(); ++i) {
        check_room(plant, plant.stations[i], i, index, faults);
    }
    for (std::size_t i = 0; i < plant.markers.size(); ++i) {
        const auto* hall = look_up(index.halls, plant.markers[i].hall);
        if (hall != nullptr &&
            !geometry::contains((*hall)->outline, plant.markers[i].pose.position())) {
            faults.add(at("markers", i, "/pose"), "outside_hall",
                       "The marker lies outside its hall.", "Correct the pose or the hall.");
        }
    }
    check_homes(plant, index, faults);
}

}  // namespace pulseline::plant::detail
