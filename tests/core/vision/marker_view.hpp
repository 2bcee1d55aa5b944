#pragma once

#include <string>
#include <vector>

#include "core/plant/marker_geometry.hpp"
#include "core/simulation/world/floor_camera.hpp"
#include "core/vision/marker_reader.hpp"

namespace pulseline::vision {

/// A rendered view: the vehicle stands at the origin, so hall and body frame are one.
struct MarkerView {
    plant::MarkerKind kind = plant::MarkerKind::kAprilTag;
    std::string payload = "17";
    plant::Camera camera;
    geometry::Pose2 camera_from_code{0.004, -0.003, 1.2};
    double size_m = 0;  // 0: usual
    bool mirrored = false;
    simulation::ImageConditions conditions;

    simulation::FloorCode code() const {
        return {payload, camera_from_code, size_m > 0 ? size_m : plant::usual_size_m(kind),
                mirrored, kind};
    }
    cv::Mat image() const {
        const std::vector<simulation::FloorCode> codes{code()};
        return simulation::render_floor(camera, {}, codes, conditions);
    }
    Pixel true_centre() const {
        return simulation::FloorProjection(camera, conditions)
            .image_from_floor(camera_from_code.position());
    }
    double error_px(const MarkerReading& reading) const {
        const Pixel d = reading.centre - true_centre();
        return std::hypot(d.u, d.v);
    }
    ReadResult read() const { return read_marker(kind, image(), camera); }
};

}  // namespace pulseline::vision
