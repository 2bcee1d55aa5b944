#include "core/planning/legs/leg_chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/square.hpp"
#include "core/localisation/codes_on_way.hpp"
#include "core/localisation/segment_chain.hpp"
#include "core/planning/legs/blind_way.hpp"

namespace pulseline::planning {
namespace {

using kinematics::Segment;
using localisation::CodePass;

// The safety coefficient C of eq. 4: "slightly greater than 1".
constexpr double kSafety = 1.1;
constexpr double kOneSight_m = 0.1;  // looks at a code less far apart belong together

double whole_way_m(std::span<const Segment> segments) {
    double length_m = 0;
    for (const Segment& segment : segments) length_m += std::abs(segment.length_m);
    return length_m;
}

/// How far beside the line from `a` to `b` a place lies; past its ends, how far from them.
double off_line_m(geometry::Point2 a, geometry::Point2 b, geometry::Point2 place) {
    const geometry::Point2 line = b - a;
    const double length2 = dot(line, line);
    const double share = length2 > 0 ? std::clamp(dot(place - a, line) / length2, 0.0, 1.0) : 0;
    return distance(a + share * line, place);
}

/// Stretches of the way on which one camera has one code in view.
class Sightings {
public:
    Sightings(std::size_t code, const plant::Marker& marker, const plant::Camera& camera)
        : code_(code),
          at_(marker.pose.position()),
          marker_(marker),
          camera_(camera),
          reach_m_(norm(camera.body_from_camera.position()) +
                   std::max(0.0, localisation::view_radius_m(camera, marker.size_m))) {}

    void look_along(const Segment& segment, double before_m) {
        const double away_m = distance(segment.start.position(), at_);
        if (away_m > std::abs(segment.length_m) + reach_m_) return;
        const std::span<const plant::Camera> one(&camera_, 1);
        for (const double share : localisation::seen_at(marker_, one, segment)) {
            const auto foot =
                kinematics::pose_at(segment, share) * camera_.body_from_camera.position();
            see_at(before_m + share * std::abs(segment.length_m), foot);
        }
    }

    std::vector<CodePass> passes(const localisation::OdometryNoise& noise) const {
        std::vector<CodePass> passes;
        for (const Sight& sight : sights_) {
            passes.push_back(
                {code_, sight.from_m, sight.to_m,
                 localisation::known_by_code(camera_, marker_).place_m,
                 localisation::blind_way_m(camera_, marker_.size_m, {}, noise, sight.off_m)});
        }
        return passes;
    }

private:
    struct Sight {
        double from_m = 0;
        double to_m = 0;
        geometry::Point2 foot;  // of the camera, seen last
        double off_m = 0;       // what the code lies beside the foot's line
    };

    void see_at(double way_m, geometry::Point2 foot) {
        if (sights_.empty() || way_m - sights_.back().to_m > kOneSight_m) {
            sights_.push_back({way_m, way_m, foot, distance(foot, at_)});
        }
        Sight& sight = sights_.back();
        sight.to_m = std::max(sight.to_m, way_m);
        sight.off_m = std::min(sight.off_m, off_line_m(sight.foot, foot, at_));
        sight.foot = foot;
    }

    std::size_t code_;
    geometry::Point2 at_;
    const plant::Marker& marker_;
    const plant::Camera& camera_;
    double reach_m_;  // from the body's middle
    std::vector<Sight> sights_;
};

bool is_code_of(const plant::Station* station, const plant::Marker& marker) {
    return station && std::ranges::find(station->markers, marker.id) != station->markers.end();
}

/// Codes in view where the leg ends are what it stops by, and those where it begins it knows
/// already.
bool is_under_way(const CodePass& pass, bool of_station, double length_m) {
    const bool at_end = of_station && pass.to_m >= length_m - kOneSight_m;
    return !at_end && pass.from_m > 0;
}

std::vector<CodePass> passes_of(const plant::Plant& plant, const plant::HallId& hall,
                                const CodeReach& reach, const plant::Station* station,
                                std::span<const Segment> segments) {
    const double length_m = whole_way_m(segments);
    std::vector<CodePass> passes;
    for (std::size_t code = 0; code < plant.markers.size(); ++code) {
        const plant::Marker& marker = plant.markers[code];
        if (marker.hall != hall) continue;
        for (const plant::Camera& camera : reach.cameras()) {
            Sightings sightings(code, marker, camera);
            double before_m = 0;
            for (const Segment& segment : segments) {
                sightings.look_along(segment, before_m);
                before_m += std::abs(segment.length_m);
            }
            for (const CodePass& pass : sightings.passes(reach.noise())) {
                if (is_under_way(pass, is_code_of(station, marker), length_m)) {
                    passes.push_back(pass);
                }
            }
        }
    }
    std::ranges::stable_sort(passes, {}, &CodePass::from_m);
    return passes;
}

/// What motion adds to sigma between two places of the way; turns make the heading less known, from
/// the first place on as far as eq. 4 knows.
class WayErrors {
public:
    WayErrors(const std::vector<TurnAt>& turns, double heading_rad,
              const localisation::OdometryNoise& noise)
        : turns_(turns), heading_rad_(heading_rad), noise_(noise) {}

    double operator()(double from_m, double to_m) const {
        double heading2 = square(heading_rad_);
        for (const TurnAt& turn : turns_) {
            if (turn.at_m < from_m || turn.at_m >= to_m) continue;
            heading2 += square(localisation::turn_sigma_rad(turn.turn_rad, turn.brakes, noise_));
        }
        return kSafety * localisation::motion_sigma_m(std::sqrt(heading2), to_m - from_m, noise_);
    }

private:
    const std::vector<TurnAt>& turns_;
    double heading_rad_;
    localisation::OdometryNoise noise_;
};

/// Of a pose by the code of those passed whose direction is known worst.
double heading_by_codes(const plant::Plant& plant, const std::vector<CodePass>& passes) {
    double worst_rad = plant::Marker().sigma_heading_rad;
    for (const CodePass& pass : passes) {
        worst_rad = std::max(worst_rad, plant.markers[pass.code].sigma_heading_rad);
    }
    return std::hypot(localisation::code_sigma_rad({}, 0), worst_rad);
}

/// It stands on codes as plants usually have them when it leaves.
double sigma_at_start(const CodeReach& reach) {
    double least_m = std::numeric_limits<double>::infinity();
    for (const plant::Camera& camera : reach.cameras()) {
        least_m = std::min(least_m, localisation::known_by_code(camera, {}).place_m);
    }
    return least_m;
}

double caught_at_station(const plant::Plant& plant, const CodeReach& reach,
                         const plant::Station* station) {
    double within_m = std::numeric_limits<double>::infinity();
    if (!station) return within_m;
    for (const auto& id : station->markers) {
        const auto* marker = plant::find_marker(plant, id);
        if (marker) within_m = std::min(within_m, reach.at_most_m(marker->size_m));
    }
    return within_m;
}

geometry::Point2 place_on_way(std::span<const Segment> segments, double way_m) {
    for (const Segment& segment : segments) {
        const double length_m = std::abs(segment.length_m);
        if (way_m <= length_m && length_m > 0) {
            return kinematics::pose_at(segment, way_m / length_m).position();
        }
        way_m -= length_m;
    }
    return segments.back().end.position();
}

tl::unexpected<Error> no_chain(const localisation::ChainGap& gap,
                               std::span<const Segment> segments) {
    const geometry::Point2 at = place_on_way(segments, gap.middle_m());
    return fail(Errc::kUnreachable, "no_marker_chain",
                "Codes lie too far apart on the way. Lay one where it says.", {},
                {{"gap_m", gap.to_m - gap.from_m},
                 {"at_most_m", gap.at_most_m},
                 {"x_m", at.x_m},
                 {"y_m", at.y_m}});
}

}  // namespace

std::optional<Result<LegChain>> leg_chain(const plant::Plant& plant, const plant::HallId& hall,
                                          const CodeReach& reach, const plant::Station* station,
                                          std::span<const Segment> segments) {
    const bool by_beacons =
        reach.has_beacons() && !(plant.transmitters.empty() && plant.reflectors.empty());
    if (reach.cameras().empty() || plant.markers.empty() || by_beacons || segments.empty()) {
        return std::nullopt;
    }
    localisation::ChainTask task;
    task.passes = passes_of(plant, hall, reach, station, segments);
    task.length_m = whole_way_m(segments);
    task.start_sigma_m = sigma_at_start(reach);
    task.goal_within_m = caught_at_station(plant, reach, station);
    task.limit_m = kChainLimit_m;
    const auto turns = turns_on(segments);
    task.motion_m = WayErrors(turns, heading_by_codes(plant, task.passes), reach.noise());
    task.as_straight_m = [&](double from_m, double to_m) {
        return reach.as_straight_m(from_m, to_m, turns);
    };
    const auto found = localisation::segment_chain(task);
    if (!found) return no_chain(found.error(), segments);
    LegChain chain{{}, found->arrival_m, found->worst_m, task.limit_m};
    for (const auto& one : found->markers) {
        const plant::Marker& marker = plant.markers[one.code];
        chain.markers.push_back({marker.id, marker.payload, marker.pose.position(), one.at_m,
                                 one.before_m, one.after_m});
    }
    return chain;
}

}  // namespace pulseline::planning
