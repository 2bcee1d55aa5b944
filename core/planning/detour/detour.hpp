#pragma once

#include <cstddef>
#include <vector>

#include "core/base/result.hpp"
#include "core/kinematics/motion.hpp"
#include "core/plant/plant.hpp"

/// Going round something that stands on the line of an order, within the corridors of its edges.
namespace pulseline::planning {

/// One straight edge of the stretch; hall frame.
struct DetourEdge {
    geometry::Pose2 start;
    geometry::Pose2 end;
    plant::Corridor corridor;
};

struct DetourRequest {
    const plant::VehicleType* type = nullptr;
    bool loaded = false;
    geometry::Pose2 start;  // where the vehicle stands, on the line or beside it
    /// The edges that may be left, the one being driven first: one line, one direction of travel,
    /// one heading, each beginning where the one before ends. Only the last one's end may be a
    /// node that has to be reached exactly.
    std::vector<DetourEdge> stretch;
    std::vector<geometry::Point2> seen;  // everything the scanners have seen; hall frame
};

struct Detour {
    struct Piece {
        kinematics::Segment segment;
        /// So many more nodes of the stretch count as passed once this piece is driven: the body's
        /// centre is beyond them then and stays there.
        std::size_t nodes_passed = 0;
    };
    std::vector<Piece> pieces;  // a chain from the start to the end pose of an edge itself
    std::size_t edges = 0;      // it ends at the end of stretch[edges - 1]
    double length_m = 0;
    double beside_m = 0;    // farthest of the body's centre from the line, to the left positive
    bool sideways = false;  // shift, pass, shift back; otherwise a free manoeuvre
    long tests = 0;         // of the body, spent on a free manoeuvre
};

/// Kept to what is seen: more than the margin of the protective fields (0.1 m) with what a scanner
/// may be off (0.04 m), so that these let it pass.
constexpr double kDetourClearance_m = 0.2;
/// Kept to the border of the band: for what odometry may be off.
constexpr double kBandMargin_m = 0.1;

/// Plans round what is seen on the line and back onto it, ending at the nearest edge end where that
/// is possible. All of the outline stays inside the band of the edges not yet passed, less
/// kBandMargin_m: each edge from R before its start to R behind its end (R: greatest distance of
/// a point of the outline from the body's origin), as wide as its corridor; where bands overlap the
/// narrower one counts. Where a corridor leaves less than the margin beside a vehicle on the line,
/// that is what is kept. The body's centre neither goes behind the beginning of the stretch nor
/// past the end of the detour.
/// Vehicles that their wheels let move in any direction shift aside, pass and shift back; when that
/// does not do, and for all others, a free manoeuvre is planned. Of a thing only the front is seen
/// at first: it is taken to be some way deeper.
/// The same request gives the same answer; work is bounded (some hundred ms at most).
/// Errors (Errc::kUnreachable), `what` being a clause for "it does not go round it: ...":
/// no_corridor (empty stretch), nothing_in_the_way, ends_too_near (the stretch ends before there is
/// a free place on the line behind the thing), no_room.
/// REQUIRES: request.type; outlines as plant::outline_with_load gives them.
Result<Detour> plan_detour(const DetourRequest& request);

/// Whether a body that stands at `now` and drives `way` (hall frame) keeps `kept_m` to all that is
/// seen: of a thing more is seen on the way than there was when the way was planned. What it is
/// already nearer to does not count: that is for its fields.
bool keeps_clear(const plant::VehicleType& type, bool loaded, const geometry::Pose2& now,
                 const std::vector<kinematics::Segment>& way,
                 const std::vector<geometry::Point2>& seen, double kept_m);

}  // namespace pulseline::planning
