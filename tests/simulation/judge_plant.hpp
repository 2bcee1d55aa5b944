#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/traffic/layout_check.hpp"
#include "core/traffic/move_graph.hpp"

/// Random well-formed plants for the simulation judge: rows and columns of lanes with some missing,
/// bays to rest in at the edges, two classes of vehicles.
namespace pulseline::judge {

using traffic::PlaceIndex;
using traffic::TileSet;

struct Point {
    double x_m = 0;
    double y_m = 0;
    friend bool operator==(const Point&, const Point&) = default;
};

struct VehicleClass {
    double length_m = 0;  // along x; vehicles translate and keep their heading
    double width_m = 0;
    traffic::MoveGraph graph;
    std::vector<Point> points;         // of the places
    std::vector<PlaceIndex> stations;  // what orders name
    std::vector<PlaceIndex> resting;
    std::size_t vehicles = 0;
};

struct Plant {
    std::vector<VehicleClass> classes;  // small ones, platforms
};

/// Floor of a body at a point, or on the straight way between two; margin for the position error.
TileSet floor_at(const VehicleClass& of_class, Point at, double margin_m);
TileSet floor_between(const VehicleClass& of_class, Point from, Point to, double margin_m);
double drive_time_s(const VehicleClass& of_class, Point from, Point to);

constexpr double kMargin_m = 0.1;

Plant random_plant(std::mt19937_64& random);

}  // namespace pulseline::judge
