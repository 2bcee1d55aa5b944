#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/plant/plant.hpp"

/// Camera images as the operator sees them.
namespace pulseline::vision {

inline constexpr std::size_t kMaxPictureBytes = 60'000;

/// Half-size colour copy of a grey image with a dashed crosshair on the optical axis and, when a
/// code was found (its centre and "up" direction in the body frame), blue corner brackets about it
/// and the offset from axis to code.
cv::Mat annotate(const cv::Mat& grey, const plant::Camera& camera,
                 const std::optional<geometry::Pose2>& body_from_code, double code_size_m = 0.060);

/// JPEG at half the camera's size, of the best quality that fits `max_bytes`. A picture that is
/// already half size (annotate) is left as it is.
std::vector<std::uint8_t> encode_jpeg(const cv::Mat& image, const plant::Camera& camera,
                                      std::size_t max_bytes = kMaxPictureBytes);

}  // namespace pulseline::vision
