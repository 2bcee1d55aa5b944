#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/plant/plant.hpp"
#include "core/vision/optics.hpp"

namespace pulseline::vision {

inline constexpr int kModules = 21;  // QR version 1

/// Where a code lies, in ideal pixels about the principal point: module coordinates (a right, b
/// down as printed, 0 at the centre, 1 = one module) are turned by angle, scaled and shifted.
struct CodePlacement {
    Pixel centre;
    double angle_rad = 0;
    double module_px = 1;

    Pixel at(double a, double b) const {
        const double c = module_px * std::cos(angle_rad);
        const double s = module_px * std::sin(angle_rad);
        return {centre.u + c * a - s * b, centre.v + s * a + c * b};
    }
};

/// What the standard prints in a module whatever the payload (true: dark); nothing for data.
std::optional<bool> fixed_module(int row, int column);

/// Grey level of each module and of the ring of quiet zone around them, and what is dark.
class ModuleGrid {
public:
    /// Samples the image about the centre of every module; nothing is assumed about the encoder.
    ModuleGrid(const cv::Mat& grey, const plant::Camera& camera, const CodePlacement& placement);

    static constexpr int kSide = kModules + 2;
    bool valid(int row, int column) const { return levels_[index(row, column)] >= 0; }
    float level(int row, int column) const { return levels_[index(row, column)]; }
    bool dark(int row, int column) const { return dark_[index(row, column)]; }
    float contrast() const { return contrast_; }
    /// Share of finder, separator and timing modules that are as the standard prints them.
    double fixed_pattern_share() const;

private:
    static std::size_t index(int row, int column) {  // -1 .. kModules
        return static_cast<std::size_t>((row + 1) * kSide + column + 1);
    }
    std::array<float, kSide * kSide> levels_{};
    std::array<bool, kSide * kSide> dark_{};
    float contrast_ = 0;
};

struct EdgeFit {
    CodePlacement placement;
    double sigma_px = 0;
    double sigma_angle_rad = 0;
    double rms_px = 0;
    double inlier_share = 0;
    int profiles = 0;
};

/// Robust fit of the placement to every dark/light transition between neighbouring modules. Input:
/// a placement good to about a quarter of a module. Method: sub-pixel edge position by area along
/// short profiles, Tukey-weighted least squares in four parameters, lens distortion known
/// (vision.md, finding 2). Nothing when too few edges are visible.
std::optional<EdgeFit> fit_edges(const cv::Mat& grey, const plant::Camera& camera,
                                 const ModuleGrid& modules, const CodePlacement& start);

}  // namespace pulseline::vision
