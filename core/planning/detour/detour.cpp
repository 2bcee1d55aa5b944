#include "core/planning/detour/detour.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/kinematics/primitives.hpp"
#include "core/planning/detour/detour_ground.hpp"
#include "core/planning/detour/seen_things.hpp"
#include "core/planning/detour/side_step.hpp"

namespace pulseline::planning {
namespace {

using geometry::Pose2;
using kinematics::Segment;

// Beyond a node by so much it will not look as if it had come back, whatever odometry says.
constexpr double kBeyond_m = 0.1;
constexpr double kSample_m = 0.01;
constexpr double kRounding_m = 1e-3;
constexpr double kOnLine_m = 0.05;
// Of a free manoeuvre, in FreeManoeuvreRequest::time_limit_s: to the far end, and to nearer ones.
constexpr double kFarLimit_s = 0.1;
constexpr double kNearLimit_s = 0.03;
constexpr int kNearTries = 3;

struct Found {
    std::vector<Segment> segments;  // frame of the line
    std::size_t edges = 0;
    bool sideways = false;
    long tests = 0;
};

tl::unexpected<Error> none(const char* reason, const char* what) {
    return fail(Errc::kUnreachable, reason, what);
}

bool moves_sideways(const plant::VehicleType& type) {
    return Steering(type).any_direction() ||
           (!type.wheels.empty() && kinematics::wheels_of(type, {0, 0.1, 0}).has_value());
}

std::size_t samples_of(const Segment& segment) {
    return 1 + static_cast<std::size_t>(std::abs(segment.length_m) / kSample_m);
}

/// A place on the way: segments[index] at a share.
struct Place {
    std::size_t index = 0;
    double share = 0;
};

/// The first place from which the centre never comes back behind x; the end when there is none.
Place stays_beyond(const std::vector<Segment>& segments, double x_m) {
    Place place{segments.size() - 1, 1};
    for (std::size_t i = segments.size(); i-- > 0;) {
        const std::size_t count = samples_of(segments[i]);
        for (std::size_t k = count + 1; k-- > 0;) {
            const double share = static_cast<double>(k) / static_cast<double>(count);
            if (kinematics::pose_at(segments[i], share).x_m < x_m) return place;
            place = {i, share};
        }
    }
    return place;
}

bool stays_between(const std::vector<Segment>& segments, double from_m, double to_m) {
    for (const Segment& segment : segments) {
        const std::size_t count = samples_of(segment);
        for (std::size_t k = 0; k <= count; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(count);
            const double x_m = kinematics::pose_at(segment, share).x_m;
            if (x_m < from_m - kRounding_m || x_m > to_m + kRounding_m) return false;
        }
    }
    return true;
}

class Planning {
public:
    explicit Planning(const DetourRequest& request) : request_(request), ground_(request) {}

    Result<Detour> run() {
        const auto barred_m = ground_.first_barred_m(ground_.start().x_m);
        if (!barred_m && std::abs(ground_.start().y_m) < kOnLine_m) {
            return none("nothing_in_the_way", "nothing that it sees stands on its line");
        }
        const auto goals = goals_behind(barred_m.value_or(ground_.start().x_m));
        if (goals.empty()) {
            return none("ends_too_near", "the corridor or the order ends too near behind it");
        }
        if (moves_sideways(ground_.type())) {
            for (const std::size_t goal : goals) {
                if (auto found = by_side_step(goal)) return answer(*found);
            }
        }
        if (auto found = by_manoeuvre(goals)) return answer(*found);
        return none("no_room", "there is no room in the corridor");
    }

private:
    /// Edges at whose ends the body may stand, beyond what bars the line.
    std::vector<std::size_t> goals_behind(double x_m) const {
        std::vector<std::size_t> goals;
        for (std::size_t i = 0; i < ground_.ends_m().size(); ++i) {
            const double end_m = ground_.ends_m()[i];
            if (end_m > x_m + kRounding_m && ground_.is_free_on_line(end_m)) goals.push_back(i);
        }
        return goals;
    }

    std::optional<Found> by_side_step(std::size_t goal) const {
        const double goal_m = ground_.ends_m()[goal];
        const auto moves = side_step(ground_, ground_.start(), goal_m);
        if (!moves) return std::nullopt;
        Pose2 start = ground_.start();
        const bool turns = moves->front().kind == Segment::Kind::kRotate;
        if (!turns) start.heading_rad = ground_.heading_rad();
        return checked({segments_of(start, *moves, ground_.on_line(goal_m)), goal + 1, true, 0});
    }

    /// To the farthest end first: where that is out of reach, the nearer ones mostly are, too.
    std::optional<Found> by_manoeuvre(const std::vector<std::size_t>& goals) const {
        auto far = manoeuvre_to(goals.back(), kFarLimit_s);
        if (!far) return std::nullopt;
        for (std::size_t k = 0; k + 1 < goals.size() && k < kNearTries; ++k) {
            if (auto near = manoeuvre_to(goals[k], kNearLimit_s)) return near;
        }
        return far;
    }

    std::optional<Found> manoeuvre_to(std::size_t goal, double time_limit_s) const {
        FreeManoeuvreRequest request;
        request.type = &ground_.type();
        request.loaded = ground_.loaded();
        request.start = ground_.start();
        request.goal = ground_.on_line(ground_.ends_m()[goal]);
        request.standing = ground_.things();
        request.time_limit_s = time_limit_s;
        auto found = plan_free_manoeuvre(ground_.floor(), request);
        if (!found) return std::nullopt;
        return checked({std::move(found->motion.segments), goal + 1, false, found->tests});
    }

    std::optional<Found> checked(Found found) const {
        const double from_m = std::min(0.0, ground_.start().x_m);
        if (!stays_between(found.segments, from_m, ground_.ends_m()[found.edges - 1])) {
            return std::nullopt;
        }
        return found;
    }

    Detour answer(const Found& found) const {
        Detour detour;
        detour.edges = found.edges;
        detour.sideways = found.sideways;
        detour.tests = found.tests;
        for (const Segment& segment : found.segments) {
            detour.length_m += std::abs(segment.length_m);
            for (const double y_m : {segment.start.y_m, kinematics::pose_at(segment, 0.5).y_m}) {
                if (std::abs(y_m) > std::abs(detour.beside_m)) detour.beside_m = y_m;
            }
        }
        detour.pieces = cut_at_nodes(found);
        for (Detour::Piece& piece : detour.pieces) to_hall(piece.segment);
        detour.pieces.back().segment.end = request_.stretch[found.edges - 1].end;
        return detour;
    }

    /// Pieces that end where a node counts as passed; the last node's is the end itself.
    std::vector<Detour::Piece> cut_at_nodes(const Found& found) const {
        std::vector<std::pair<Place, std::size_t>> cuts;  // so many nodes passed there
        for (std::size_t i = 0; i + 1 < found.edges; ++i) {
            const Place place = stays_beyond(found.segments, ground_.ends_m()[i] + kBeyond_m);
            cuts.emplace_back(place, i + 1);
        }
        std::vector<Detour::Piece> pieces;
        std::size_t passed = 0;
        auto cut = cuts.begin();
        for (std::size_t i = 0; i < found.segments.size(); ++i) {
            const Segment& segment = found.segments[i];
            double share = 0;
            for (; cut != cuts.end() && cut->first.index == i; ++cut) {
                if (cut->first.share > share) {
                    pieces.push_back({piece(segment, share, cut->first.share), 0});
                    share = cut->first.share;
                }
                if (pieces.empty()) continue;  // passed from the start: counted with the next
                pieces.back().nodes_passed += cut->second - passed;
                passed = cut->second;
            }
            if (share < 1) pieces.push_back({piece(segment, share, 1), 0});
        }
        pieces.back().nodes_passed += found.edges - passed;
        return pieces;
    }

    Segment piece(const Segment& segment, double from, double to) const {
        return from == 0 && to == 1 ? segment : part(ground_.type(), segment, from, to);
    }

    void to_hall(Segment& segment) const {
        segment.start = ground_.hall_from_line() * segment.start;
        segment.end = ground_.hall_from_line() * segment.end;
        segment.centre = ground_.hall_from_line() * segment.centre;
    }

    const DetourRequest& request_;
    DetourGround ground_;
};

}  // namespace

Result<Detour> plan_detour(const DetourRequest& request) {
    assert(request.type);
    if (request.stretch.empty()) {
        return none("no_corridor", "this way has no corridor");
    }
    return Planning(request).run();
}

bool keeps_clear(const plant::VehicleType& type, bool loaded, const Pose2& now,
                 const std::vector<Segment>& way, const std::vector<geometry::Point2>& seen,
                 double kept_m) {
    const auto body = plant::outline_with_load(type, loaded);
    const auto swept = kinematics::sweep(body, way);
    std::vector<geometry::Point2> corners;
    for (const auto& piece : swept) corners.insert(corners.end(), piece.begin(), piece.end());
    if (corners.empty()) return true;
    const auto box = geometry::bounding_box(corners);
    std::vector<geometry::Point2> near;
    for (const auto& p : seen) {
        if (p.x_m > box.min.x_m - kept_m && p.x_m < box.max.x_m + kept_m &&
            p.y_m > box.min.y_m - kept_m && p.y_m < box.max.y_m + kept_m) {
            near.push_back(p);
        }
    }
    std::vector<geometry::Polygon> standing;
    standing.reserve(body.size());
    for (const auto& piece : body) standing.push_back(geometry::transformed(now, piece));
    const auto things = seen_things(std::move(near));
    return std::all_of(things.begin(), things.end(), [&](const StandingBody& thing) {
        return distance_to(thing, swept, kept_m) >= kept_m ||
               distance_to(thing, standing, kept_m) < kept_m;
    });
}

}  // namespace pulseline::planning
