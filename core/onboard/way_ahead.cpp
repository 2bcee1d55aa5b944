#include "core/onboard/way_ahead.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/onboard/pose/segment_watch.hpp"

namespace pulseline::onboard {
namespace {

using kinematics::Segment;

// Of one lane cut into pieces; what is farther off is another line.
constexpr double kSameLine_m = 0.01;
constexpr double kSameDirection_rad = 2e-3;
// Beside something half seen nobody hurries.
constexpr double kGoingRound_mps = 0.5;

geometry::Point2 direction_of(const Segment& segment) {
    const double rad = segment.start.heading_rad + segment.direction_rad;
    return {std::cos(rad), std::sin(rad)};
}

bool is_precise(const vda5050::OrderEdge& edge) {
    return std::ranges::any_of(edge.actions, [](const vda5050::Action& action) {
        return action.type == vda5050::kFinePositioning;
    });
}

bool may_be_left(const vda5050::OrderEdge& edge) {
    return edge.corridor && edge.segment.kind == Segment::Kind::kStraight;
}

}  // namespace

void WayAhead::append(const vda5050::OrderEdge& edge, const vda5050::OrderNode& node) {
    edges_.push_back(edge);
    nodes_.push_back(node);
}

std::vector<WayAhead::Hop> WayAhead::drop_horizon() {
    std::vector<Hop> dropped;
    while (has_horizon()) {
        dropped.push_back({std::move(nodes_.back()), std::move(edges_.back().actions)});
        nodes_.pop_back();
        edges_.pop_back();
    }
    return dropped;
}

void WayAhead::clear() {
    drive_.clear();
    nodes_.clear();
    edges_.clear();
    passing_.clear();
    handed_edges_ = 0;
    detour_.clear();
    skip();
}

/// The drive brakes for it before the edge, so that the whole edge is driven so. 0: none.
double WayAhead::limit_mps(const vda5050::OrderEdge& edge) const {
    if (!is_precise(edge)) return edge.max_speed_mps;
    const double precise_mps = SegmentWatch::kPrecise_mps * drive_.time_factor();
    return edge.max_speed_mps > 0 ? std::min(edge.max_speed_mps, precise_mps) : precise_mps;
}

void WayAhead::hand_over() {
    const auto stops_at = [&](std::size_t i) { return !nodes_[i].actions.empty(); };
    if (handed_edges_ > 0 && stops_at(handed_edges_ - 1)) return;
    while (!base_handed_over()) {
        const auto& edge = edges_[handed_edges_];
        drive_.append(edge.segment, limit_mps(edge));
        passing_.push_back(1);
        ++handed_edges_;
        if (stops_at(handed_edges_ - 1)) return;
    }
}

std::vector<WayAhead::Hop> WayAhead::take_passed() {
    std::vector<Hop> passed;
    for (; segments_seen_ < drive_.segments_done(); ++segments_seen_) {
        for (std::size_t left = passing_.front(); left > 0; --left) {
            passed.push_back({std::move(nodes_.front()), std::move(edges_.front().actions)});
            nodes_.pop_front();
            edges_.pop_front();
            --handed_edges_;
        }
        passing_.pop_front();
        if (!detour_.empty()) detour_.pop_front();
    }
    return passed;
}

bool WayAhead::base_handed_over() const {
    return handed_edges_ == edges_.size() || !edges_[handed_edges_].released;
}

double WayAhead::distance_since_last_node_m() const {
    if (!going_round()) return drive_.distance_on_segment_m();
    const Segment& edge = edges_.front().segment;
    const double along_m =
        dot(drive_.believed_pose().position() - edge.start.position(), direction_of(edge));
    return std::clamp(along_m, 0.0, std::abs(edge.length_m));
}

bool WayAhead::continues_line(std::size_t edge) const {
    const Segment& before = edges_[edge - 1].segment;
    const Segment& next = edges_[edge].segment;
    const double turn_rad = wrap(next.start.heading_rad - before.end.heading_rad);
    const double bend_rad = wrap(next.direction_rad - before.direction_rad);
    return distance(before.end.position(), next.start.position()) <= kSameLine_m &&
           std::abs(turn_rad) <= kSameDirection_rad && std::abs(bend_rad) <= kSameDirection_rad;
}

/// Its node has no actions and lets a vehicle pass anywhere in the corridor.
bool WayAhead::may_be_passed_beside(std::size_t edge) const {
    const plant::Corridor& corridor = *edges_[edge].corridor;
    return nodes_[edge].actions.empty() &&
           nodes_[edge].allowed_deviation_xy_m >= std::max(corridor.left_m, corridor.right_m);
}

std::vector<planning::DetourEdge> WayAhead::stretch(bool horizon) const {
    std::vector<planning::DetourEdge> stretch;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        const vda5050::OrderEdge& edge = edges_[i];
        if (!may_be_left(edge) || (!edge.released && !horizon)) break;
        if (i > 0 && (!continues_line(i) || !may_be_passed_beside(i - 1))) break;
        stretch.push_back({edge.segment.start, edge.segment.end, *edge.corridor});
    }
    return stretch;
}

std::vector<Segment> WayAhead::detour_ahead() const {
    std::vector<Segment> ahead(detour_.begin(), detour_.end());
    if (ahead.empty()) return ahead;
    const double done_m = drive_.distance_on_segment_m();
    const double length_m = std::abs(ahead.front().length_m);
    if (done_m > 0 && done_m < length_m) {
        ahead.front() = kinematics::part(drive_.type(), ahead.front(), done_m / length_m, 1);
    }
    return ahead;
}

void WayAhead::go_round(const planning::Detour& detour) {
    assert(detour.edges <= edges_.size());
    double speed_mps = kGoingRound_mps * drive_.time_factor();
    for (std::size_t i = 0; i < detour.edges; ++i) {
        const double edge_mps = limit_mps(edges_[i]);
        if (edge_mps > 0) speed_mps = std::min(speed_mps, edge_mps);
    }
    drive_.clear();
    passing_.clear();
    detour_.clear();
    for (const auto& piece : detour.pieces) {
        drive_.append(piece.segment, speed_mps);
        detour_.push_back(piece.segment);
        passing_.push_back(piece.nodes_passed);
    }
    handed_edges_ = detour.edges;
}

}  // namespace pulseline::onboard
