#include "core/planning/legs/floor_way.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include "core/kinematics/primitives.hpp"
#include "core/planning/manoeuvre/steering.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Pose2;
using kinematics::shortest_turn_rad;

// Decides between ways of equal cost; far below what a person would call a difference.
constexpr double kTie = 1e-3;

/// Headings of the body on a straight, in the order in which equal ways are taken.
enum class Held : std::uint8_t { kAhead, kBack, kAsAtStart, kAsAtGoal };
constexpr int kHeldWays = 4;

/// Least-cost chain of straights over the points: A* whose state is the straight just driven, so
/// that turns count exactly. Whether a way is free is asked when it comes up, not before.
class ChainSearch {
public:
    ChainSearch(const LegTask& task, const GridFloor& floor, const std::vector<Point2>& points,
                double most_cost)
        : task_(task),
          floor_(floor),
          points_(points),
          most_cost_(most_cost),
          count_(static_cast<int>(points.size())),
          any_direction_(Steering(*task.request.type).any_direction()),
          tight_start_(!floor.is_free(task.request.start)),
          tight_goal_(!floor.is_free(task.station.pose)),
          pairs_(points.size() * points.size()),
          links_(pairs_.size() * kHeldWays) {
        for (int from = 0; from < count_; ++from) {
            for (int to = from + 1; to < count_; ++to) {
                const Point2 way = point(to) - point(from);
                pairs_[static_cast<std::size_t>(from * count_ + to)] = {
                    norm(way), std::atan2(way.y_m, way.x_m)};
            }
        }
    }

    std::optional<LegDraft> run() {
        expand(kStart, 0);
        while (!open_.empty()) {
            const Entry entry = open_.top();
            open_.pop();
            Link& link = links_[static_cast<std::size_t>(entry.link)];
            if (link.closed || !is_free(entry)) continue;
            link.closed = true;
            link.before = entry.before;
            if (to_of(entry.link) == count_ - 1) return draft(entry.link);
            expand(entry.link, entry.cost);
        }
        return std::nullopt;
    }

private:
    static constexpr int kStart = -1;
    enum class Room : std::uint8_t { kUnknown, kFree, kBlocked };
    struct Pair {
        double length_m = 0;
        double travel_rad = 0;
    };
    struct Link {
        Room room = Room::kUnknown;
        bool closed = false;
        int before = kStart;
    };
    struct Entry {
        double least = 0;  // of a whole chain over it
        double cost = 0;
        int link = 0;
        int before = kStart;
        bool operator<(const Entry& other) const {
            return least != other.least ? least > other.least : link > other.link;
        }
    };

    int number_of(int from, int to, Held held) const {
        return (from * count_ + to) * kHeldWays + static_cast<int>(held);
    }
    int from_of(int link) const { return link / kHeldWays / count_; }
    int to_of(int link) const { return link == kStart ? 0 : link / kHeldWays % count_; }
    Point2 point(int i) const { return points_[static_cast<std::size_t>(i)]; }
    double length_m(int from, int to) const {
        return pairs_[static_cast<std::size_t>(from * count_ + to)].length_m;
    }
    double travel_rad(int link) const {
        return pairs_[static_cast<std::size_t>(link / kHeldWays)].travel_rad;
    }
    /// Of the body on a link.
    double heading_rad(int link) const {
        if (link == kStart) return task_.request.start.heading_rad;
        switch (static_cast<Held>(link % kHeldWays)) {
            case Held::kAhead:
                return travel_rad(link);
            case Held::kBack:
                return wrap(travel_rad(link) + kPi);
            case Held::kAsAtStart:
                return task_.request.start.heading_rad;
            case Held::kAsAtGoal:
                break;
        }
        return task_.station.pose.heading_rad;
    }

    bool is_turn_between(int before, int link) const {
        const bool body = is_turn(task_.cost, heading_rad(before), heading_rad(link));
        return body ||
               (before != kStart && is_turn(task_.cost, travel_rad(before), travel_rad(link)));
    }
    double turned_rad(int before, int link) const {
        return std::abs(shortest_turn_rad(heading_rad(before), heading_rad(link)));
    }

    void expand(int before, double cost) {
        const int from = to_of(before);
        for (int to = from + 1; to < count_; ++to) {
            const double way_m = length_m(from, to);
            if (way_m < kinematics::kNothing) continue;
            const double rest = task_.cost.k_same * length_m(to, count_ - 1);
            for (int held = 0; held < kHeldWays; ++held) {
                if (!may_hold(from, to, static_cast<Held>(held))) continue;
                const int link = number_of(from, to, static_cast<Held>(held));
                const Link& known = links_[static_cast<std::size_t>(link)];
                if (known.closed || known.room == Room::kBlocked) continue;
                const double sum = cost +
                                   edge_cost(task_.cost, way_m, is_turn_between(before, link)) +
                                   kTie * (1 + turned_rad(before, link) + last_turn_rad(link));
                if (sum + rest < most_cost_) open_.push({sum + rest, sum, link, before});
            }
        }
    }
    /// A body that moves in any direction leaves a tight place, and comes to one, without a turn.
    bool may_hold(int from, int to, Held held) const {
        if (!any_direction_) return held == Held::kAhead || held == Held::kBack;
        if (tight_start_ && from == 0) return held == Held::kAsAtStart;
        return !(tight_goal_ && to == count_ - 1) || held == Held::kAsAtGoal;
    }
    double last_turn_rad(int link) const {
        if (to_of(link) != count_ - 1) return 0;
        return std::abs(shortest_turn_rad(heading_rad(link), task_.station.pose.heading_rad));
    }

    bool is_free(const Entry& entry) {
        Room& room = links_[static_cast<std::size_t>(entry.link)].room;
        if (room == Room::kUnknown) room = is_free_link(entry.link) ? Room::kFree : Room::kBlocked;
        return room == Room::kFree && is_free_turn(from_of(entry.link), heading_rad(entry.before),
                                                   heading_rad(entry.link));
    }
    bool is_free_link(int link) const {
        const int from = from_of(link);
        const int to = to_of(link);
        const double way_m = length_m(from, to);
        const Point2 ahead = (1 / way_m) * (point(to) - point(from));
        // The fast test asks for more than the clearance: too much for a tight end.
        const double near_m = 2 * floor_.reach_m();
        const double begin_m = tight_start_ && from == 0 ? std::min(near_m, way_m) : 0;
        const double end_m =
            tight_goal_ && to == count_ - 1 ? std::max(begin_m, way_m - near_m) : way_m;
        const auto pose = [&](double done_m) {
            const Point2 at = point(from) + done_m * ahead;
            return Pose2{at.x_m, at.y_m, heading_rad(link)};
        };
        return (begin_m >= end_m || floor_.is_free(pose(begin_m), pose(end_m).position())) &&
               is_free_end(pose(0), pose(begin_m).position()) &&
               is_free_end(pose(end_m), pose(way_m).position()) &&
               (to != count_ - 1 ||
                is_free_turn(to, heading_rad(link), task_.station.pose.heading_rad));
    }
    bool is_free_end(const Pose2& from, Point2 to) const {
        std::vector<kinematics::Segment> way;
        kinematics::append_straight(way, from, to);
        return way.empty() || floor_.is_free(from, to) || keeps_clear(task_, floor_, way);
    }
    bool is_free_turn(int at, double from_rad, double to_rad) const {
        const Pose2 from{point(at).x_m, point(at).y_m, from_rad};
        const double turn_rad = shortest_turn_rad(from_rad, to_rad);
        if (std::abs(turn_rad) < kinematics::kNothing) return true;
        if (floor_.may_turn_by(from, turn_rad)) return true;
        // Most turns that are not free show it at one of a few places.
        for (const double share : {1.0, 0.5, 0.25, 0.75}) {
            if (!stands_clear({from.x_m, from.y_m, from_rad + share * turn_rad})) return false;
        }
        std::vector<kinematics::Segment> turn;
        kinematics::append_turn(turn, from, turn_rad);
        return keeps_clear(task_, floor_, turn);
    }
    bool stands_clear(const Pose2& pose) const {
        if (floor_.is_free(pose)) return true;
        std::vector<geometry::Polygon> body;
        for (const auto& piece : task_.passage.body.pieces) {
            body.push_back(geometry::transformed(pose, piece));
        }
        return task_.obstacles.keeps(body, task_.limits);
    }

    LegDraft draft(int last) const {
        std::vector<int> chain;
        for (int link = last; link != kStart;
             link = links_[static_cast<std::size_t>(link)].before) {
            chain.push_back(link);
        }
        std::ranges::reverse(chain);
        LegDraft draft;
        Pose2 pose = task_.request.start;
        int before = kStart;
        for (const int link : chain) {
            const double heading = heading_rad(link);
            const Point2 to = point(to_of(link));
            const bool turn = is_turn_between(before, link);
            draft.turns += turn ? 1 : 0;
            draft.cost += edge_cost(task_.cost, geometry::distance(pose.position(), to), turn);
            kinematics::append_turn(draft.segments, pose,
                                    shortest_turn_rad(pose.heading_rad, heading));
            kinematics::append_straight(draft.segments, {pose.x_m, pose.y_m, heading}, to);
            pose = {to.x_m, to.y_m, heading};
            before = link;
        }
        kinematics::append_turn(
            draft.segments, pose,
            shortest_turn_rad(pose.heading_rad, task_.station.pose.heading_rad));
        return draft;
    }

    const LegTask& task_;
    const GridFloor& floor_;
    const std::vector<Point2>& points_;
    double most_cost_;
    int count_;
    bool any_direction_;
    bool tight_start_;
    bool tight_goal_;
    std::vector<Pair> pairs_;
    std::vector<Link> links_;
    std::priority_queue<Entry> open_;
};

}  // namespace

std::optional<LegDraft> draft_along(const LegTask& task, const GridFloor& floor,
                                    const std::vector<Point2>& points, double most_cost) {
    return ChainSearch(task, floor, points, most_cost).run();
}

std::vector<Point2> corners_of(const LegDraft& draft) {
    std::vector<Point2> corners;
    for (const auto& segment : draft.segments) {
        if (segment.kind == kinematics::Segment::Kind::kRotate) continue;
        if (corners.empty()) corners.push_back(segment.start.position());
        corners.push_back(segment.end.position());
    }
    return corners;
}

bool keeps_clear(const LegTask& task, const GridFloor& floor,
                 const std::vector<kinematics::Segment>& segments) {
    const auto pieces = kinematics::sweep(task.passage.body.pieces, segments);
    return task.obstacles.keeps(pieces, task.limits) &&
           driven_over(floor.closed(), task.request.hall, pieces).empty();
}

}  // namespace pulseline::planning
