#include "core/onboard/hand_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace pulseline::onboard {
namespace {

using kinematics::Twist;

constexpr double kNothing = 1e-3;

/// What a hand-held control can ask of the vehicle, no faster than somebody walks.
Twist within_reach(Twist wanted) {
    const double way = std::hypot(wanted.vx_mps, wanted.vy_mps);
    if (way < kNothing) wanted.vx_mps = wanted.vy_mps = 0;
    if (std::abs(wanted.turn_radps) < kNothing) wanted.turn_radps = 0;
    const double turn = std::abs(wanted.turn_radps);
    const double slower = std::min({1.0, HandDrive::kFastest_mps / std::max(way, kNothing),
                                    HandDrive::kFastest_radps / std::max(turn, kNothing)});
    return {slower * wanted.vx_mps, slower * wanted.vy_mps, slower * wanted.turn_radps};
}

}  // namespace

void HandDrive::take() {
    wanted_ = {};
    asked_for_s_ = 0;
    taking_ = true;
    drive_.hold();
}

Status HandDrive::command(const Twist& wanted) {
    const Twist asked = within_reach(wanted);
    if (const auto wheels = kinematics::wheels_of(drive_.type(), asked); !wheels) {
        wanted_ = {};
        return fail(wheels.error());
    }
    wanted_ = asked;
    asked_for_s_ = kLetGo_s;
    return {};
}

void HandDrive::step(double dt_s) {
    asked_for_s_ -= dt_s;
    if (asked_for_s_ <= 0) wanted_ = {};
    if (taking_) {
        drive_.hold();
        if (!drive_.standing()) return;
        drive_.clear();
        drive_.slow_to(1);
        taking_ = false;
    }
    drive_.release();
    const double factor = drive_.time_factor();
    drive_.steer({factor * wanted_.vx_mps, factor * wanted_.vy_mps, factor * wanted_.turn_radps});
}

void HandDrive::give_back() {
    assert(standing());
    drive_.clear();
    drive_.slow_to(1);
    drive_.release();
}

}  // namespace pulseline::onboard
