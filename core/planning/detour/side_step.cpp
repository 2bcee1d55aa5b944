#include "core/planning/detour/side_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/bearing.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr double kBeside_m = 0.1;  // between two distances from the line that are tried
constexpr double kBackOff_m = 0.5;
constexpr int kBackOffs = 2;  // where it stands too near to shift aside
constexpr int kSlopes = 6;    // of a shift: up to kSlopes * kSlope ahead a metre aside
constexpr double kSlope = 0.5;
constexpr double kHeading_rad = radians(0.3);  // 3 cm at the ends of a platform; tracking takes it
constexpr double kNoMove_m = 1e-3;

class SideStep {
public:
    SideStep(const DetourGround& ground, const Pose2& start, double goal_m)
        : ground_(ground),
          start_(start),
          aligned_{start.x_m, start.y_m, ground.heading_rad()},
          goal_{goal_m, 0},
          room_(ground.room(start, ground.on_line(goal_m))) {}

    std::optional<Moves> plan() const {
        if (goal_.x_m <= start_.x_m || !is_free(turned(), aligned_)) return std::nullopt;
        for (const double y_m : beside()) {
            for (int back = 0; back <= kBackOffs; ++back) {
                const double from_m = start_.x_m - back * kBackOff_m;
                if (back > 0 && from_m < 0) break;
                if (auto moves = pass(y_m, from_m)) return moves;
            }
        }
        return std::nullopt;
    }

private:
    /// Distances from the line to try, those first that take the least way.
    std::vector<double> beside() const {
        std::vector<double> tried{start_.y_m};
        for (int k = 0; k * kBeside_m < ground_.most_left_m(); ++k) tried.push_back(k * kBeside_m);
        for (int k = 1; k * kBeside_m < ground_.most_right_m(); ++k)
            tried.push_back(-k * kBeside_m);
        tried.push_back(ground_.most_left_m());
        tried.push_back(-ground_.most_right_m());
        std::stable_sort(tried.begin(), tried.end(), [&](double a, double b) {
            return std::abs(a - start_.y_m) + std::abs(a) < std::abs(b - start_.y_m) + std::abs(b);
        });
        return tried;
    }

    /// With the steepest shifts first: where these are barred, all are.
    std::optional<Moves> pass(double y_m, double from_m) const {
        const Point2 start = start_.position();
        Point2 out{from_m, y_m};
        Point2 in{goal_.x_m, y_m};
        if (!is_free(start, out) || !is_free(out, in) || !is_free(in, goal_)) return std::nullopt;
        for (int k = kSlopes; k > 0; --k) {
            const Point2 flatter{start.x_m + k * kSlope * std::abs(y_m - start.y_m), y_m};
            if (flatter.x_m > in.x_m || !is_free(start, flatter)) continue;
            out = flatter;
            break;
        }
        for (int k = kSlopes; k > 0; --k) {
            const Point2 flatter{goal_.x_m - k * kSlope * std::abs(y_m), y_m};
            if (flatter.x_m < out.x_m || !is_free(flatter, goal_)) continue;
            in = flatter;
            break;
        }
        Moves moves = turned();
        for (const auto& [from, to] : {std::pair{start, out}, {out, in}, {in, goal_}}) {
            if (geometry::distance(from, to) >= kNoMove_m) moves.push_back(move(from, to));
        }
        return moves;
    }

    /// Into the line's heading, when it stands visibly askew.
    Moves turned() const {
        const double turn_rad = wrap(aligned_.heading_rad - start_.heading_rad);
        if (std::abs(turn_rad) <= kHeading_rad) return {};
        return {{.kind = kinematics::Segment::Kind::kRotate, .amount = turn_rad}};
    }
    Move move(Point2 from, Point2 to) const {
        return {.amount = distance(from, to),
                .direction_rad =
                    geometry::move_direction_rad({from.x_m, from.y_m, aligned_.heading_rad}, to)};
    }
    bool is_free(Point2 from, Point2 to) const {
        if (geometry::distance(from, to) < kNoMove_m) return true;
        return is_free(Moves{move(from, to)}, {from.x_m, from.y_m, aligned_.heading_rad});
    }
    bool is_free(const Moves& moves, const Pose2& from) const {
        if (moves.empty()) return true;
        return !room_.conflict_along(segments_of(from, moves, moved(from, moves.back())));
    }

    const DetourGround& ground_;
    Pose2 start_;
    Pose2 aligned_;
    Point2 goal_;
    ManoeuvreRoom room_;
};

}  // namespace

std::optional<Moves> side_step(const DetourGround& ground, const Pose2& start, double goal_m) {
    return SideStep(ground, start, goal_m).plan();
}

}  // namespace pulseline::planning
