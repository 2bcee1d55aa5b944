#include "core/simulation/hand_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "core/kinematics/primitives.hpp"

namespace pulseline::simulation {
namespace {

using geometry::Point2;
using kinematics::Segment;
using kinematics::Twist;

constexpr double kWay_m = 20;  // queued at once: nobody walks farther without letting go
constexpr double kTurn_rad = 2 * kPi;
constexpr double kNothing = 1e-3;

bool still(const Twist& twist) { return twist == Twist{}; }

/// What a hand-held control can ask for: one motion that can be told in segments.
Twist plain(Twist wanted) {
    const double way = std::hypot(wanted.vx_mps, wanted.vy_mps);
    if (way < kNothing)
        return {0, 0, std::abs(wanted.turn_radps) < kNothing ? 0 : wanted.turn_radps};
    if (std::abs(wanted.vy_mps) > kNothing) wanted.turn_radps = 0;
    const double slower = std::min(1.0, HandDrive::kFastest_mps / way);
    return {slower * wanted.vx_mps, slower * wanted.vy_mps, slower * wanted.turn_radps};
}

std::vector<Segment> way_of(const Pose2& from, const Twist& twist) {
    std::vector<Segment> segments;
    const double way = std::hypot(twist.vx_mps, twist.vy_mps);
    if (way < kNothing) {
        kinematics::append_turn(segments, from, std::copysign(kTurn_rad * 0.9, twist.turn_radps));
    } else if (std::abs(twist.turn_radps) < kNothing) {
        const Point2 ahead{kWay_m * twist.vx_mps / way, kWay_m * twist.vy_mps / way};
        kinematics::append_straight(segments, from, from * ahead);
    } else {
        const double rho_m = twist.vx_mps / twist.turn_radps;  // to the left
        const Point2 centre = from * Point2{0, rho_m};
        const double turn_rad = std::copysign(kPi, twist.turn_radps);
        const Pose2 turned{centre.x_m, centre.y_m, turn_rad};
        kinematics::append_arc(segments, from, centre, turn_rad, twist.vx_mps < 0,
                               turned * (from.position() - centre));
    }
    return segments;
}

}  // namespace

void HandDrive::take() {
    wanted_ = driven_ = {};
    asked_for_s_ = 0;
    drive_.hold();
}

Status HandDrive::command(const Twist& wanted) {
    const Twist asked = plain(wanted);
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
    if (!still(driven_) && driven_ == wanted_) return;
    drive_.hold();
    if (!drive_.standing()) return;
    drive_.clear();
    driven_ = wanted_;
    if (still(driven_)) return;
    const double speed_mps = std::hypot(driven_.vx_mps, driven_.vy_mps);
    const auto way = way_of(drive_.believed_pose(), driven_);
    for (const Segment& segment : way) {
        drive_.append(segment, speed_mps * drive_.time_factor());
    }
    const double turn_radps = std::min(std::abs(driven_.turn_radps), kFastest_radps);
    drive_.slow_to(speed_mps > 0 ? 1 : turn_radps / kinematics::max_rate(drive_.type(), way[0], 0));
    drive_.release();
}

void HandDrive::give_back() {
    assert(standing());
    drive_.clear();
    drive_.slow_to(1);
    drive_.release();
}

}  // namespace pulseline::simulation
