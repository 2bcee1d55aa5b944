#include "core/plant/vehicle_type.hpp"

#include <algorithm>

#include "core/geometry/convex.hpp"

namespace pulseline::plant {

double VehicleType::length_m() const {
    const geometry::Box box = geometry::bounding_box(footprint);
    return box.max.x_m - box.min.x_m;
}

std::vector<LaserScanner> usual_scanners(const Polygon& footprint) {
    const geometry::Box box = geometry::bounding_box(footprint);
    return {{"front left", {box.max.x_m, box.max.y_m, kPi / 4}},
            {"back right", {box.min.x_m, box.min.y_m, -3 * kPi / 4}}};
}

ParkingGear usual_parking(const Polygon& footprint) {
    const geometry::Box box = geometry::bounding_box(footprint);
    return {{{"front left", {box.max.x_m, box.max.y_m}},
             {"front right", {box.max.x_m, box.min.y_m}},
             {"back left", {box.min.x_m, box.max.y_m}},
             {"back right", {box.min.x_m, box.min.y_m}}}};
}

std::vector<Axis> axes_of(const VehicleType& type) {
    const AxisControl& control = type.control;
    std::vector<Axis> axes;
    for (const Wheel& wheel : type.wheels) {
        if (wheel.driven) axes.push_back({wheel.name + "/drive", control.drive_gain_per_s});
        if (wheel.steered) axes.push_back({wheel.name + "/steering", control.steering_gain_per_s});
    }
    for (const Bracket& bracket : type.brackets) {
        axes.push_back({bracket.name + "/bracket", control.lift_gain_per_s});
    }
    if (!type.parking) return axes;
    for (const ParkingFoot& foot : type.parking->feet) {
        axes.push_back({foot.name + "/foot", control.lift_gain_per_s});
    }
    return axes;
}

Polygon wheel_base(const VehicleType& type) {
    std::vector<Point2> wheels;
    for (const Wheel& wheel : type.wheels) wheels.push_back(wheel.position);
    return geometry::convex_hull(wheels);
}

std::vector<Camera> cameras_of(const VehicleType& type, bool loaded) {
    std::vector<Camera> cameras = type.cameras;
    for (Camera& camera : cameras) {
        if (!loaded || !camera.loaded) continue;
        static_cast<CameraMounting&>(camera) = *camera.loaded;
    }
    return cameras;
}

double reach_m(const std::vector<Polygon>& outline) {
    double reach_m = 0;
    for (const Polygon& piece : outline) {
        for (const Point2 corner : piece) reach_m = std::max(reach_m, norm(corner));
    }
    return reach_m;
}

std::vector<Polygon> outline_with_load(const VehicleType& type, bool loaded) {
    std::vector<Polygon> pieces = geometry::convex_pieces(type.footprint);
    if (loaded && !type.load_footprint.empty()) {
        for (Polygon& piece : geometry::convex_pieces(type.load_footprint)) {
            pieces.push_back(std::move(piece));
        }
    }
    return pieces;
}

const char* to_string(MotionMode mode) {
    switch (mode) {
        case MotionMode::kAuto:
            return "auto";
        case MotionMode::kSelfRotation:
            return "self_rotation";
        case MotionMode::kLinear:
            return "linear";
        case MotionMode::kFixedAxisRotation:
            return "fixed_axis_rotation";
        case MotionMode::kLateral:
            return "lateral";
        case MotionMode::kOblique:
            return "oblique";
        case MotionMode::kCombined:
            return "combined";
        case MotionMode::kFree:
            return "free";
    }
    return "auto";
}

std::optional<MotionMode> parse_motion_mode(const std::string& text) {
    for (const MotionMode mode : kMotionModes) {
        if (text == to_string(mode)) return mode;
    }
    return std::nullopt;
}

std::optional<MarkerKind> parse_marker_kind(const std::string& name) {
    for (const MarkerKind kind : {MarkerKind::kQr, MarkerKind::kAprilTag, MarkerKind::kLandmark}) {
        if (name == to_string(kind)) return kind;
    }
    return std::nullopt;
}

const char* to_string(Kinematics kinematics) {
    switch (kinematics) {
        case Kinematics::kSteeredPlatform:
            return "steered_platform";
        case Kinematics::kMecanum:
            return "mecanum";
        case Kinematics::kDifferential:
            return "differential";
    }
    return "steered_platform";
}

const char* to_string(MarkerKind kind) {
    switch (kind) {
        case MarkerKind::kQr:
            return "qr";
        case MarkerKind::kAprilTag:
            return "apriltag";
        case MarkerKind::kLandmark:
            return "landmark";
    }
    return "qr";
}

}  // namespace pulseline::plant
