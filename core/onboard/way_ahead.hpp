#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "core/onboard/drive.hpp"
#include "core/planning/detour/detour.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// What is still ahead of an order, horizon included, and how much of it the drive already has. It
/// hands the drive released edges and tells which nodes are passed; a detour replaces some edges.
/// Thread safety: none. `drive` must outlive it.
class WayAhead {
public:
    /// A node, and what was to be done on the edge that leads to it.
    struct Hop {
        vda5050::OrderNode node;
        std::vector<vda5050::Action> on_edge;
    };

    explicit WayAhead(Drive& drive) : drive_(drive) { skip(); }

    void append(const vda5050::OrderEdge& edge, const vda5050::OrderNode& node);
    /// Takes the nodes that are not released away, with the edges to them.
    std::vector<Hop> drop_horizon();
    /// Forgets everything, and what the drive has of it. REQUIRES: the drive stands.
    void clear();
    /// What the drive has done meanwhile was for somebody else.
    void skip() { segments_seen_ = drive_.segments_done(); }

    /// Hands the drive all released edges up to the next node where it has to stop for actions.
    void hand_over();
    /// The nodes passed since the last call, with the edges to them.
    std::vector<Hop> take_passed();

    bool empty() const { return nodes_.empty(); }
    bool has_horizon() const { return !nodes_.empty() && !nodes_.back().released; }
    /// The drive has all that is released.
    bool base_handed_over() const;
    const std::deque<vda5050::OrderNode>& nodes() const { return nodes_; }
    const std::deque<vda5050::OrderEdge>& edges() const {
        return edges_;
    }  // edges()[i] to nodes()[i]
    /// Along the edge being driven; on a detour of the body's place projected on it.
    double distance_since_last_node_m() const;

    /// Edges that may be left to go round something, the one being driven first: straight ones with
    /// a corridor on one line with one heading, up to a node with actions or one that must be
    /// reached more exactly than the corridor is wide. Released ones, and with
    /// `horizon` those behind them, too. Empty: the edge being driven has no corridor.
    std::vector<planning::DetourEdge> stretch(bool horizon) const;
    /// Drives the detour instead of the edges it goes round, then goes on with those behind it.
    /// REQUIRES: the drive stands; planned for stretch(false) as it is now.
    void go_round(const planning::Detour& detour);
    /// On a detour, until it has ended.
    bool going_round() const { return !detour_.empty(); }
    /// What is left of it, from where the vehicle is.
    std::vector<kinematics::Segment> detour_ahead() const;

private:
    double limit_mps(const vda5050::OrderEdge& edge) const;
    bool continues_line(std::size_t edge) const;
    bool may_be_passed_beside(std::size_t edge) const;

    Drive& drive_;
    std::deque<vda5050::OrderNode> nodes_;
    std::deque<vda5050::OrderEdge> edges_;
    std::size_t handed_edges_ = 0;     // first of edges_ that the drive has, or that it goes round
    std::deque<std::size_t> passing_;  // nodes passed with the end of each segment of the drive
    std::deque<kinematics::Segment> detour_;  // what the drive has not yet done of one
    std::size_t segments_seen_ = 0;
};

}  // namespace pulseline::onboard
