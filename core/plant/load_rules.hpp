#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/plant/vehicle_type.hpp"

/// Whether what lies on a vehicle's brackets keeps the rules of its type (Tang 2020, section 2.1:
/// the forces are checked before the platform drives). One rule for the drive, the checks that
/// people see, and the lifts.
namespace pulseline::plant {

/// What presses on a bracket, the sum of its sensors.
struct BracketForce {
    std::string bracket;
    double force_n = 0;
};

struct LoadOnBrackets {
    double force_n = 0;
    Point2 centre;  // of gravity, body frame; that of bodies that lie on brackets alone
};
/// Nothing: no bracket says anything, or no more than its sensors' noise.
std::optional<LoadOnBrackets> load_on(const VehicleType& type,
                                      const std::vector<BracketForce>& forces);

/// The most that one bracket may carry: the type's rating, or, where it has none, half as much
/// again as an even share of its largest load. REQUIRES: the type has brackets.
double bracket_rating_n(const VehicleType& type);

/// The bracket that departs farthest from the mean of its end; of two that do so alike, the one
/// farther from the mean of all.
struct BracketShare {
    std::string bracket;
    double share = 0;  // of the mean of its end, signed
    double limit = 0;  // by how much it may
};
/// Nothing without a load.
std::optional<BracketShare> worst_bracket(const VehicleType& type,
                                          const std::vector<BracketForce>& forces);

/// Whether it weighs what it is known to weigh; 0: nobody has weighed it, so it does. Load cells
/// and scales are far better than that; a part that still hangs or stands elsewhere is more.
bool weighs_as_known(double measured_kg, double known_kg);

/// The first rule that the load breaks: load_too_heavy {load_kg, max_load_kg}, bracket_overloaded
/// {bracket, force_n, limit_n}, load_unbalanced {bracket, unbalance, limit},
/// load_outside_wheel_base {x_m, y_m}, load_outside_limits {x_m, y_m}.
std::optional<Reason> load_fault(const VehicleType& type, const std::vector<BracketForce>& forces);
/// Of these rules the ones of where a centre of gravity may be, body frame.
std::optional<Reason> centre_fault(const VehicleType& type, Point2 centre);

/// From where the centre of a load is told, body frame; no brackets: the vehicle's own.
Point2 bracket_middle(const VehicleType& type);

}  // namespace pulseline::plant
