#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.hpp"
#include "core/control/manoeuvre.hpp"
#include "core/kinematics/motion.hpp"

namespace pulseline::control {

/// Loop of small moves that brings a standing vehicle to a target which its cameras measure: Li
/// 2020, section 4.1, and its omnidirectional counterpart. Measure, call next(), drive what it
/// says, let the compensation learn from it, measure again.
class Adjustment {
public:
    /// `type` must outlive it.
    explicit Adjustment(const plant::VehicleType& type, const AdjustmentLimits& limits = {})
        : type_(&type), limits_(limits) {}

    /// What to drive now: segments commanded with the compensation, in the frame of the body where
    /// it stands (durations are not set); none when it is good. Errors, Errc::kUnreachable, each
    /// with the best that was measured {left_m, left_rad}: too_far_from_target (out of reach),
    /// out_of_tolerance (no pass is expected to come nearer, the passes are used up, or two of them
    /// in succession came no nearer; these two are not given up where an earlier place was better,
    /// nor outside of what is accepted while passes are left).
    Result<std::vector<kinematics::Segment>> next(const Pose2& body_from_target,
                                                  const MotionCompensation& compensation);

    /// The target seen from the best place measured; nothing before the first next().
    const std::optional<Pose2>& best() const { return best_; }
    int passes() const { return passes_; }
    bool is_good(const Pose2& body_from_target) const;
    bool is_in_reach(const Pose2& body_from_target) const;

private:
    tl::unexpected<Error> refuse(const char* reason, const char* why) const;

    const plant::VehicleType* type_;
    AdjustmentLimits limits_;
    int passes_ = 0;
    int in_vain_ = 0;
    std::optional<Pose2> best_;
};

/// The moves in the frame of the body before them, as segments one after the other; an advance and
/// a lateral move in succession are one straight.
std::vector<kinematics::Segment> segments_of(std::span<const Move> moves);
/// Back again, for MotionCompensation::learn.
std::vector<Move> moves_of(std::span<const kinematics::Segment> segments);
/// Segments given in a body's frame, in the frame in which `frame_from_body` is its pose.
std::vector<kinematics::Segment> placed(const Pose2& frame_from_body,
                                        std::vector<kinematics::Segment> segments);

}  // namespace pulseline::control
