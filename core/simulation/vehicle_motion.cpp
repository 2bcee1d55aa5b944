#include "core/simulation/vehicle_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace pulseline::simulation {
namespace {

using geometry::Point2;
using kinematics::Segment;
using Kind = kinematics::Segment::Kind;

constexpr double kDone = 1e-6;    // metres or radians left that count as none
constexpr double kMeet_m = 0.01;  // segments whose ends lie closer are joined
constexpr double kSameDirection_rad = 2e-3;
constexpr double kSameCentre_m = 0.02;
constexpr double kSubstep_s = 0.02;  // of the vehicle's own, not accelerated, time
constexpr double kConverge_m = 1.0;  // way over which a path deviation falls to 1/e
constexpr double kConverge_rad = 0.1;
constexpr double kCorrectiveSpeed_mps = 0.05;

double size_of(const Segment& segment) {
    return segment.kind == Kind::kRotate ? std::abs(segment.turn_rad) : std::abs(segment.length_m);
}

bool same_sign(double a, double b) { return (a >= 0) == (b >= 0); }

}  // namespace

bool continues(const Segment& a, const Segment& b) {
    if (a.kind != b.kind || distance(a.end.position(), b.start.position()) > kMeet_m ||
        std::abs(wrap(a.end.heading_rad - b.start.heading_rad)) > kSameDirection_rad) {
        return false;
    }
    switch (a.kind) {
        case Kind::kRotate:
            return same_sign(a.turn_rad, b.turn_rad);
        case Kind::kStraight:
            return std::abs(wrap(a.direction_rad - b.direction_rad)) <= kSameDirection_rad;
        case Kind::kArc:
            return same_sign(a.turn_rad, b.turn_rad) && same_sign(a.length_m, b.length_m) &&
                   distance(a.centre, b.centre) <= kSameCentre_m;
    }
    return false;
}

VehicleMotion::VehicleMotion(plant::VehicleType type, const Pose2& true_pose, std::uint64_t seed,
                             double time_factor, const MotionErrors& errors)
    : type_(std::move(type)),
      time_factor_(time_factor),
      errors_(errors),
      random_(seed),
      true_(true_pose),
      believed_(true_pose) {
    distance_scale_ = normal(errors_.distance_scale);
    turn_scale_ = normal(errors_.turn_scale);
    steering_bias_rad_ = normal(errors_.steering_bias_rad);
    for (std::size_t k = 0; k < fine_.size(); ++k) {
        fine_[k].scale = 1 + normal(errors_.fine_scale);
        fine_[k].offset = normal(k == 2 ? errors_.fine_offset_rad : errors_.fine_offset_m);
    }
}

/// No move comes to less than nothing.
double VehicleMotion::FineError::share_of(double size) const {
    if (std::abs(size) <= kDone) return 1;
    return std::max(0.0, scale + offset / std::abs(size));
}

VehicleMotion::Move VehicleMotion::make_move(const Segment& segment, double max_speed_mps) const {
    Move move;
    move.segment = segment;
    move.size = size_of(segment);
    const double turn_rate = type_.max_turn_rate_radps * time_factor_;
    const double turn_accel = type_.max_turn_accel_radps2 * time_factor_ * time_factor_;
    if (segment.kind == Kind::kRotate) {
        move.max_rate = turn_rate;
        move.max_accel = turn_accel;
        return move;
    }
    move.max_rate = type_.max_speed_mps * time_factor_;
    if (max_speed_mps > 0) move.max_rate = std::min(move.max_rate, max_speed_mps);
    move.max_accel = type_.max_accel_mps2 * time_factor_ * time_factor_;
    if (segment.kind == Kind::kArc) {
        const double radius_m = distance(segment.start.position(), segment.centre);
        move.max_rate = std::min(move.max_rate, turn_rate * radius_m);
        move.max_accel = std::min(move.max_accel, turn_accel * radius_m);
    }
    return move;
}

void VehicleMotion::append(const Segment& segment, double max_speed_mps) {
    queue_.push_back(make_move(segment, max_speed_mps));
}

void VehicleMotion::correct(std::span<const Segment> moves) {
    assert(idle());
    for (const Segment& segment : moves) {
        Move move = make_move(segment, kCorrectiveSpeed_mps * time_factor_);
        move.corrective = true;
        const double length_m = std::abs(segment.length_m);
        move.true_share = {fine_[0].share_of(length_m * std::cos(segment.direction_rad)),
                           fine_[1].share_of(length_m * std::sin(segment.direction_rad)),
                           fine_[2].share_of(segment.turn_rad)};
        queue_.push_back(std::move(move));
    }
}

void VehicleMotion::clear() {
    assert(standing());
    queue_.clear();
}

double VehicleMotion::remaining_m() const {
    double way = 0;
    for (const Move& move : queue_) {
        if (move.segment.kind != Kind::kRotate) way += move.size - move.done;
    }
    return way;
}

double VehicleMotion::braking_m() const {
    if (queue_.empty() || queue_.front().segment.kind == Kind::kRotate) return 0;
    return speed_ * speed_ / (2 * queue_.front().max_accel);
}

double VehicleMotion::distance_on_segment_m() const {
    if (queue_.empty() || queue_.front().segment.kind == Kind::kRotate) return 0;
    return queue_.front().done;
}

const Segment* VehicleMotion::current() const {
    return queue_.empty() ? nullptr : &queue_.front().segment;
}

double VehicleMotion::velocity_mps() const {
    const Segment* segment = current();
    if (segment == nullptr || segment->kind == Kind::kRotate) return 0;
    const bool backwards = segment->kind == Kind::kArc
                               ? segment->length_m < 0
                               : std::abs(wrap(segment->direction_rad)) > kPi / 2 + 1e-9;
    return backwards ? -speed_ : speed_;
}

double VehicleMotion::turn_rate_radps() const {
    const Segment* segment = current();
    if (segment == nullptr || segment->kind == Kind::kStraight) return 0;
    const double share_per_s = speed_ / std::max(size_of(*segment), kDone);
    return segment->turn_rad * share_per_s;
}

void VehicleMotion::step(double dt_s) {
    // Fine enough in the vehicle's own time, however much faster than that it runs.
    const int substeps = std::max(1, static_cast<int>(std::ceil(dt_s * time_factor_ / kSubstep_s)));
    for (int i = 0; i < substeps && !queue_.empty(); ++i) substep(dt_s / substeps);
}

void VehicleMotion::substep(double h_s) {
    if (queue_.front().size - queue_.front().done <= kDone) {
        finish_front();
        return;
    }
    const double accel = queue_.front().max_accel;
    const double before = speed_;
    speed_ = held_ ? std::max(0.0, speed_ - accel * h_s)
                   : std::min(speed_ + accel * h_s, allowed_rate(h_s));
    peak_speed_ = std::max(peak_speed_, speed_);
    if (speed_ == 0) {
        if (before > 0) settle();
        return;
    }
    advance(speed_ * h_s);
}

/// Highest rate that still obeys every limit ahead: the end of the run (rate 0) and slower moves.
double VehicleMotion::allowed_rate(double h_s) const {
    const double accel = queue_.front().max_accel;
    double allowed = queue_.front().max_rate;
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

void VehicleMotion::advance(double way) {
    while (way > 0) {
        Move& move = queue_.front();
        const double here = std::min(way, move.size - move.done);
        if (here > 0) displace(move, here);
        way -= here;
        if (move.size - move.done > kDone) return;
        const bool goes_on = queue_.size() > 1 && continues(queue_[0].segment, queue_[1].segment);
        finish_front();
        if (!goes_on) return;
    }
}

/// Moves the believed pose along the path, steering out its deviation from it, and the true pose by
/// the same motion with the vehicle's errors.
void VehicleMotion::displace(Move& move, double way) {
    const Segment& segment = move.segment;
    const Pose2 from = kinematics::pose_at(segment, move.done / move.size);
    move.done += way;
    const Pose2 to = kinematics::pose_at(segment, std::min(1.0, move.done / move.size));
    const Pose2 driven = believed_ * (inverse(from) * to);

    const bool turning = segment.kind == Kind::kRotate;
    const double gain = 1 - std::exp(-way / (turning ? kConverge_rad : kConverge_m));
    Pose2 next = driven;
    if (!turning) {
        next.x_m += gain * (to.x_m - driven.x_m);
        next.y_m += gain * (to.y_m - driven.y_m);
    }
    next.heading_rad = wrap(driven.heading_rad + gain * wrap(to.heading_rad - driven.heading_rad));

    Pose2 motion = inverse(believed_) * next;
    believed_ = next;
    if (move.corrective) {
        const auto [ahead, sideways, turned] = move.true_share;
        true_ =
            true_ * Pose2{ahead * motion.x_m, sideways * motion.y_m, turned * motion.heading_rad};
        return;
    }
    const double way_m = norm(motion.position());
    const double root_m = std::sqrt(way_m);
    const Point2 slip{normal(errors_.slip_m_per_sqrt_m) * root_m,
                      normal(errors_.slip_m_per_sqrt_m) * root_m};
    const double wander_rad =
        normal(errors_.heading_rad_per_sqrt_m) * root_m +
        normal(errors_.heading_rad_per_sqrt_rad) * std::sqrt(std::abs(motion.heading_rad));
    const Pose2 steered =
        Pose2{0, 0, steering_bias_rad_} *
        Pose2{motion.x_m * (1 + distance_scale_), motion.y_m * (1 + distance_scale_), 0};
    true_ = true_ * Pose2{steered.x_m + slip.x_m, steered.y_m + slip.y_m,
                          motion.heading_rad * (1 + turn_scale_) + wander_rad};
}

void VehicleMotion::finish_front() {
    const Move done = std::move(queue_.front());
    queue_.pop_front();
    if (done.corrective) {
        true_ = true_ * (done.segment.kind == Kind::kRotate
                             ? Pose2{0, 0, normal(errors_.fine_rad)}
                             : Pose2{normal(errors_.fine_m), normal(errors_.fine_m), 0});
    } else {
        ++segments_done_;
    }
    if (queue_.empty() || !continues(done.segment, queue_.front().segment)) {
        if (!done.corrective && done.segment.kind != Kind::kRotate) settle();
        speed_ = 0;
        peak_speed_ = 0;
    }
}

/// Braking shakes the platform a little, the more the faster it was.
void VehicleMotion::settle() {
    const double share = std::min(1.0, peak_speed_ / (type_.max_speed_mps * time_factor_));
    true_ = true_ * Pose2{share * normal(errors_.settle_m), share * normal(errors_.settle_m),
                          share * normal(errors_.settle_rad)};
    peak_speed_ = 0;
}

}  // namespace pulseline::simulation
