#include "core/onboard/motion/path_reference.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/kinematics/primitives.hpp"

namespace pulseline::onboard {
namespace {

using kinematics::Segment;
using Kind = kinematics::Segment::Kind;

constexpr double kNone = 1e-6;    // metres or radians left that count as none
constexpr double kMeet_m = 0.01;  // segments whose ends lie closer are joined
constexpr double kSameDirection_rad = 2e-3;
constexpr double kSameCentre_m = 0.02;
constexpr double kSameTurn_radpm = 2e-3;
constexpr double kCreeping_mps = 0.05;
constexpr double kDerivative = 1e-4;  // share of a segment to either side of where it is derived

double driven_size(const Segment& segment) {
    return turns_on_the_spot(segment) ? std::abs(segment.turn_rad) : std::abs(segment.length_m);
}

bool same_sign(double a, double b) { return (a >= 0) == (b >= 0); }

}  // namespace

bool turns_on_the_spot(const Segment& segment) {
    return segment.kind == Kind::kRotate ||
           (std::abs(segment.length_m) <= kNone && segment.turn_rad != 0);
}

bool continues(const Segment& a, const Segment& b) {
    if (a.kind != b.kind || distance(a.end.position(), b.start.position()) > kMeet_m ||
        std::abs(wrap(a.end.heading_rad - b.start.heading_rad)) > kSameDirection_rad) {
        return false;
    }
    if (!same_sign(a.turn_rad, b.turn_rad)) return false;
    if (a.kind == Kind::kRotate) return true;
    if (a.kind == Kind::kArc) {
        return same_sign(a.length_m, b.length_m) && distance(a.centre, b.centre) <= kSameCentre_m;
    }
    const double a_rad = a.start.heading_rad + a.direction_rad;
    const double b_rad = b.start.heading_rad + b.direction_rad;
    return std::abs(wrap(a_rad - b_rad)) <= kSameDirection_rad &&
           std::abs(a.turn_rad * b.length_m - b.turn_rad * a.length_m) <=
               kSameTurn_radpm * std::abs(a.length_m * b.length_m);
}

kinematics::Twist derivative(const Segment& segment, double s) {
    const double before = std::max(0.0, s - kDerivative);
    const double after = std::min(1.0, s + kDerivative);
    const Pose2 body{0, 0, kinematics::pose_at(segment, s).heading_rad};
    const Pose2 from = kinematics::pose_at(segment, before);
    const Pose2 to = kinematics::pose_at(segment, after);
    const auto way = inverse(body) * (to.position() - from.position());
    const double per_share = 1 / (after - before);
    return {way.x_m * per_share, way.y_m * per_share,
            wrap(to.heading_rad - from.heading_rad) * per_share};
}

PathReference::PathReference(plant::VehicleType type, double time_factor)
    : type_(std::move(type)), time_factor_(time_factor), steered_(type_, time_factor) {}

PathReference::Move PathReference::make_move(const Segment& segment, double max_speed_mps) const {
    Move move;
    move.segment = segment;
    move.size = driven_size(segment);
    Segment shape = segment;
    if (turns_on_the_spot(segment)) shape.kind = Kind::kRotate;
    move.max_rate = kinematics::max_rate(type_, shape, 0) * time_factor_;
    if (max_speed_mps > 0 && shape.kind != Kind::kRotate) {
        move.max_rate = std::min(move.max_rate, max_speed_mps);
    }
    move.max_accel = kinematics::max_accel(type_, shape) * time_factor_ * time_factor_;
    return move;
}

void PathReference::append(const Segment& segment, double max_speed_mps) {
    assert(!steered());
    queue_.push_back(make_move(segment, max_speed_mps));
}

void PathReference::append_fine(const Segment& segment) {
    Move move = make_move(segment, kCreeping_mps * time_factor_);
    move.fine = true;
    queue_.push_back(std::move(move));
}

void PathReference::steer(const Pose2& from, const kinematics::Twist& twist) {
    assert(queue_.empty());
    steered_.ask(from, twist);
    const auto [vx_mps, vy_mps, turn_radps] = steered_.asked();
    Segment way;
    way.start = steered_.pose();
    way.length_m = std::hypot(vx_mps, vy_mps);
    way.direction_rad = std::atan2(vy_mps, vx_mps);
    if (way.length_m <= kNone) way.kind = Kind::kRotate;
    if (way.kind == Kind::kRotate) way.turn_rad = turn_radps;
    way.end = way.start * Pose2{vx_mps, vy_mps, way.turn_rad};
    steered_way_ = way;
}

void PathReference::clear() {
    assert(standing());
    queue_.clear();
    steered_.drop();
}

double PathReference::remaining_m() const {
    double way = 0;
    for (const Move& move : queue_) {
        if (!turns_on_the_spot(move.segment)) way += move.size - move.done;
    }
    return way;
}

double PathReference::braking_m() const {
    if (steered()) return steered_.braking_m();
    if (queue_.empty() || turns_on_the_spot(queue_.front().segment)) return 0;
    return rate_ * rate_ / (2 * queue_.front().max_accel);
}

double PathReference::run_ahead_m() const {
    if (queue_.empty() || turns_on_the_spot(queue_.front().segment)) return 0;
    return run_ahead();
}

double PathReference::distance_on_segment_m() const {
    if (queue_.empty() || turns_on_the_spot(queue_.front().segment)) return 0;
    return queue_.front().done;
}

const Segment* PathReference::current() const {
    if (steered()) return &steered_way_;
    return queue_.empty() ? nullptr : &queue_.front().segment;
}

Pose2 PathReference::pose() const {
    if (steered()) return steered_.pose();
    const Move& move = queue_.front();
    return move.size > kNone ? kinematics::pose_at(move.segment, move.done / move.size)
                             : move.segment.start;
}

kinematics::Twist PathReference::twist_at_share(double share) const {
    if (steered()) {
        const auto [vx_mps, vy_mps, turn_radps] = steered_.asked();
        return {share * vx_mps, share * vy_mps, share * turn_radps};
    }
    return queue_.empty() ? kinematics::Twist{} : twist_at(share * queue_.front().max_rate);
}

kinematics::Twist PathReference::twist_at(double rate) const {
    if (queue_.empty() || rate == 0 || queue_.front().size <= kNone) return {};
    const Move& move = queue_.front();
    const kinematics::Twist whole = derivative(move.segment, move.done / move.size);
    const double share_per_s = rate / move.size;
    return {whole.vx_mps * share_per_s, whole.vy_mps * share_per_s, whole.turn_radps * share_per_s};
}

double PathReference::braking_way() const {
    if (steered()) return steered_.braking_m();
    return queue_.empty() ? 0 : rate_ * rate_ / (2 * queue_.front().max_accel);
}

double PathReference::run_ahead() const {
    double ahead = 0;
    for (std::size_t i = 0; i < queue_.size(); ++i) {
        if (i > 0 && !continues(queue_[i - 1].segment, queue_[i].segment)) break;
        ahead += queue_[i].size - queue_[i].done;
    }
    return ahead;
}

kinematics::Twist PathReference::twist_ahead(double way) const {
    if (steered()) return steered_.asked();
    std::size_t i = 0;
    double at = queue_[0].done + way;
    while (i + 1 < queue_.size() && at > queue_[i].size) at -= queue_[i++].size;
    const Move& move = queue_[i];
    if (move.size <= kNone) return {};
    const kinematics::Twist whole = derivative(move.segment, std::min(1.0, at / move.size));
    return {whole.vx_mps / move.size, whole.vy_mps / move.size, whole.turn_radps / move.size};
}

double PathReference::velocity_mps() const {
    if (steered()) {
        const auto& twist = steered_.twist();
        return std::copysign(std::hypot(twist.vx_mps, twist.vy_mps), twist.vx_mps);
    }
    const Segment* segment = current();
    if (segment == nullptr || turns_on_the_spot(*segment)) return 0;
    const bool backwards = segment->kind == Kind::kArc
                               ? segment->length_m < 0
                               : std::abs(wrap(segment->direction_rad)) > kPi / 2 + 1e-9;
    return backwards ? -rate_ : rate_;
}

double PathReference::turn_rate_radps() const {
    if (steered()) return steered_.twist().turn_radps;
    const Segment* segment = current();
    if (segment == nullptr || segment->turn_rad == 0) return 0;
    const double share_per_s = rate_ / std::max(driven_size(*segment), kNone);
    return segment->turn_rad * share_per_s;
}

std::span<const PathReference::Passed> PathReference::step(double h_s) {
    passed_.clear();
    if (steered()) step_steered(h_s);
    if (queue_.empty()) return passed_;
    if (queue_.front().size - queue_.front().done <= kNone) {
        finish_front({});
        return passed_;
    }
    const double accel = queue_.front().max_accel;
    const double before = rate_;
    rate_ = held_ ? std::max(0.0, rate_ - accel * h_s)
                  : std::min(rate_ + accel * h_s, allowed_rate(h_s));
    peak_rate_ = std::max(peak_rate_, rate_);
    if (rate_ > 0) {
        advance(rate_ * h_s);
    } else if (before > 0) {
        Passed stop;
        stop.from = stop.to = pose();
        stop.rests = true;
        stop.peak_rate = std::exchange(peak_rate_, 0);
        passed_.push_back(stop);
    }
    return passed_;
}

void PathReference::step_steered(double h_s) {
    const bool stood = steered_.standing();
    Passed passed;
    passed.from = steered_.pose();
    steered_.step(h_s, held_ ? 0 : rate_share_);
    passed.to = steered_.pose();
    const auto [vx_mps, vy_mps, turn_radps] = steered_.twist();
    const double speed_mps = std::hypot(vx_mps, vy_mps);
    passed.on_the_spot = speed_mps <= kNone && turn_radps != 0;
    passed.way = h_s * (passed.on_the_spot ? std::abs(turn_radps) : speed_mps);
    peak_rate_ = std::max(peak_rate_, speed_mps);
    passed.rests = steered_.standing();
    if (passed.rests) passed.peak_rate = std::exchange(peak_rate_, 0);
    if (!stood || !passed.rests) passed_.push_back(passed);
}

/// Highest rate that still obeys every limit ahead: the end of the run (rate 0) and slower moves.
double PathReference::allowed_rate(double h_s) const {
    const double accel = queue_.front().max_accel;
    // Told to go slower it brakes no harder than ever.
    double allowed =
        std::max(rate_share_ * queue_.front().max_rate, std::max(0.0, rate_ - accel * h_s));
    double ahead = queue_.front().size - queue_.front().done;
    for (std::size_t i = 1; i < queue_.size(); ++i) {
        const Move& next = queue_[i];
        if (!continues(queue_[i - 1].segment, next.segment)) break;
        allowed = std::min(allowed, std::sqrt(next.max_rate * next.max_rate + 2 * accel * ahead));
        ahead += next.size - next.done;
    }
    // The largest v with v h + v^2 / (2 a) <= ahead: after this step braking still ends in time.
    const double stopping = accel * (std::sqrt(h_s * h_s + 2 * ahead / accel) - h_s);
    return std::min(allowed, stopping);
}

void PathReference::advance(double way) {
    while (way > 0) {
        Move& move = queue_.front();
        Passed passed;
        passed.on_the_spot = turns_on_the_spot(move.segment);
        passed.fine = move.fine;
        passed.way = std::min(way, move.size - move.done);
        passed.from = kinematics::pose_at(move.segment, move.done / move.size);
        move.done += passed.way;
        passed.to = kinematics::pose_at(move.segment, std::min(1.0, move.done / move.size));
        way -= passed.way;
        if (move.size - move.done > kNone) {
            passed_.push_back(passed);
            return;
        }
        const bool goes_on = queue_.size() > 1 && continues(queue_[0].segment, queue_[1].segment);
        finish_front(passed);
        if (!goes_on) return;
    }
}

void PathReference::finish_front(Passed passed) {
    const Move done = std::move(queue_.front());
    queue_.pop_front();
    passed.on_the_spot = turns_on_the_spot(done.segment);
    passed.fine = done.fine;
    passed.finished = true;
    if (!done.fine) ++segments_done_;
    if (passed.way == 0) passed.from = passed.to = done.segment.end;
    if (queue_.empty() || !continues(done.segment, queue_.front().segment)) {
        passed.rests = true;
        passed.peak_rate = std::exchange(peak_rate_, 0);
        rate_ = 0;
    }
    passed_.push_back(passed);
}

}  // namespace pulseline::onboard
