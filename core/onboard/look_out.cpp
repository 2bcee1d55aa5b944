#include "core/onboard/look_out.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/kinematics/primitives.hpp"

namespace pulseline::onboard {
namespace {

using geometry::Polygon;
using kinematics::Twist;

// In the vehicle's own time; a scanner of the class turns 40 times a second.
constexpr double kEvery_s = 0.1;
// Where its time runs fast it looks less often, to spare the machine, but never less often than
// the fields allow for (FieldOptions::reaction_s): at its speed it would run into things.
constexpr double kEveryReal_s = 0.04;
constexpr double kMostEvery_s = 0.2;
constexpr double kFreeFor_s = 1.0;  // what has left may come back
constexpr double kStart_mps = 0.2;  // of a standing vehicle that wants to go
constexpr double kStart_radps = 0.05;
// Before what bars its run: a detour keeps 0.2 m from what is seen, and what is seen is not exact.
constexpr double kRoom_m = 0.35;

Twist times(double k, const Twist& twist) {
    return {k * twist.vx_mps, k * twist.vy_mps, k * twist.turn_radps};
}

control::FieldAnswer stopped_by(control::FieldAnswer answer) {
    answer.verdict = control::FieldAnswer::Verdict::kStop;
    answer.speed_share = answer.speed_mps = 0;
    return answer;
}

bool still(const Twist& twist) {
    return twist.vx_mps == 0 && twist.vy_mps == 0 && twist.turn_radps == 0;
}

}  // namespace

LookOut::LookOut(Scanners& scanners, bool loaded, Drive& drive)
    : scanners_(scanners), drive_(drive) {
    carry(loaded);
}

void LookOut::carry(bool loaded) {
    fields_.clear();
    for (const Polygon& piece : plant::outline_with_load(drive_.type(), loaded)) {
        fields_.emplace_back(drive_.type(), piece);
    }
}

/// With which it would begin to drive its segment from here, in its own time.
Twist LookOut::start_twist() const {
    const auto* segment = drive_.current();
    if (segment == nullptr) return {};
    const bool on_the_spot = segment->kind == kinematics::Segment::Kind::kRotate;
    const double way_m = std::abs(segment->length_m);
    const double share = on_the_spot || way_m == 0 ? 0 : drive_.distance_on_segment_m() / way_m;
    return times(on_the_spot ? kStart_radps : kStart_mps, kinematics::twist_along(*segment, share));
}

/// What the vehicle does, or would begin to do.
Twist LookOut::intended() const {
    if (drive_.current() == nullptr || drive_.standing()) return start_twist();
    return times(1 / drive_.time_factor(), drive_.twist());
}

double LookOut::stopping_m(const Twist& twist) const {
    const double speed_mps = std::hypot(twist.vx_mps, twist.vy_mps);
    return speed_mps * control::FieldOptions{}.reaction_s +
           speed_mps * speed_mps / (2 * drive_.type().max_accel_mps2);
}

control::FieldAnswer LookOut::check(const Twist& twist) {
    control::FieldAnswer worst;
    for (const auto& scan : scans_) {
        for (auto& field : fields_) {
            const auto answer = field.check(scan, twist);
            if (answer.speed_share < worst.speed_share) worst = answer;
        }
    }
    return worst;
}

control::FieldAnswer LookOut::look() {
    const Twist twist = intended();
    if (still(twist)) return {};
    ++looks_;
    scanners_.scan(scans_);
    blind_ = std::ranges::any_of(scans_, &control::Scan::blind);
    if (blind_) return stopped_by({});
    auto answer = check(twist);
    const double run_m = drive_.run_ahead_m();
    if (!keeps_room_ || run_m == 0) return answer;
    if (answer.nearest && answer.way_m < run_m && answer.way_m < stopping_m(twist) + kRoom_m) {
        return stopped_by(answer);
    }
    // At the speed of a start the fields reach farther than the room to keep, however slow it is.
    const auto ahead = check(start_twist());
    const bool meets = ahead.nearest && ahead.way_m < std::min(kRoom_m, run_m);
    return meets ? stopped_by(ahead) : answer;
}

void LookOut::step(double dt_s) {
    free_for_s_ += dt_s * drive_.time_factor();
    until_scan_s_ -= dt_s;
    if (until_scan_s_ > 0) return;
    const double factor = drive_.time_factor();
    until_scan_s_ = std::max(kEvery_s / factor, std::min(kEveryReal_s, kMostEvery_s / factor));
    last_ = look();
    const bool stop = told_to_bar_ || last_.verdict == control::FieldAnswer::Verdict::kStop;
    if (stop) free_for_s_ = 0;
    const bool barred = stop || (barred_ && free_for_s_ < kFreeFor_s);
    changed_ |= barred != barred_;
    barred_ = barred;
    drive_.slow_to(speed_share());
}

bool LookOut::take_changed() { return std::exchange(changed_, false); }

void LookOut::write_state(vda5050::StateMessage& state) const {
    if (!barred_) return;
    state.field_violation = true;
    if (blind_) {
        state.errors.push_back(
            {kBlind, false, "a scanner cannot see: clean its window; then it goes on", {}});
        return;
    }
    char where[64] = "";
    if (last_.nearest) {
        std::snprintf(where, sizeof where, " %.2f m ahead and %.2f m to the left of its centre",
                      last_.nearest->x_m, last_.nearest->y_m);
    }
    state.errors.push_back(
        {kObstacle,
         false,
         std::string("something stands in the way") + where + "; it goes on when the way is free",
         {}});
}

}  // namespace pulseline::onboard
