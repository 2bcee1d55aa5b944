#include "core/kinematics/motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/kinematics/arc.hpp"
#include "core/kinematics/primitives.hpp"

namespace pulseline::kinematics {
namespace {

using Variants = std::vector<MotionPlan>;

constexpr double kThere_m = 0.001;
constexpr double kThere_rad = radians(0.005);
// A measured stop is this far off its drawing at most (Tang 2020: +-25 mm); the correction at the
// next stop takes it up, a turn on the spot cannot.
constexpr double kInPlace_m = 0.025;
constexpr double kTie_s = 1e-6;           // equal times up to rounding: forwards first
constexpr double kLargestRadius_m = 1e6;  // said of a target exactly on the heading line

const char* label(MotionMode mode) {
    switch (mode) {
        case MotionMode::kSelfRotation:
            return "self rotation";
        case MotionMode::kLinear:
            return "linear motion";
        case MotionMode::kFixedAxisRotation:
            return "fixed-axis rotation";
        case MotionMode::kLateral:
            return "lateral motion";
        case MotionMode::kOblique:
            return "oblique motion";
        case MotionMode::kCombined:
            return "combined motion";
        case MotionMode::kFree:
            return "free motion";
        case MotionMode::kAuto:
            break;
    }
    return "automatic choice";
}

Error not_supported(const plant::VehicleType& type, MotionMode mode) {
    return {Errc::kUnreachable,
            {"mode_not_supported",
             {{"mode", std::string(plant::to_string(mode))}, {"vehicle_type", type.id.str()}}},
            type.name + " cannot drive " + label(mode) + ". Choose one of its own motion modes.",
            {}};
}

MotionPlan finish(const plant::VehicleType& type, MotionMode mode, std::vector<Segment> segments) {
    set_durations(type, segments);
    return summed(mode, std::move(segments));
}

Pose2 at(Point2 position, double heading_rad) {
    return {position.x_m, position.y_m, wrap(heading_rad)};
}

Result<Variants> self_rotation(const plant::VehicleType& type, const Pose2& from, const Pose2& to) {
    const double away = geometry::distance(from.position(), to.position());
    if (away > kInPlace_m) {
        return fail(Errc::kUnreachable, "not_in_place",
                    "Self rotation keeps the position, and the target is elsewhere. Choose linear "
                    "motion or fixed-axis rotation.",
                    {}, {{"distance_m", away}});
    }
    std::vector<Segment> segments;
    append_turn(segments, from, shortest_turn_rad(from.heading_rad, to.heading_rad));
    return Variants{finish(type, MotionMode::kSelfRotation, std::move(segments))};
}

/// Turn, drive straight forwards or backwards, turn (Tang 2020 eq. 4 to 6, corrected).
MotionPlan linear_run(const plant::VehicleType& type, const Pose2& from, const Pose2& to,
                      bool backwards) {
    const Point2 way = to.position() - from.position();
    std::vector<Segment> segments;
    if (norm(way) < kNothing) {
        append_turn(segments, from, shortest_turn_rad(from.heading_rad, to.heading_rad));
        return finish(type, MotionMode::kLinear, std::move(segments));
    }
    const double heading = wrap(std::atan2(way.y_m, way.x_m) + (backwards ? kPi : 0));
    append_turn(segments, from, shortest_turn_rad(from.heading_rad, heading));
    append_straight(segments, at(from.position(), heading), to.position());
    append_turn(segments, at(to.position(), heading), shortest_turn_rad(heading, to.heading_rad));
    return finish(type, MotionMode::kLinear, std::move(segments));
}

Result<Variants> linear(const plant::VehicleType& type, const Pose2& from, const Pose2& to) {
    Variants variants{linear_run(type, from, to, false), linear_run(type, from, to, true)};
    if (variants[1].turn_rad < variants[0].turn_rad - kNothing) std::swap(variants[0], variants[1]);
    return variants;
}

Result<Variants> fixed_axis_rotation(const plant::VehicleType& type, const Pose2& from,
                                     const Pose2& to) {
    const auto arc = tangent_arc(from, to.position());
    const double radius = arc ? std::abs(arc->rho_m) : kLargestRadius_m;
    if (!arc || radius > type.max_arc_radius_m) {
        return fail(Errc::kUnreachable, "target_on_heading_line",
                    "The target lies on the platform's heading line, so no arc leads there (Tang "
                    "2020 eq. 7). Choose linear motion.",
                    {},
                    {{"offset_m", arc ? std::abs(arc->offset_m) : 0.0},
                     {"radius_m", std::min(radius, kLargestRadius_m)},
                     {"limit_m", type.max_arc_radius_m}});
    }
    if (radius < type.min_turn_radius_m) {
        return fail(Errc::kUnreachable, "turn_radius_too_small",
                    "The arc to the target is tighter than the vehicle can drive. Choose linear "
                    "motion.",
                    {}, {{"radius_m", radius}, {"limit_m", type.min_turn_radius_m}});
    }
    Variants variants;
    for (const bool backwards : {false, true}) {
        std::vector<Segment> segments;
        append_arc(segments, from, arc->centre, arc->turn_rad(backwards), backwards, to.position());
        append_turn(segments, at(to.position(), arc->arrival_rad),
                    shortest_turn_rad(arc->arrival_rad, to.heading_rad));
        variants.push_back(finish(type, MotionMode::kFixedAxisRotation, std::move(segments)));
    }
    if (variants[1].duration_s < variants[0].duration_s - kTie_s) {
        std::swap(variants[0], variants[1]);
    }
    return variants;
}

Result<Variants> lateral(const plant::VehicleType& type, const Pose2& from, const Pose2& to) {
    const Point2 in_body = inverse(from) * to.position();
    if (std::abs(in_body.x_m) > kInPlace_m) {
        return fail(Errc::kUnreachable, "not_beside",
                    "Lateral motion goes straight sideways, and the target lies ahead or behind. "
                    "Choose linear motion.",
                    {}, {{"along_m", in_body.x_m}});
    }
    std::vector<Segment> segments;
    append_straight(segments, from, to.position());
    append_turn(segments, at(to.position(), from.heading_rad),
                shortest_turn_rad(from.heading_rad, to.heading_rad));
    return Variants{finish(type, MotionMode::kLateral, std::move(segments))};
}

/// Straight there in whatever direction with the heading kept, then the turn.
Result<Variants> oblique(const plant::VehicleType& type, const Pose2& from, const Pose2& to) {
    std::vector<Segment> segments;
    append_straight(segments, from, to.position());
    append_turn(segments, at(to.position(), from.heading_rad),
                shortest_turn_rad(from.heading_rad, to.heading_rad));
    return Variants{finish(type, MotionMode::kOblique, std::move(segments))};
}

/// Straight there while turning, either way round. Not with steered wheels: they would have to turn
/// all the way.
Result<Variants> combined(const plant::VehicleType& type, const Pose2& from, const Pose2& to) {
    if (type.kinematics != plant::Kinematics::kMecanum)
        return fail(not_supported(type, MotionMode::kCombined));
    const double shortest = shortest_turn_rad(from.heading_rad, to.heading_rad);
    const double other = shortest - std::copysign(2 * kPi, shortest);
    Variants variants;
    for (const double turn_rad : {shortest, other}) {
        std::vector<Segment> segments;
        append_combined(segments, from, to.position(), turn_rad);
        variants.push_back(finish(type, MotionMode::kCombined, std::move(segments)));
        if (std::abs(shortest) < kNothing) break;
    }
    return variants;
}

/// The first of the ways that the type's wheels can follow, or why none can.
Result<Variants> drivable(const plant::VehicleType& type, Variants variants) {
    std::optional<Error> refusal;
    std::erase_if(variants, [&](const MotionPlan& plan) {
        for (const Segment& segment : plan.segments) {
            if (const auto wheels = wheels_of(type, twist_along(segment, 0)); !wheels) {
                if (!refusal) refusal = wheels.error();
                return true;
            }
        }
        return false;
    });
    if (variants.empty()) return fail(std::move(*refusal));
    return variants;
}

Result<Variants> ways(const plant::VehicleType& type, const Pose2& from, const Pose2& to,
                      MotionMode mode) {
    switch (mode) {
        case MotionMode::kSelfRotation:
            return self_rotation(type, from, to);
        case MotionMode::kLinear:
            return linear(type, from, to);
        case MotionMode::kFixedAxisRotation:
            return fixed_axis_rotation(type, from, to);
        case MotionMode::kLateral:
            return lateral(type, from, to);
        case MotionMode::kOblique:
            return oblique(type, from, to);
        case MotionMode::kCombined:
            return combined(type, from, to);
        case MotionMode::kAuto:
        case MotionMode::kFree:
            break;
    }
    return fail(not_supported(type, mode));
}

}  // namespace

bool is_there(const Pose2& from, const Pose2& to) {
    return geometry::distance(from.position(), to.position()) <= kThere_m &&
           std::abs(wrap(to.heading_rad - from.heading_rad)) <= kThere_rad;
}

Result<std::vector<MotionPlan>> motion_variants(const plant::VehicleType& type, const Pose2& from,
                                                const Pose2& to, MotionMode mode) {
    const auto& modes = type.motion_modes;
    if (std::find(modes.begin(), modes.end(), mode) == modes.end()) {
        return fail(not_supported(type, mode));
    }
    if (is_there(from, to)) {
        return fail(Errc::kUnreachable, "already_there",
                    "The vehicle already stands at the target. Nothing to drive.");
    }
    return ways(type, from, to, mode).and_then([&](Variants variants) {
        return drivable(type, std::move(variants));
    });
}

Result<MotionPlan> plan_motion(const plant::VehicleType& type, const Pose2& from, const Pose2& to,
                               MotionMode mode) {
    return motion_variants(type, from, to, mode).map([](std::vector<MotionPlan> variants) {
        return std::move(variants.front());
    });
}

}  // namespace pulseline::kinematics
