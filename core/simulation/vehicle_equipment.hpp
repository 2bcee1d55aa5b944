#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/fleet/state/vehicle_messages.hpp"
#include "core/plant/plant.hpp"
#include "core/simulation/lifting_drive.hpp"

namespace pulseline::simulation {

using geometry::Pose2;

/// What a simulated vehicle does standing besides measuring: it charges at a charger, and one with
/// brackets lowers and raises its parking feet (in step) and its brackets, one or all in step, by
/// setBracketHeight {bracket: name or "all", height_m}. Speeds are times the time factor.
/// Thread safety: none. No clock: time passes by step().
class VehicleEquipment {
public:
    /// `chargers`: true poses at which the contacts meet. REQUIRES: 0 <= battery_percent <= 100.
    /// `load_kg` lies on the brackets, nearly in their middle.
    VehicleEquipment(const plant::VehicleType& type, std::vector<Pose2> chargers,
                     double battery_percent, double time_factor, double load_kg = 0,
                     std::uint64_t seed = 1);

    /// VDA 5050 action types that it runs at nodes.
    const std::vector<std::string>& action_types() const { return action_types_; }
    bool runs(const std::string& action_type) const;

    /// Begins an action of action_types(), the vehicle standing at `true_pose`. The error is the
    /// resultDescription of the failed action.
    std::optional<std::string> begin(const fleet::Action& action, const Pose2& true_pose);
    bool busy() const;
    /// Why the movement that was begun last did not end; nullopt: it did, or is at work.
    std::optional<std::string> failure() const;
    /// Feet and brackets stay where they are.
    void abort();

    /// `way_m`: driven meanwhile.
    void step(double dt_s, double way_m);
    /// Plugged in or on its feet: it must not drive.
    bool holds_vehicle() const;
    void write_state(fleet::StateMessage& state);
    /// Above the lower limit switch; nullopt: there is no such bracket.
    std::optional<double> bracket_height_m(const std::string& name) const;

private:
    std::optional<std::string> begin_bracket(const fleet::Action& action);

    std::vector<std::string> action_types_;
    std::vector<Pose2> chargers_;
    double time_factor_;
    double battery_percent_;
    bool charging_ = false;
    bool lifting_ = false;  // what was begun last moves brackets
    double load_kg_;
    std::optional<LiftingDrive> feet_;
    std::optional<LiftingDrive> brackets_;
};

}  // namespace pulseline::simulation
