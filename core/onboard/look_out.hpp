#pragma once

#include <optional>
#include <vector>

#include "core/control/protective_fields.hpp"
#include "core/onboard/drive.hpp"
#include "core/onboard/scanners.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// The vehicle's scanners and the fields that follow its motion: beside something it drives slower,
/// before something it stops and waits until that is gone. With a scanner that cannot see it stays.
/// Not a safety function, as little as the fields are.
class LookOut {
public:
    // Types of the errors that it reports.
    static constexpr const char* kObstacle = "obstacle";
    static constexpr const char* kBlind = "scannerBlind";

    /// `drive` is slowed down by it; both must outlive it.
    LookOut(Scanners& scanners, bool loaded, Drive& drive);
    /// Its body is that with the usual load of its type from now on, or that without.
    void carry(bool loaded);

    /// Before what bars its run it stops with room to swing out, instead of driving up to it as
    /// near as the fields let it: for a vehicle that may go round.
    void keep_room(bool keeps) { keeps_room_ = keeps; }
    /// Bars the way as the fields do, while somebody knows of something that they do not see.
    void bar(bool bars) { told_to_bar_ = bars; }
    void step(double dt_s);
    bool barred() const { return barred_; }
    /// Of the vehicle's speed, what the fields let it drive; 0: barred.
    double speed_share() const { return barred_ ? 0 : last_.speed_share; }
    /// The last look, one scan a scanner, and how many there have been. While nothing moves nor
    /// wants to, it does not look.
    const std::vector<control::Scan>& scans() const { return scans_; }
    std::size_t looks() const { return looks_; }
    /// True once after it began or ended to bar the way.
    bool take_changed();
    /// Field, and what is in the way.
    void write_state(vda5050::StateMessage& state) const;

private:
    kinematics::Twist start_twist() const;
    kinematics::Twist intended() const;
    double stopping_m(const kinematics::Twist& twist) const;
    control::FieldAnswer check(const kinematics::Twist& twist);
    control::FieldAnswer look();

    Scanners& scanners_;
    Drive& drive_;
    std::vector<control::Scan> scans_;
    std::vector<control::ProtectiveFields> fields_;  // one for each convex piece of the outline
    control::FieldAnswer last_;
    std::size_t looks_ = 0;
    double until_scan_s_ = 0;
    double free_for_s_ = 0;
    bool keeps_room_ = false;
    bool told_to_bar_ = false;
    bool barred_ = false;
    bool blind_ = false;
    bool changed_ = false;
};

}  // namespace pulseline::onboard
