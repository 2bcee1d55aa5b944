#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/traffic/joint_plan.hpp"

namespace pulseline::traffic {

/// Moves that are not in the graph: from the end of the base, in a fixed order.
struct FixedSequence {
    struct Step {
        ShapePtr shape;
        double duration_s = 0;
        VisitIndex visit = kNoVisit;
        PlaceIndex place = kNoPlace;  // that it ends at, if the graph has it
    };
    std::vector<Step> steps;
    PlaceIndex ends_at = kNoPlace;  // in the graph; kNoPlace: it ends at a resting place of its own
};

/// What kept a vehicle from a plan or a grant.
struct Obstacle {
    using Cause = BlockCause;
    Cause cause = Cause::kNoRoute;
    VehicleIndex vehicle = 0;       // kVehicle
    MoveNumber move = 0;            // of that vehicle: it must be passed; kForever: it stays
    std::optional<TileIndex> tile;  // kVehicle, kClosed
};

/// A way from the end of the base through all visits to a resting place.
struct SearchTask {
    struct Stop {
        PlaceIndex place = kNoPlace;
        double dwell_s = 0;
        VisitIndex visit = 0;
        std::shared_ptr<const std::vector<float>> times_to;  // on an empty floor, per place
    };
    VehicleIndex vehicle = 0;
    const CompiledGraph* graph = nullptr;  // may be null when sequences lead to the end
    PlaceIndex start = kNoPlace;           // of the graph; kNoPlace: it has none
    TileIndexes start_stand;
    double start_s = 0;
    double now_s = 0;
    std::vector<Stop> stops;
    std::vector<PlaceIndex> resting;  // empty: all resting places of the graph
    std::shared_ptr<const std::vector<float>> times_to_rest;  // to the nearest of them
    std::optional<Obstacle> hopeless;      // known beforehand: no resting place can be free
    std::vector<FixedSequence> sequences;  // when there are any, the way begins with one of them
    bool only_lasting = false;  // heed only stays without an end, as if all others would give way
    std::size_t most_labels = 200'000;  // bound of the work
};

struct SearchResult {
    std::vector<PlannedMove> moves;  // with times; empty and `found` false: nothing found
    bool found = false;
    Obstacle obstacle;  // nearest to the goal among those that never go away
    std::size_t labels = 0;
};

/// Safe-interval path planning (Phillips, Likhachev, ICRA 2011) over sets of tiles. Input: the
/// predicted stays of all others. Output: a plan that delays none of them and takes at most 1.25
/// times as long as the soonest one, more only when the search gets long. A state is a place, a
/// number of visits done and one interval in which the place's tiles are free of others; weighted
/// A* with the exact times on an empty floor as bound. Keeps its working memory between searches;
/// holds no state that matters.
class WindowSearch {
public:
    /// REQUIRES: joint.predict(task.now_s) was called after the last change.
    SearchResult find(const JointPlan& joint, const SearchTask& task);

private:
    static constexpr double kEver_s = std::numeric_limits<double>::infinity();

    struct Window {
        double from_s;
        double to_s;
    };
    struct Range {
        std::uint32_t begin = 0;
        std::uint32_t count = 0;
        std::uint32_t stamp = 0;
    };
    struct Label {
        PlaceIndex place;
        std::uint16_t stage;
        std::uint32_t parent;
        std::int32_t arc;  // of the graph; -1: a stop; < -1: step of a sequence
        double leave_s;    // when the move into this place starts
        double arrive_s;
        double until_s;      // end of the interval
        std::uint32_t next;  // of the same place and stage
        bool closed;
    };
    struct OpenEntry {
        double end_s;   // no plan through the label ends sooner (but for the greed)
        double left_s;  // way that is left on an empty floor
        std::uint32_t label;
    };
    struct Step {  // of the sequences, as arcs between places behind the graph's
        PlaceIndex to;
        const FixedSequence::Step* step;
    };

    void start(const JointPlan& joint, const SearchTask& task);
    void expand(std::uint32_t index);
    void move_along(std::uint32_t index, PlaceIndex to, std::int32_t arc, const ShapePtr& shape,
                    double duration_s, const Range& windows);
    void add(PlaceIndex place, std::size_t stage, std::uint32_t parent, std::int32_t arc,
             double leave_s, double arrive_s, double until_s);
    bool is_end(const Label& label) const;
    double bound(PlaceIndex place, std::size_t stage) const;
    OpenEntry entry_of(std::uint32_t index) const;
    void find_earliest();
    Range free_windows(const TileIndexes& tiles);
    const Range& busy_windows(TileIndex tile);
    const Range& place_windows(PlaceIndex place);
    const Range& arc_windows(std::uint32_t arc);
    const TileIndexes& stand_of(PlaceIndex place) const;
    void note_obstacle(const TileIndexes& tiles, double bound_s);
    SearchResult result_from(std::uint32_t last) const;

    const JointPlan* joint_ = nullptr;
    const SearchTask* task_ = nullptr;
    std::size_t graph_places_ = 0;
    std::size_t places_ = 0;
    std::vector<std::vector<Step>> steps_;        // by place behind the graph's places
    std::vector<const Step*> step_list_;          // arc number -2 - index
    std::vector<const TileIndexes*> own_stands_;  // of those places
    std::vector<bool> own_ends_;                  // where a sequence ends for good
    std::vector<double> rest_of_way_s_;           // from stop k to the end, on an empty floor
    std::vector<double> earliest_s_;  // by stage: before it nobody can be at its stop (last: rest)
    std::vector<Label> labels_;
    std::vector<std::uint32_t> heads_;  // first label per stage and place
    std::vector<std::uint32_t> head_stamps_;
    std::vector<OpenEntry> open_;
    std::vector<Window> pool_;
    std::vector<Window> blocked_;
    std::vector<Window> busy_;         // of the tiles looked at, in runs
    std::vector<Range> tile_ranges_;   // of busy_
    std::vector<Range> place_ranges_;  // of pool_
    std::vector<Range> floor_ranges_;
    std::uint32_t stamp_ = 0;
    double greed_ = 1;
    double obstacle_bound_s_ = 0;
    Obstacle obstacle_;
};

}  // namespace pulseline::traffic
