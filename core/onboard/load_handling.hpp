#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/onboard/equipment.hpp"
#include "core/plant/vehicle_type.hpp"

namespace pulseline::onboard {

/// A transfer that has begun and not come to its end: a part of the load may hang beside the
/// vehicle. Heights are those of brackets above their lower ends.
struct BegunTransfer {
    double load_kg = 0;              // what it weighs; 0: nobody knows
    std::optional<double> empty_m;   // where it began with nothing on the brackets
    std::optional<double> laden_m;   // where it began with all of the load on them
    bool operator==(const BegunTransfer&) const = default;
};

/// Takes loads over from a hoist or stands, and sets them down, with the brackets of the machine
/// below it (Tang 2020, section 2, workflow; Li 2022, Fig. 1). To take over (`pick`), all brackets
/// go up in step until they feel the load, and then by small steps; after each it looks how the
/// weight is spread, and gives back what breaks a rule of its type (plant/load_rules.hpp). The load
/// is its own when a step brings no more weight. To set down (`drop`), the same the other way. What
/// is broken off stays as it is; begun again it goes on from there. Until then it stays and its feet
/// do (load_half_taken), unless its brackets are clear of the load, or have all of it and are back
/// where it began to set it down: load cells alone tell neither a light touch nor a small part that
/// still hangs. All other actions go through to the machine. Thread safety: none. No clock: what it
/// waits for is seen in step().
class LoadHandling final : public Equipment {
public:
    /// Both must outlive it.
    LoadHandling(Equipment& machine, const plant::VehicleType& type);

    const std::vector<std::string>& action_types() const override { return action_types_; }
    /// pick {loadId, weight: kg, or 0 where nobody knows}, drop {}; both need brackets.
    std::optional<std::string> begin(const vda5050::Action& action) override;
    bool busy() const override { return phase_ != Phase::kRests || machine_.busy(); }
    /// load_not_felt {height_m}, load_differs {load_kg, measured_kg}, load_not_taken {height_m}:
    /// nothing below it holds the load; the load's fault; or what the machine says.
    std::optional<std::string> failure() const override;
    void abort() override;
    bool holds_vehicle() const override { return machine_.holds_vehicle(); }
    bool half_transferred() override;
    std::vector<vda5050::BracketStatus> brackets() override { return machine_.brackets(); }

    /// Once a step of the machine.
    void step();
    /// nullopt: none, or it has ended. To be kept, and told to the next program by begun_before().
    const std::optional<BegunTransfer>& begun() const { return begun_; }
    void begun_before(const BegunTransfer& begun) { begun_ = begun; }

    /// What the load cells say; a vehicle without brackets does not know.
    bool carries() { return read_cells().feels; }

private:
    enum class Phase {
        kRests,
        kFeels,      // up until the load touches
        kTakes,      // up by steps until no more weight comes
        kClears,     // up, the load its own, off what held it
        kGivesBack,  // down to where it began, with a failure
        kSetsDown,   // down by steps until the weight is gone
        kLeaves,     // down, off the load
        kTakesBack,  // up to where it began, with a failure
    };

    struct Cells {
        double force_n = 0;
        double lowest_m = 0;
        double highest_m = 0;
        bool feels = false;  // something lies on the brackets
        std::optional<Reason> fault;
    };
    Cells read_cells();
    /// Its brackets are so low that they touch nothing, which is more than to feel nothing: load
    /// cells do not tell a light touch from their noise.
    bool is_clear(const Cells& cells) const;
    /// All of the load is on its brackets, and they are so high that nothing else holds it.
    bool has_all(const Cells& cells) const;
    void note_begun(const Cells& cells, bool drops);
    void note_felt();
    bool move_to(double height_m, double speed_mps);
    void take(const Cells& cells);
    void set_down(const Cells& cells);
    void give_up(Reason why, Phase back);
    void end();

    Equipment& machine_;
    const plant::VehicleType& type_;
    std::vector<std::string> action_types_;
    Phase phase_ = Phase::kRests;
    bool moved_ = false;      // the machine has, or does, for the transfer: its failure is its own
    bool transfers_ = false;  // what was begun last is a transfer
    bool machine_moved_ = false;  // in the step before
    double told_kg_ = 0;
    std::optional<BegunTransfer> begun_;
    std::optional<double> lowest_felt_m_;  // where it has felt the load of this transfer
    double began_m_ = 0;
    double before_n_ = 0;  // one step ago
    std::optional<std::string> failure_;
};

}  // namespace pulseline::onboard
