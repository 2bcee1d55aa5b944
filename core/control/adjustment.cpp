#include "core/control/adjustment.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "core/kinematics/primitives.hpp"

namespace pulseline::control {
namespace {

using geometry::Point2;
using kinematics::Segment;

constexpr int kMostInVain = 2;
constexpr int kMostPasses = 2;  // times passes_outside, while each comes nearer
// How much worse than the best it may stand when it gives up: what no move repeats.
constexpr double kNearlyBest = 1.5;

}  // namespace

bool Adjustment::is_good(const Pose2& off) const {
    return norm(off.position()) <= limits_.good_m && std::abs(off.heading_rad) <= limits_.good_rad;
}

bool Adjustment::is_in_reach(const Pose2& off) const {
    return norm(off.position()) <= limits_.reach_m &&
           std::abs(off.heading_rad) <= limits_.reach_rad;
}

Result<std::vector<Segment>> Adjustment::next(const Pose2& body_from_target,
                                              const MotionCompensation& compensation) {
    const double badness = badness_of(body_from_target, limits_);
    const bool better = !best_ || badness < badness_of(*best_, limits_);
    in_vain_ = better ? 0 : in_vain_ + 1;
    if (better) best_ = body_from_target;

    if (is_good(body_from_target)) return std::vector<Segment>{};
    if (!is_in_reach(body_from_target)) {
        return refuse("too_far_from_target", "the target is out of reach of small moves");
    }
    const bool outside = is_outside(body_from_target, limits_);
    // A shunt within its reach moves it aside by 3 mm at most: who arrives 30 mm off has far to go.
    const bool comes_nearer = outside && better && passes_ < kMostPasses * limits_.passes_outside;
    if (passes_ >= (outside ? limits_.passes_outside : limits_.passes) && !comes_nearer) {
        return refuse("out_of_tolerance", "the passes are used up");
    }
    const bool nearly_best = badness <= kNearlyBest * badness_of(*best_, limits_);
    if (in_vain_ >= kMostInVain && nearly_best && !outside) {
        return refuse("out_of_tolerance", "passes come no nearer");
    }
    const Manoeuvre manoeuvre = best_manoeuvre(*type_, body_from_target, limits_, compensation);
    if (manoeuvre.moves.empty()) {
        return refuse("out_of_tolerance", "no move is expected to come nearer");
    }
    std::vector<Move> commands;
    for (const Move& move : manoeuvre.moves) {
        double size = compensation.commanded(move.kind, move.size);
        // Even where it is believed to coast farther than that: it shows whether it does.
        if (outside && size == 0) size = std::copysign(least_size(move.kind), move.size);
        commands.push_back({move.kind, size});
    }
    auto segments = segments_of(commands);
    if (segments.empty()) return refuse("out_of_tolerance", "it coasts farther than it must move");
    ++passes_;
    return segments;
}

tl::unexpected<Error> Adjustment::refuse(const char* reason, const char* why) const {
    const double left_m = norm(best_->position());
    const double left_rad = std::abs(best_->heading_rad);
    char text[96];
    std::snprintf(text, sizeof text, "%.1f mm and %.3f deg left at best: ", 1e3 * left_m,
                  degrees(left_rad));
    return fail(Errc::kUnreachable, reason, std::string(text) + why, {},
                {{"left_m", left_m}, {"left_rad", left_rad}});
}

std::vector<Segment> segments_of(std::span<const Move> moves) {
    std::vector<Segment> segments;
    Pose2 body;
    Pose2 start;  // of the straight being put together
    const auto end_straight = [&] {
        kinematics::append_straight(segments, start, body.position());
    };
    for (const Move& move : moves) {
        switch (move.kind) {
            case MoveKind::kAdvance:
                if (body != start) end_straight();
                start = body;
                body = body * Pose2{move.size, 0, 0};
                break;
            case MoveKind::kLateral:
                body = body * Pose2{0, move.size, 0};
                break;
            case MoveKind::kTurn:
                end_straight();
                if (std::abs(move.size) >= kinematics::kNothing) {
                    Segment turn;
                    turn.kind = Segment::Kind::kRotate;
                    turn.start = body;
                    body.heading_rad = wrap(body.heading_rad + move.size);
                    turn.end = body;
                    turn.turn_rad = move.size;
                    segments.push_back(turn);
                }
                start = body;
                break;
        }
    }
    end_straight();
    return segments;
}

std::vector<Move> moves_of(std::span<const Segment> segments) {
    std::vector<Move> moves;
    const auto add = [&](MoveKind kind, double size) {
        if (std::abs(size) >= kinematics::kNothing) moves.push_back({kind, size});
    };
    for (const Segment& segment : segments) {
        if (segment.kind == Segment::Kind::kRotate) {
            add(MoveKind::kTurn, segment.turn_rad);
        } else {
            add(MoveKind::kAdvance, std::abs(segment.length_m) * std::cos(segment.direction_rad));
            add(MoveKind::kLateral, std::abs(segment.length_m) * std::sin(segment.direction_rad));
        }
    }
    return moves;
}

std::vector<Segment> placed(const Pose2& frame_from_body, std::vector<Segment> segments) {
    for (Segment& segment : segments) {
        segment.start = frame_from_body * segment.start;
        segment.end = frame_from_body * segment.end;
        segment.centre = frame_from_body * segment.centre;
    }
    return segments;
}

}  // namespace pulseline::control
