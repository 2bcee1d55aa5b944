#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/result.hpp"
#include "core/geometry/pose2.hpp"

namespace pulseline::control {

using geometry::Pose2;

enum class MoveKind { kAdvance, kLateral, kTurn };

/// One small move: metres along body x (advance) or y (lateral), or radians on the spot; signed.
struct Move {
    MoveKind kind = MoveKind::kAdvance;
    double size = 0;
    bool operator==(const Move&) const = default;
};

/// Moves commanded one after the other, and what they came to.
struct DrivenPass {
    std::vector<Move> moves;
    Pose2 measured;        // body after the moves, seen from the body before them
    double sigma_m = 0;    // of `measured`, one sigma
    double sigma_rad = 0;  // of its heading
    bool operator==(const DrivenPass&) const = default;
};

/// What a kind of move comes to: driven = gain x commanded + offset, both along the command. A
/// positive offset is coasting, a negative one lost motion. SI units.
struct MoveLine {
    double gain = 1;
    double offset = 0;
    double sigma_gain = 0;
    double sigma_offset = 0;
};

/// Expected error of a pose, one sigma; position over both axes together.
struct PoseError {
    double position_m = 0;
    double heading_rad = 0;
};

/// Motion compensation of Li 2020, section 4.3: moves are commanded by so much more or less as the
/// vehicle is known to drive too short or too far, by a line for each kind of move. Li measures
/// single moves with a laser tracker beforehand; here the lines are learned from the adjustments
/// themselves. A pass of several moves is measured only before and after, so the lines are fitted
/// together: least squares over the last passes, with a weak expectation of a perfect vehicle, and
/// passes far from what the others agree on lose their weight (one outlier does not spoil it).
/// A kind moved fewer than three times is not compensated.
class MotionCompensation {
public:
    MotionCompensation();
    /// From stored passes(). Fails, Errc::kInvalid: bad_compensation {index}, when a number is not
    /// finite, a sigma is negative or a pass has no moves.
    static Result<MotionCompensation> restored(std::vector<DrivenPass> passes);

    /// Takes a pass into account; the oldest is forgotten. Same errors as restored().
    Status learn(DrivenPass pass);

    const MoveLine& line(MoveKind kind) const { return lines_[static_cast<std::size_t>(kind)]; }
    /// What to command so that the move comes to `wanted`; by at most the bounds below off it, and
    /// never in the other direction.
    double commanded(MoveKind kind, double wanted) const;
    /// How far from its aim a pass of these moves (each as wanted) ends: what the lines leave open
    /// and what no move repeats.
    PoseError expected_error(std::span<const Move> wanted) const;

    /// All there is to store; newest last.
    const std::vector<DrivenPass>& passes() const { return passes_; }

private:
    void fit();

    std::vector<DrivenPass> passes_;
    std::array<MoveLine, 3> lines_;
    Eigen::Matrix<double, 6, 6> covariance_;  // gain, offset of each kind in turn
};

/// Bounds of what is compensated: beyond them something is broken, not inexact.
constexpr double kMostGain = 1.25;  // and its inverse
constexpr double kMostOffset_m = 0.005;
constexpr double kMostOffset_rad = radians(1.5);
/// Spread of a creeping move that nothing explains, one sigma.
constexpr double kRepeatability_m = 2e-4;
constexpr double kRepeatability_rad = 1e-4;

}  // namespace pulseline::control
