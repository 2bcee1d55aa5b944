#pragma once

#include <optional>
#include <string>

#include "core/onboard/executor.hpp"

namespace pulseline::onboard {

/// One of the hand-held controls that a vehicle hears: a page of the dashboard, or one beside it.
struct HandControl {
    std::string id;
    std::string person;  // as whom the server knows; empty: whoever stands beside the vehicle
};

/// Which of several hand-held controls has the vehicle: the program decides between them and its
/// orders (Tang 2020, section 2: remote or navigation), not the server, since only what is on board
/// knows what it does. One at a time; another gets it when the first has given it back, has gone,
/// or has been silent for kSilent_s. Between controls the vehicle stands braked, in MANUAL.
/// `now_s` is the time on a clock that never goes back, with any zero. Thread safety: none.
class HandControls {
public:
    /// So long without a word, and another may take it.
    static constexpr double kSilent_s = 2;
    /// A command that took so much longer than the quickest since it was taken was meant for then,
    /// not for now: a line that stood still gives all of them at once. It brakes instead.
    static constexpr double kLate_s = HandDrive::kLetGo_s;

    explicit HandControls(Executor& executor) : executor_(executor) {}

    /// Taking what one has does nothing. Fails with conflict in_other_hands {person}.
    Status take(const HandControl& control, double now_s);
    /// As Executor::drive_by_hand; `sent_s` is when it was said by the control's own clock, if that
    /// is known. Fails with not_in_hand {}, in_other_hands {person}, too_late {late_s}.
    Status drive(const std::string& control, const kinematics::Twist& wanted,
                 std::optional<double> sent_s, double now_s);
    /// As Executor::give_back. Fails with not_in_hand {}, in_other_hands {person}.
    Status give_back(const std::string& control);
    /// It is there, whatever else it says.
    void heard(const std::string& control, double now_s);
    /// It has gone: the vehicle stays in MANUAL until somebody takes it.
    void left(const std::string& control);

    /// Who took it last, while it is in hand.
    const std::optional<HandControl>& holder() const { return holder_; }

private:
    Status is_holder(const std::string& control) const;

    Executor& executor_;
    std::optional<HandControl> holder_;
    bool is_there_ = false;  // the holder
    double heard_s_ = 0;
    std::optional<double> quickest_s_;  // least of now - sent since it was taken
    double quickest_at_s_ = 0;
};

}  // namespace pulseline::onboard
