#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "server/agent/vehicle.hpp"
#include "server/base/log.hpp"

/// How a vehicle knows where it is.
namespace pulseline::agent {
namespace {

constexpr double kOwnStep_s = 0.1;

}  // namespace

double Vehicle::most_step_s() const {
    if (light_ && light_->steers()) return onboard::LightWatch::kFineStep_s;
    return watch_.expects_soon() ? onboard::MarkerWatch::kFineStep_s : kOwnStep_s;
}

void Vehicle::know_pose(double dt_s) {
    rest_watch_.step();
    estimate_.fixes().step(dt_s);
    if (const auto fix = stop_senses_.take_fix()) {
        estimate_.take(*fix);
    } else {
        estimate_.drive_to(drive_.believed_pose());
    }
    static const std::deque<vda5050::OrderEdge> kNone;
    const bool on_way = !executor_.acting() && !executor_.in_hand();
    const std::string refused = watch_.refused();
    const std::string mistimed = watch_.mistimed();
    const std::size_t missed = watch_.segments().missed().size();
    watch_.step(dt_s, on_way ? executor_.way_ahead().edges() : kNone);
    executor_.note_codes(watch_.take_taken());
    if (refused != watch_.refused() && !watch_.refused().empty()) log_refused();
    state_due_ |= mistimed != watch_.mistimed();
    state_due_ |= refused != watch_.refused() || missed != watch_.segments().missed().size();
    const bool located = executor_.position_initialized();
    if (located) lost_ = false;
    if (light_) {
        const bool lit = light_->newest().has_value();
        light_->step(dt_s, executor_.transmitters(), located);
        state_due_ |= lit != light_->newest().has_value();
    }
    if (reflectors_) reflectors_->step(dt_s, executor_.reflectors(), located);
    if (contours_) {
        contours_->step(dt_s, located);
        // At a stop its codes tell.
        if (contours_->lost() && !executor_.acting()) {
            executor_.lose_pose({"contoursLost",
                                 true,
                                 "The scanners see through what the map has where the vehicle "
                                 "believes to stand. Say where it stands.",
                                 {}});
            lost_ = true;
        }
    }
    lead_at_rest(dt_s);
    guard_pose(dt_s);
}

/// So that it can be found out later which of the two was wrong. The sigmas are those after it,
/// with what a half believed code has added.
void Vehicle::log_refused() const {
    server::log::Fields fields{{"vehicle", vehicle_.id.str()},
                               {"order", executor_.order_id()},
                               {"code", watch_.refused()},
                               {"sigma_m", std::to_string(estimate_.sigma_xy_m())},
                               {"sigma_rad", std::to_string(estimate_.sigma_heading_rad())}};
    for (const auto& [name, value] : watch_.refused_by()) {
        fields.emplace_back(name, std::to_string(std::get<double>(value)));
    }
    server::log::warn("code.refused", fields);
}

/// At a stop the procedure leads. An order may come when its place was told a moment ago: it begins
/// when that is known well enough and the drive believes it.
void Vehicle::lead_at_rest(double dt_s) {
    const bool rests = drive_.idle() && drive_.standing() && !executor_.acting() &&
                       !executor_.in_hand() && executor_.position_initialized();
    if (rests) watch_.lead_at_rest(dt_s);
    const bool waited = executor_.waits_to_begin();
    const bool led_soon = guard_ && watch_.has_to_lead() && guard_->should_be_led(estimate_);
    executor_.hold(rests && (led_soon || (guard_ && guard_->is_vague(estimate_))));
    state_due_ |= waited != executor_.waits_to_begin();
}

/// By what the scanners see, the codes that it missed, how well it knows where it is and whether
/// the map bears it out; who drives it by hand sees that.
void Vehicle::limit_speed() {
    if (executor_.in_hand()) return;
    double share = look_out_ ? look_out_->speed_share() : 1;
    share = std::min({share, watch_.segments().speed_share(), onboard::speed_share(advice_)});
    if (contours_ && contours_->doubts()) share = std::min(share, onboard::PoseGuard::kSlowShare);
    drive_.slow_to(share);
}

/// At a stop its codes tell where it is.
void Vehicle::guard_pose(double dt_s) {
    if (!guard_) return;
    using Advice = onboard::PoseGuard::Advice;
    using Way = onboard::PoseGuard::Way;
    const bool located = executor_.position_initialized() && !executor_.acting();
    const bool by_itself = located && !executor_.in_hand();
    const Way way = by_itself && !drive_.idle()               ? Way::kUnderWay
                    : by_itself && executor_.waits_to_begin() ? Way::kToBegin
                                                              : Way::kNone;
    const Advice advice = guard_->step(dt_s * drive_.time_factor(), estimate_, way);
    state_due_ |= advice != advice_;
    advice_ = located ? advice : Advice::kDrive;
    if (advice_ != Advice::kAsk) return;
    executor_.lose_pose({"poseUncertain",
                         true,
                         "Nothing tells the vehicle well enough where it is. Measure where it "
                         "stands and say it, or drive it by hand to a code.",
                         {}});
    lost_ = true;
}

}  // namespace pulseline::agent
