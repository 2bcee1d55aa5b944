#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/kinematics/motion.hpp"
#include "core/planning/roads/roadmap_index.hpp"

/// The roadmap as places and single motions of one body: what traffic orders vehicles on.
namespace pulseline::planning {

/// Lanes are cut into pieces of at most this length, so that the base grows in pieces and the
/// floor behind a vehicle is freed as it is left.
constexpr double kLanePiece_m = 4.0;
/// A vehicle this near to a place stands at it, as far as its floor is concerned: the floor margin
/// of traffic covers it.
constexpr double kAtPlace_m = 0.05;
constexpr double kAtPlace_rad = radians(0.6);

struct MotionPlace {
    plant::HallId hall;
    geometry::Pose2 pose;
    plant::StationId station;  // whose theoretical pose it is; empty: on a lane or at a node
};

/// One motion from place to place: a straight piece of a lane, or a turn on the spot of less than
/// half a turn.
struct MotionWay {
    std::size_t from = 0;
    std::size_t to = 0;
    kinematics::Segment segment;
    double max_speed_mps = 0;  // 0: the vehicle's own limit
    double duration_s = 0;     // in flow: stops and starts are counted with the turns
};

struct MotionGraph {
    std::vector<MotionPlace> places;
    std::vector<MotionWay> ways;

    /// Nearest place within kAtPlace_m and kAtPlace_rad; none: the vehicle stands elsewhere.
    std::optional<std::size_t> place_at(const plant::HallId& hall,
                                        const geometry::Pose2& pose) const;
    std::optional<std::size_t> station_place(const plant::StationId& station) const;
};

/// Everything the body may do on the roadmap: its lanes forwards and backwards, turns at nodes
/// where they are free, and the stations that vehicles of the type may stop at, each joined to its
/// node.
MotionGraph motion_graph(const plant::Plant& plant, const RoadmapIndex& roads,
                         const Passage& passage, const plant::VehicleType& type);

}  // namespace pulseline::planning
