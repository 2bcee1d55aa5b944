#pragma once

#include <optional>
#include <string>

#include "core/control/seen_points.hpp"
#include "core/onboard/executor.hpp"
#include "core/onboard/look_out.hpp"

namespace pulseline::onboard {

/// When something has barred the way for a while, drives round it inside the corridors of its base
/// (planning::plan_detour), or asks for a longer base, or says why it does neither. Scanners and
/// fields stay on all the way; what they show then makes it plan anew from where it stands.
/// Thread safety: none. All it is given must outlive it.
class GoingRound {
public:
    GoingRound(const plant::VehicleType& type, bool loaded, const Drive& drive, LookOut& look_out,
               Executor& executor)
        : type_(type), loaded_(loaded), drive_(drive), look_out_(look_out), executor_(executor) {}

    void carry(bool loaded) { loaded_ = loaded; }
    /// After the look-out's step, before the executor's.
    void step(double dt_s);
    /// True once after it began or ended to go round, or the reason not to has changed.
    bool take_changed();
    /// That it goes round, and behind the look-out's error why it does not.
    void write_state(vda5050::StateMessage& state) const;

private:
    void remember();
    void watch_detour();
    bool due() const;
    void plan();
    Result<planning::Detour> plan(const std::vector<planning::DetourEdge>& stretch) const;
    void tell(std::string going, std::string why_not);

    const plant::VehicleType& type_;
    bool loaded_;
    const Drive& drive_;
    LookOut& look_out_;
    Executor& executor_;
    control::SeenPoints seen_;
    std::size_t looks_ = 0;
    double barred_for_s_ = 0;  // own time
    double since_plan_s_ = 0;  // own time
    double since_plan_real_s_ = 0;
    std::optional<std::size_t> planned_edges_;  // in its base when it last planned in vain
    std::string going_;                         // what it says of its detour; empty: it is on none
    std::string why_not_;                       // empty: nothing to say
    bool meets_ = false;                        // the rest of its detour meets something seen since
    bool changed_ = false;
};

}  // namespace pulseline::onboard
