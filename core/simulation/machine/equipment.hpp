#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/onboard/equipment.hpp"
#include "core/plant/plant.hpp"
#include "core/simulation/machine/lifting_drive.hpp"
#include "core/simulation/machine/parking_gear.hpp"
#include "core/simulation/world/floor_height.hpp"
#include "core/simulation/world/supports.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::simulation {

using geometry::Pose2;

/// What a simulated vehicle does standing besides measuring: it charges at a charger, lowers and
/// raises its parking feet, all or one by {foot: name}, and its brackets, one or all in step, by
/// setBracketHeight {bracket: name or "all", height_m, speed_mps or none}. Speeds are times the
/// time factor. Thread safety: none. No clock: time passes by step().
class VehicleEquipment : public onboard::Equipment {
public:
    /// `true_pose`: where the vehicle truly stands; must outlive it. `chargers`: true poses at
    /// which the contacts meet. `load_kg` lies on the brackets, nearly in their middle.
    /// `floor_height`: of the hall, below its feet and wheels. REQUIRES: 0 <= battery_percent <=
    /// 100.
    VehicleEquipment(const plant::VehicleType& type, const Pose2& true_pose,
                     std::vector<Pose2> chargers, double battery_percent, double time_factor,
                     double load_kg = 0, std::uint64_t seed = 1,
                     FloorHeight floor_height = usual_floor_height);

    const std::vector<std::string>& action_types() const override { return action_types_; }
    std::optional<std::string> begin(const vda5050::Action& action) override;
    bool busy() const override;
    std::optional<std::string> failure() const override;
    void abort() override;
    bool holds_vehicle() const override;
    std::vector<vda5050::BracketStatus> brackets() override;

    /// What hangs or stands in its hall, to be taken over and set down; `carried`: of what lies on
    /// its brackets now. Without it nothing comes or goes.
    void work_below(std::shared_ptr<Supports> supports, plant::HallId hall,
                    std::optional<TrueLoad> carried);
    /// That its wheels carry now.
    double load_kg() const { return load_kg_; }
    /// All or a part of it is on its brackets.
    const std::optional<TrueLoad>& carried() const { return carried_; }

    // Faults, from outside. False: there is no such part.
    bool displace_bracket(const std::string& name, double by_m);
    bool dig_below(const std::string& foot) { return feet_ && feet_->dig(foot); }

    /// `way_m`: driven meanwhile.
    void step(double dt_s, double way_m);
    void write_state(vda5050::StateMessage& state);
    /// Above the lower limit switch; nullopt: there is no such bracket.
    std::optional<double> bracket_height_m(const std::string& name) const;

private:
    std::optional<std::string> begin_bracket(const vda5050::Action& action);
    std::optional<std::string> begin_feet(const vda5050::Action& action);
    void meet_support();
    void share_with_support();
    double mean_height_m() const;

    const Pose2& true_pose_;
    std::vector<std::string> action_types_;
    std::vector<Pose2> chargers_;
    double time_factor_;
    double battery_percent_;
    bool charging_ = false;
    bool lifting_ = false;  // what was begun last moves brackets
    bool parking_ = false;  // what was begun last moves feet
    double load_kg_;
    geometry::Point2 load_centre_;  // body frame
    geometry::Point2 middle_;       // of the brackets
    std::shared_ptr<Supports> supports_;
    plant::HallId hall_;
    std::optional<TrueLoad> carried_;     // a part of it, too
    Supports::Place* support_ = nullptr;  // that a movement of the brackets shares the load with
    std::optional<ParkingGear> feet_;
    std::optional<LiftingDrive> brackets_;
};

}  // namespace pulseline::simulation
