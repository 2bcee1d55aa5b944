#include "core/control/manoeuvre.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/kinematics/wheels.hpp"

namespace pulseline::control {
namespace {

using geometry::Point2;

// Moves below the spread of any move are not worth making.
constexpr double kLeastMove_m = kRepeatability_m / 2;
constexpr double kLeastTurn_rad = kRepeatability_rad / 2;
// Ways that lie more askew than that are a turn towards the target and a straight.
constexpr double kMostAskew_rad = radians(30.0);
constexpr int kHeadings = 11;
// With 0.1 m and 1 deg of reach a pass mends 3.5 mm of up to 0.1 m.
constexpr std::array<double, 7> kSharesOfSideways{1, 0.75, 0.5, 0.25, 0.12, 0.06, 0.03};

Point2 direction(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }

void add(std::vector<Move>& moves, MoveKind kind, double size) {
    if (std::abs(size) >= least_size(kind)) moves.push_back({kind, size});
}

/// A straight way of the body's centre along a heading, backwards when negative.
struct Way {
    double heading_rad = 0;
    double length_m = 0;
};

class Search {
public:
    Search(const Pose2& target, const AdjustmentLimits& limits,
           const MotionCompensation& compensation)
        : target_(target), limits_(limits), compensation_(compensation) {
        best_ = {{}, target, badness_of(target, limits)};
        if (is_outside(target, limits)) best_.badness = std::numeric_limits<double>::infinity();
    }

    /// All of it, or parts: a shift alone where a turn would spoil more than it mends.
    void shift_and_turn() {
        for (unsigned parts = 1; parts < 8; ++parts) {
            std::vector<Move> moves;
            if (parts & 1) add(moves, MoveKind::kAdvance, target_.x_m);
            if (parts & 2) add(moves, MoveKind::kLateral, target_.y_m);
            if (parts & 4) add(moves, MoveKind::kTurn, target_.heading_rad);
            offer(std::move(moves));
        }
    }

    void rotate_advance_rotate() {
        const double bearing_rad = std::atan2(target_.y_m, target_.x_m);
        try_way(0);
        try_way(target_.heading_rad);
        try_way(bearing_rad);
        try_way(wrap(bearing_rad + kPi));
        const double spread_rad = std::min(limits_.reach_rad, kMostAskew_rad);
        const auto heading = [&](int i) {
            return target_.heading_rad + spread_rad * (2.0 * i / (kHeadings - 1) - 1);
        };
        for (int i = 0; i < kHeadings; ++i) {
            try_way(heading(i));
            try_two(0, heading(i));
            for (int k = 0; k < kHeadings; ++k) try_two(heading(i), heading(k));
        }
    }

    Manoeuvre take() { return std::move(best_); }

private:
    bool may_head(double heading_rad) const {
        return std::abs(wrap(heading_rad - target_.heading_rad)) <= limits_.reach_rad + 1e-12;
    }

    /// One way along a heading as far as brings it nearest to the target.
    void try_way(double heading_rad) {
        offer_ways({{heading_rad, dot(target_.position(), direction(heading_rad))}});
    }

    /// Two ways that end at the target, or as far to its side as goes.
    void try_two(double first_rad, double second_rad) {
        const Point2 first = direction(first_rad);
        const Point2 second = direction(second_rad);
        const double turned = cross(first, second);
        if (std::abs(turned) < 1e-4) return;
        const Point2 ahead = direction(target_.heading_rad);
        const double along_m = dot(target_.position(), ahead);
        const double sideways_m = cross(ahead, target_.position());
        for (const double share : kSharesOfSideways) {
            const Point2 to = along_m * ahead + share * sideways_m * Point2{-ahead.y_m, ahead.x_m};
            const double first_m = cross(to, second) / turned;
            const double second_m = cross(first, to) / turned;
            if (distance(first_m * first, target_.position()) > limits_.reach_m) continue;
            offer_ways({{first_rad, first_m}, {second_rad, second_m}});
            return;
        }
    }

    void offer_ways(std::initializer_list<Way> ways) {
        std::vector<Move> moves;
        double heading_rad = 0;
        const auto turn_to = [&](double to_rad) {
            const double turn_rad = wrap(to_rad - heading_rad);
            if (std::abs(turn_rad) < kLeastTurn_rad) return;
            add(moves, MoveKind::kTurn, turn_rad);
            heading_rad = to_rad;
        };
        for (const Way& way : ways) {
            if (std::abs(way.length_m) < kLeastMove_m) continue;
            if (!may_head(way.heading_rad)) return;
            turn_to(way.heading_rad);
            add(moves, MoveKind::kAdvance, way.length_m);
        }
        turn_to(target_.heading_rad);
        offer(std::move(moves));
    }

    void offer(std::vector<Move> moves) {
        if (moves.empty()) return;
        Pose2 end;
        for (const Move& move : moves) {
            const bool turn = move.kind == MoveKind::kTurn;
            const bool lateral = move.kind == MoveKind::kLateral;
            end = end * Pose2{turn || lateral ? 0 : move.size, lateral ? move.size : 0,
                              turn ? move.size : 0};
        }
        const Pose2 leaves = inverse(end) * target_;
        const PoseError error = compensation_.expected_error(moves);
        const double badness = badness_of(leaves, limits_) +
                               badness_of({error.position_m, 0, error.heading_rad}, limits_);
        if (badness < best_.badness) best_ = {std::move(moves), leaves, badness};
    }

    const Pose2 target_;
    const AdjustmentLimits& limits_;
    const MotionCompensation& compensation_;
    Manoeuvre best_;
};

}  // namespace

double badness_of(const Pose2& body_from_target, const AdjustmentLimits& limits) {
    const double position = norm(body_from_target.position()) / limits.good_m;
    const double heading = body_from_target.heading_rad / limits.good_rad;
    return position * position + heading * heading;
}

bool is_outside(const Pose2& body_from_target, const AdjustmentLimits& limits) {
    return (limits.accept_m > 0 && norm(body_from_target.position()) > limits.accept_m) ||
           (limits.accept_rad > 0 && std::abs(body_from_target.heading_rad) > limits.accept_rad);
}

double least_size(MoveKind kind) { return kind == MoveKind::kTurn ? kLeastTurn_rad : kLeastMove_m; }

bool moves_sideways(const plant::VehicleType& type) {
    return type.kinematics != plant::Kinematics::kDifferential &&
           kinematics::wheels_of(type, {0, 0.1, 0}).has_value();
}

Manoeuvre best_manoeuvre(const plant::VehicleType& type, const Pose2& body_from_target,
                         const AdjustmentLimits& limits, const MotionCompensation& compensation) {
    Search search(body_from_target, limits, compensation);
    if (moves_sideways(type)) {
        search.shift_and_turn();
    } else {
        search.rotate_advance_rotate();
    }
    return search.take();
}

}  // namespace pulseline::control
