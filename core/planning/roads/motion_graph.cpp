#include "core/planning/roads/motion_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "core/kinematics/primitives.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Pose2;
using kinematics::Segment;

// Places nearer than this are one: rounding.
constexpr double kSame_m = 1e-3;
constexpr double kSame_rad = 1e-4;

class Builder {
public:
    Builder(const plant::Plant& plant, const RoadmapIndex& roads, const Passage& passage,
            const plant::VehicleType& type)
        : plant_(plant), roads_(roads), passage_(passage), type_(type) {}

    MotionGraph build() {
        for (std::size_t i = 0; i < roads_.graph().arcs.size(); ++i) {
            if (roads_.usable(passage_, static_cast<int>(i))) add_lane(static_cast<int>(i));
        }
        for (const plant::Station& station : plant_.stations) add_station(station);
        for (auto& [key, headings] : turning_) add_turns(headings);
        return std::move(graph_);
    }

private:
    using Key = std::tuple<plant::HallId, std::int64_t, std::int64_t, std::int64_t>;
    using PointKey = std::tuple<plant::HallId, std::int64_t, std::int64_t>;
    /// Where the body may turn: the places that differ by their heading only.
    struct TurningPoint {
        std::vector<std::size_t> places;
        Obstacles::Limits limits;
    };

    static std::int64_t rounded(double value, double step) {
        return static_cast<std::int64_t>(std::llround(value / step));
    }

    std::size_t place(const plant::HallId& hall, const Pose2& pose) {
        const auto full_turn = rounded(2 * kPi, kSame_rad);
        const auto heading = rounded(wrap(pose.heading_rad), kSame_rad);
        const Key key{hall, rounded(pose.x_m, kSame_m), rounded(pose.y_m, kSame_m),
                      ((heading % full_turn) + full_turn) % full_turn};
        const auto [it, is_new] = numbers_.emplace(key, graph_.places.size());
        if (is_new)
            graph_.places.push_back({hall, {pose.x_m, pose.y_m, wrap(pose.heading_rad)}, {}});
        return it->second;
    }

    TurningPoint& turning_point(const plant::HallId& hall, Point2 at) {
        auto& point = turning_[{hall, rounded(at.x_m, kSame_m), rounded(at.y_m, kSame_m)}];
        if (point.limits.empty()) {
            if (const Obstacles* obstacles = roads_.obstacles(hall)) {
                point.limits = obstacles->limits(passage_.body.clearance_m);
            }
        }
        return point;
    }

    void turn_here(const plant::HallId& hall, std::size_t number) {
        auto& places = turning_point(hall, graph_.places[number].pose.position()).places;
        if (std::find(places.begin(), places.end(), number) == places.end()) {
            places.push_back(number);
        }
    }

    double speed(double limit_mps) const {
        return limit_mps > 0 ? std::min(limit_mps, type_.max_speed_mps) : type_.max_speed_mps;
    }

    void add_way(std::size_t from, std::size_t to, Segment segment, double limit_mps) {
        double duration_s = std::abs(segment.length_m) / speed(limit_mps);
        if (segment.kind == Segment::Kind::kRotate) {
            // Braking for the turn and starting after it take v / a longer than driving on.
            duration_s = kinematics::profile_duration_s(std::abs(segment.turn_rad),
                                                        type_.max_turn_rate_radps,
                                                        type_.max_turn_accel_radps2) +
                         type_.max_speed_mps / type_.max_accel_mps2;
        }
        segment.duration_s = duration_s;
        graph_.ways.push_back({from, to, std::move(segment), limit_mps, std::max(duration_s, 0.1)});
    }

    /// A straight line with constant heading, in pieces.
    void add_line(const plant::HallId& hall, Point2 from, Point2 to, double heading_rad,
                  double limit_mps) {
        const int pieces = std::max(
            1, static_cast<int>(std::ceil(geometry::distance(from, to) / kLanePiece_m - 1e-9)));
        std::size_t here = place(hall, {from.x_m, from.y_m, heading_rad});
        turn_here(hall, here);
        for (int i = 1; i <= pieces; ++i) {
            const double share = static_cast<double>(i) / pieces;
            const Point2 at = from + share * (to - from);
            const std::size_t next = place(hall, {at.x_m, at.y_m, heading_rad});
            std::vector<Segment> segments;
            kinematics::append_straight(segments, graph_.places[here].pose,
                                        graph_.places[next].pose.position());
            if (!segments.empty()) add_way(here, next, segments.front(), limit_mps);
            here = next;
        }
        turn_here(hall, here);
    }

    void add_lane(int index) {
        const RoadArc& arc = roads_.graph().arcs[static_cast<std::size_t>(index)];
        const auto& nodes = roads_.graph().nodes;
        add_line(roads_.node(arc.from).hall, nodes[static_cast<std::size_t>(arc.from)],
                 nodes[static_cast<std::size_t>(arc.to)], arc.body_rad,
                 roads_.edge_of_arc(index).max_speed_mps);
    }

    void add_station(const plant::Station& station) {
        const auto& types = station.vehicle_types;
        if (!types.empty() && std::find(types.begin(), types.end(), type_.id) == types.end()) {
            return;
        }
        const std::size_t number = place(station.hall, station.pose);
        graph_.places[number].station = station.id;
        const Point2 at = station.pose.position();
        auto& point = turning_point(station.hall, at);
        const Obstacles* obstacles = roads_.obstacles(station.hall);
        if (!obstacles) return;
        // Jigs may stand near: what is near to the standing vehicle may stay as near as it turns.
        std::vector<geometry::Polygon> standing;
        for (const auto& piece : passage_.body.pieces) {
            standing.push_back(geometry::transformed(station.pose, piece));
        }
        point.limits = obstacles->limits_from(standing, passage_.body.clearance_m);
        turn_here(station.hall, number);
        const int node = roads_.node(station.node);
        if (node < 0) return;
        const Point2 junction = roads_.graph().nodes[static_cast<std::size_t>(node)];
        const Point2 way = junction - at;
        if (norm(way) < kSame_m) return;
        // A station beside its node is reached on a straight line, forwards or backwards.
        for (const double turn : {0.0, kPi}) {
            const double heading = wrap(std::atan2(way.y_m, way.x_m) + turn);
            std::vector<Segment> line;
            kinematics::append_straight(line, {at.x_m, at.y_m, heading}, junction);
            if (!obstacles->keeps(kinematics::sweep(passage_.body.pieces, line), point.limits)) {
                continue;
            }
            add_line(station.hall, at, junction, heading, 0);
            add_line(station.hall, junction, at, heading, 0);
        }
    }

    bool turn_free(const TurningPoint& point, std::size_t from, std::size_t to) const {
        const Obstacles* obstacles = roads_.obstacles(graph_.places[from].hall);
        std::vector<Segment> turn;
        kinematics::append_turn(turn, graph_.places[from].pose,
                                kinematics::shortest_turn_rad(graph_.places[from].pose.heading_rad,
                                                              graph_.places[to].pose.heading_rad));
        return obstacles && obstacles->keeps(kinematics::sweep(passage_.body.pieces, turn,
                                                               kinematics::kOutlineDetail),
                                             point.limits);
    }

    void add_turn(std::size_t from, std::size_t to) {
        std::vector<Segment> turn;
        kinematics::append_turn(turn, graph_.places[from].pose,
                                kinematics::shortest_turn_rad(graph_.places[from].pose.heading_rad,
                                                              graph_.places[to].pose.heading_rad));
        if (turn.empty()) return;
        if (turn.size() == 1) {
            add_way(from, to, turn.front(), 0);
            return;
        }
        // Half a turn is two motions, as the vehicle is told it.
        const std::size_t half = place(graph_.places[from].hall, turn.front().end);
        add_way(from, half, turn.front(), 0);
        add_way(half, to, turn.back(), 0);
    }

    void add_turns(const TurningPoint& point) {
        for (const std::size_t from : point.places) {
            for (const std::size_t to : point.places) {
                if (from != to && turn_free(point, from, to)) add_turn(from, to);
            }
        }
    }

    const plant::Plant& plant_;
    const RoadmapIndex& roads_;
    const Passage& passage_;
    const plant::VehicleType& type_;
    MotionGraph graph_;
    std::map<Key, std::size_t> numbers_;
    std::map<PointKey, TurningPoint> turning_;
};

}  // namespace

std::optional<std::size_t> MotionGraph::place_at(const plant::HallId& hall,
                                                 const Pose2& pose) const {
    std::optional<std::size_t> best;
    double least_m = kAtPlace_m;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const MotionPlace& place = places[i];
        // Most places are far away: not worth a root.
        if (std::abs(place.pose.x_m - pose.x_m) > kAtPlace_m) continue;
        const double away_m = geometry::distance(place.pose.position(), pose.position());
        if (away_m > least_m || place.hall != hall) continue;
        if (std::abs(wrap(place.pose.heading_rad - pose.heading_rad)) > kAtPlace_rad) continue;
        best = i;
        least_m = away_m;
    }
    return best;
}

std::optional<std::size_t> MotionGraph::station_place(const plant::StationId& station) const {
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i].station == station) return i;
    }
    return std::nullopt;
}

MotionGraph motion_graph(const plant::Plant& plant, const RoadmapIndex& roads,
                         const Passage& passage, const plant::VehicleType& type) {
    return Builder(plant, roads, passage, type).build();
}

}  // namespace pulseline::planning
