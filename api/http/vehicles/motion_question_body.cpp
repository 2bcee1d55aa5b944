#include "api/http/vehicles/motion_question_body.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "api/http/wire/body.hpp"
#include "api/http/wire/query.hpp"
#include "core/base/angle.hpp"

namespace pulseline::api {
namespace {

using json::Json;
using json::ObjectReader;
using plant::MotionMode;

constexpr double kMaxCoordinate_m = 1e5;  // no hall is larger
constexpr double kMaxHeading_rad = 6.2832;

std::optional<geometry::Pose2> read_pose_if_any(ObjectReader& in, const char* name) {
    auto member = in.object_if_any(name);
    if (!member) return std::nullopt;
    const geometry::Pose2 pose = read_pose_members(*member);
    member->refuse_unknown();
    return pose;
}

/// kAuto is no mode of its own: `suggested` says what it takes.
void read_mode(const Json& item, const std::string& at, json::FieldErrors& errors,
               std::vector<MotionMode>& modes) {
    const auto mode = plant::parse_motion_mode(json::read_text(item, at, errors, kName));
    if (mode && *mode != MotionMode::kAuto) {
        modes.push_back(*mode);
    } else if (item.is_string()) {
        std::string allowed;
        for (const MotionMode m : plant::kMotionModes) {
            if (m == MotionMode::kAuto) continue;
            allowed += (allowed.empty() ? "" : ", ") + std::string(plant::to_string(m));
        }
        errors.add(at, {"not_one_of", {{"allowed", allowed}}}, "Expected one of: " + allowed + ".");
    }
}

}  // namespace

geometry::Pose2 read_pose_members(ObjectReader& in) {
    geometry::Pose2 pose;
    pose.x_m = in.number("x_m", {-kMaxCoordinate_m, kMaxCoordinate_m});
    pose.y_m = in.number("y_m", {-kMaxCoordinate_m, kMaxCoordinate_m});
    pose.heading_rad = wrap(in.number("heading_rad", {-kMaxHeading_rad, kMaxHeading_rad}));
    return pose;
}

fleet::MotionQuestion read_motion_question_body(ObjectReader& in) {
    fleet::MotionQuestion read;
    read.vehicle = plant::VehicleId(in.text("vehicle", kName));
    if (in.has("station")) {
        read.station = static_cast<int>(in.integer("station", {0, kMaxStation}));
    }
    read.target = read_pose_if_any(in, "target");
    if (in.has("station") == in.has("target")) {
        const char* field = in.has("station") ? "/target" : "/station";
        in.errors().add(in.pointer() + field, {"station_or_target", {}},
                        "Give either a station or a target pose.");
    }
    read.hall = plant::HallId(in.text_or("hall", "", kName));
    read.start = read_pose_if_any(in, "start");
    if (in.has("loaded")) read.loaded = in.boolean("loaded");
    in.items_if_any("modes", {1, plant::kMotionModes.size() - 1},
                    [&](const Json& item, const std::string& at) {
                        read_mode(item, at, in.errors(), read.modes);
                    });
    return read;
}

}  // namespace pulseline::api
