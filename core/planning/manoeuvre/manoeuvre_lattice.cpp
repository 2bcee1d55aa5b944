#include "core/planning/manoeuvre/manoeuvre_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_map>

namespace pulseline::planning {
namespace {

using geometry::Pose2;
using Kind = kinematics::Segment::Kind;

constexpr double kTurnStep_rad = kPi / 8;
constexpr double kLeastStep_m = 0.5;
constexpr int kHeadings = 24;
constexpr double kGreed = 1.4;  // weight of what is left against what is done
// With a way known, looking for a better one is worth so many tests and a part of those before.
constexpr long kLeastMoreWork = 3000;
constexpr long kMoreWork = 4;

struct Node {
    Pose2 pose;
    Move move;  // that led here
    int parent = -1;
    double done_m = 0;
    double left_m = 0;  // about
};

std::vector<Move> steps_of(const Steering& steering, double step_m, double turn_rad) {
    std::vector<Move> steps;
    for (const double way : {1.0, -1.0}) {
        for (const double length : {step_m, 3 * step_m}) steps.push_back({.amount = way * length});
        for (const double side : {1.0, -1.0}) {
            steps.push_back({.kind = Kind::kArc,
                             .amount = way * step_m,
                             .curvature = side / steering.radius_m()});
        }
        if (steering.turns_on_the_spot()) {
            steps.push_back({.kind = Kind::kRotate, .amount = way * turn_rad});
        }
        if (steering.any_direction()) {
            for (const double length : {step_m, 3 * step_m}) {
                steps.push_back({.amount = length, .direction_rad = way * kPi / 2});
            }
        }
    }
    return steps;
}

class Lattice {
public:
    Lattice(const ManoeuvreTask& task, const DiscDistances& left, int fineness)
        : task_(task),
          left_(left),
          headings_(kHeadings * fineness),
          step_m_(std::max(kTurnStep_rad * task.steering.radius_m(), kLeastStep_m) / fineness),
          steps_(steps_of(task.steering, step_m_, kTurnStep_rad / fineness)) {}

    Moves search(const LatticeLimits& limits) {
        const long first_work = task_.room.work();
        reach(task_.start, {}, -1, 0);
        double best_m = limits.below_m;
        Moves best;
        long until = std::isfinite(best_m) ? std::min(limits.work, kLeastMoreWork) : limits.work;
        while (!open_.empty() && task_.room.work() - first_work < until) {
            const auto [rank, index] = open_.top();
            open_.pop();
            if (by_cell_.at(cell_of(nodes_[index].pose)) != index) continue;  // reached cheaper
            if (nodes_[index].done_m + nodes_[index].left_m >= best_m) continue;
            const Way* way = way_to_goal(nodes_[index].pose, best_m - nodes_[index].done_m);
            if (way != nullptr) {
                const long so_far = task_.room.work() - first_work;
                until = std::min(limits.work, so_far + kLeastMoreWork + so_far / kMoreWork);
                best_m = nodes_[index].done_m + way->cost_m;
                best = moves_to(static_cast<int>(index));
                for (int i = 0; i < way->count; ++i) {
                    append(best, way->moves[static_cast<std::size_t>(i)]);
                }
            }
            expand(index);
        }
        return best;
    }

private:
    using Rank = std::pair<double, long>;  // both negative: the queue gives the greatest first

    const Way* way_to_goal(const Pose2& pose, double below_m) {
        task_.steering.ways(pose, task_.goal, ways_);
        task_.room.add_work(kWaysWork);
        for (std::size_t i = 0; i < std::min(kWaysTried, ways_.size()); ++i) {
            if (ways_[i].cost_m >= below_m) break;
            if (task_.room.is_free(pose, ways_[i])) return &ways_[i];
        }
        return nullptr;
    }

    void expand(std::size_t index) {
        for (const Move& step : steps_) {
            const Node from = nodes_[index];
            const Pose2 to = moved(from.pose, step);
            double done = from.done_m + task_.steering.cost_m(step);
            if (from.parent >= 0 && !same_motion(from.move, step)) done += Steering::kStop_m;
            const auto known = by_cell_.find(cell_of(to));
            if (known != by_cell_.end() && nodes_[known->second].done_m <= done) continue;
            if (!task_.room.is_free(from.pose, step)) continue;
            reach(to, step, static_cast<int>(index), done);
        }
    }

    void reach(const Pose2& pose, const Move& move, int parent, double done_m) {
        const double left_m = left_from(pose);
        task_.room.add_work(kWaysWork);
        if (!std::isfinite(left_m)) return;
        const std::size_t index = nodes_.size();
        nodes_.push_back({pose, move, parent, done_m, left_m});
        by_cell_[cell_of(pose)] = index;
        open_.push({{-(done_m + kGreed * left_m), -static_cast<long>(index)}, index});
    }

    /// What is left from a pose, about. A body that moves in any direction turns where it likes, so
    /// its turn comes on top of the way round the obstacles.
    double left_from(const Pose2& pose) const {
        double round_m = left_.from(pose.position());
        if (task_.steering.any_direction()) {
            round_m += task_.steering.cost_m(
                {.kind = Kind::kRotate, .amount = wrap(task_.goal.heading_rad - pose.heading_rad)});
        }
        return std::max(round_m, task_.steering.least_cost_m(pose, task_.goal));
    }

    std::uint64_t cell_of(const Pose2& pose) const {
        const auto slot = [](double v) {
            return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v)) + (1 << 20));
        };
        const double share = (pose.heading_rad + kPi) / (2 * kPi);
        const auto heading = static_cast<std::uint64_t>(share * headings_ + 0.5) %
                             static_cast<std::uint64_t>(headings_);
        return (slot(2 * pose.x_m / step_m_) << 32) ^ (slot(2 * pose.y_m / step_m_) << 8) ^ heading;
    }

    Moves moves_to(int index) const {
        Moves moves;
        for (int i = index; nodes_[static_cast<std::size_t>(i)].parent >= 0;
             i = nodes_[static_cast<std::size_t>(i)].parent) {
            moves.push_back(nodes_[static_cast<std::size_t>(i)].move);
        }
        Moves joined;
        for (auto it = moves.rbegin(); it != moves.rend(); ++it) append(joined, *it);
        return joined;
    }

    const ManoeuvreTask& task_;
    const DiscDistances& left_;
    int headings_;
    double step_m_;
    std::vector<Move> steps_;
    std::vector<Node> nodes_;
    std::unordered_map<std::uint64_t, std::size_t> by_cell_;
    std::priority_queue<std::pair<Rank, std::size_t>> open_;
    std::vector<Way> ways_;
};

}  // namespace

Moves lattice_search(const ManoeuvreTask& task, const DiscDistances& left, int fineness,
                     const LatticeLimits& limits) {
    return Lattice(task, left, fineness).search(limits);
}

}  // namespace pulseline::planning
