#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/marker_reader.hpp"
#include "core/vision/optics/optics.hpp"

/// Everything that is compared in bench_vision, behind one shape.
namespace pulseline::bench {

struct Found {
    std::string payload;  // empty: the method does not read it
    vision::Pixel centre;
    double angle_rad = 0;
    bool turns_by_quarters = false;  // the angle is known modulo a quarter turn only
    double sigma_px = 0;             // 0: the method states none
};
struct Outcome {
    std::optional<Found> found;
    std::string refused;  // reason, when nothing was found
};
struct Method {
    std::string name;
    Outcome (*run)(const cv::Mat& grey, const plant::Camera& camera);
};

/// The program's own reader.
Outcome read_ours(plant::MarkerKind kind, const cv::Mat& grey, const plant::Camera& camera,
                  const vision::ReaderOptions& options);

/// First the program's own reader, then libraries and the papers' pipelines.
std::vector<Method> methods(plant::MarkerKind kind);

}  // namespace pulseline::bench
