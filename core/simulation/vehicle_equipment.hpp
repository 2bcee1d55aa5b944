#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fleet/vehicle_messages.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::simulation {

using geometry::Pose2;

/// What a simulated vehicle does standing besides measuring: it charges at a charger, and one with
/// brackets lowers and raises its parking feet. Speeds are times the time factor.
/// Thread safety: none. No clock: time passes by step().
class VehicleEquipment {
public:
    /// `chargers`: true poses at which the contacts meet. REQUIRES: 0 <= battery_percent <= 100.
    VehicleEquipment(const plant::VehicleType& type, std::vector<Pose2> chargers,
                     double battery_percent, double time_factor);

    /// VDA 5050 action types that it runs at nodes.
    const std::vector<std::string>& action_types() const { return action_types_; }
    bool runs(const std::string& action_type) const;

    /// Begins an action of action_types(), the vehicle standing at `true_pose`. The error is the
    /// resultDescription of the failed action.
    std::optional<std::string> begin(const std::string& action_type, const Pose2& true_pose);
    bool busy() const { return moving_feet_; }
    /// Feet stay where they are.
    void abort() { moving_feet_ = false; }

    /// `way_m`: driven meanwhile.
    void step(double dt_s, double way_m);
    /// Plugged in or on its feet: it must not drive.
    bool holds_vehicle() const;
    void write_state(fleet::StateMessage& state) const;

private:
    std::vector<std::string> action_types_;
    std::vector<Pose2> chargers_;
    double time_factor_;
    double battery_percent_;
    bool charging_ = false;
    bool has_feet_;
    bool moving_feet_ = false;
    double feet_m_ = 0;  // extension of all four
    double wanted_feet_m_ = 0;
};

}  // namespace pulseline::simulation
