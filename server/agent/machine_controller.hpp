#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "api/machine/frames.hpp"
#include "core/kinematics/wheels.hpp"
#include "server/agent/machine_link.hpp"

namespace pulseline::agent {

/// The controller of a machine as the program sees it over their line (MACHINE.md): what it has
/// told last, and its coming back when the line was lost. Thread safety: none. No clock: what waits
/// for an answer waits in it, and never long.
class MachineController {
public:
    /// `own_pictures`: names of cameras whose pictures come from elsewhere; it may leave them out.
    /// `type` must outlive it.
    MachineController(MachineAddress address, const plant::VehicleType& type, double watchdog_s,
                      const std::vector<std::string>& own_pictures);

    /// Errors: those of MachineLink, machine_refused {why}, machine_not_of_type {part, told,
    /// wanted}, machine_too_large {parts, most}.
    Status reach();
    /// One cycle. Without an answer in the watchdog's time the line counts as lost.
    void exchange(machine::Mode mode, std::span<const kinematics::WheelMotion> wanted);
    /// False: the line is lost.
    bool say(const machine::Frame& frame);
    /// Errors: machine_silent, machine_refused, and those of MachineLink.
    Result<machine::Picture> expose(const std::string& camera);
    /// The newest turn of the scanners; nullptr: the line is lost.
    const machine::Scans* look();
    /// Once a step: reaches for a machine that is lost.
    void try_again(double dt_s);

    bool lost() const { return !link_; }
    const machine::Feedback& told() const { return told_; }
    int dead_cycles() const { return dead_cycles_; }
    /// Of the newest set points.
    std::uint32_t cycle() const { return number_; }
    /// Exchanged since the last call.
    int take_cycles();
    std::vector<machine::LiftEnded> take_ended();

private:
    Status fits(const machine::Description& told) const;
    machine::Hello hello() const;
    Result<machine::Frame> hear(MachineLink::Duration timeout);
    void note(machine::Frame frame);
    std::uint32_t ask_to_look();
    void take(machine::Feedback told);
    void lose(const Error& error);

    MachineAddress address_;
    const plant::VehicleType& type_;
    double watchdog_s_;
    std::vector<std::string> pictured_;  // cameras that it takes pictures of
    std::vector<std::string> cameras_;   // as it counts them
    std::optional<MachineLink> link_;
    machine::Feedback told_;
    std::vector<machine::LiftEnded> ended_;
    std::uint32_t number_ = 0;
    std::uint32_t pictures_ = 0;
    std::uint32_t looks_ = 0;
    std::optional<machine::Scans> scans_;  // the newest
    std::uint32_t scans_at_ = 0;           // cycle in which they came
    std::optional<std::uint32_t> looked_at_;
    int cycles_ = 0;
    int dead_cycles_ = 0;
    double since_try_s_ = 0;
};

/// Names of wheels, brackets or cameras, in their order.
template <class Part>
std::vector<std::string> names_of(const std::vector<Part>& parts) {
    std::vector<std::string> names;
    for (const auto& part : parts) names.push_back(part.name);
    return names;
}
std::vector<std::string> feet_of(const plant::VehicleType& type);

}  // namespace pulseline::agent
