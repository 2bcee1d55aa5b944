#pragma once

#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/fleet/state/ports.hpp"
#include "core/onboard/executor.hpp"
#include "core/onboard/load_handling.hpp"
#include "core/simulation/machine/equipment.hpp"
#include "core/simulation/machine/vehicle_motion.hpp"

/// A vehicle in the judge's hall: the real executor on a simulated platform, with what people and
/// faults do to it.
namespace pulseline::fleet_judge {

using geometry::Pose2;

class Vehicle {
public:
    /// `supports`: what all vehicles of the hall share.
    Vehicle(const plant::Plant& plant, const plant::Vehicle& vehicle,
            std::shared_ptr<simulation::Supports> supports, std::uint64_t seed);
    ~Vehicle();

    void receive(const fleet::VehicleMessage& message);
    void step(double dt_s);
    /// Power cycle: it knows neither order nor pose.
    void restart();
    /// Nothing comes through to it, or from it, and it knows.
    void lose_link() { executor_->lose_link(); }
    /// Pushed by people; its own pose follows, as odometry does.
    void push(const Pose2& to);
    vda5050::StateMessage state();
    /// From now on it says that it stands elsewhere, so far from where it is, in so many reports or
    /// until it is told where it stands. It drives where it should all the same.
    void misread(const Pose2& by, int reports);
    bool misreads() const { return misread_reports_ > 0; }
    /// Something happened that is reported at once.
    bool take_changed();

    const plant::Vehicle& what() const { return vehicle_; }
    const plant::VehicleType& type() const { return type_; }
    const Pose2& pose() const { return motion_->true_pose(); }
    bool moved() const { return moved_; }  // by its own drives, in the last step
    bool standing() const { return motion_->standing(); }
    bool knows_pose() const { return executor_->position_initialized(); }
    bool at_work() const { return !motion_->idle() || executor_->acting(); }
    const onboard::Executor& executor() const { return *executor_; }
    /// Stands on its feet, or moves them.
    bool on_feet() const { return equipment_ && equipment_->holds_vehicle(); }
    /// The ids of the actions, outside orders, that have moved its brackets or feet.
    const std::vector<std::string>& lifts_begun() const { return lifts_begun_; }
    /// What truly weighs on its brackets.
    double load_kg() const { return equipment_ ? equipment_->load_kg() : 0; }
    /// Of which that is all or a part.
    std::optional<plant::LoadId> load() const;
    /// The highest of its brackets.
    double bracket_height_m() const;

    bool dead = false;            // without power: silent and standing
    bool manual = false;          // a person has taken it over
    bool broken = false;          // a fatal error; it stands
    bool safety_stopped = false;  // until a person acknowledges it at the vehicle
    bool shows_codes = false;     // whenever it stands, not only when it has lost its pose

private:
    class Cameras;
    void boot(const Pose2& pose);
    std::vector<vda5050::CameraReading> readings() const;

    const plant::Plant& plant_;
    const plant::Vehicle& vehicle_;
    const plant::VehicleType& type_;
    std::mt19937_64 random_;
    std::unique_ptr<simulation::VehicleMotion> motion_;
    std::unique_ptr<Cameras> cameras_;
    std::unique_ptr<simulation::VehicleEquipment> equipment_;  // of a type with parking feet
    std::unique_ptr<onboard::LoadHandling> handling_;          // of one with brackets
    std::optional<onboard::BegunTransfer> begun_transfer_;     // as its disk has it
    std::unique_ptr<onboard::Executor> executor_;
    Pose2 stands_;  // as its feet know it
    std::vector<std::string> lifts_begun_;
    std::int64_t header_id_ = 0;
    Pose2 misread_;
    int misread_reports_ = 0;
    bool moved_ = false;
    bool was_ = false;  // one of the three above, when last asked for changes
};

}  // namespace pulseline::fleet_judge
