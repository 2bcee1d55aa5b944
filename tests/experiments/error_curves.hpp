#pragma once

#include <string>
#include <vector>

namespace pulseline::experiments {

struct Curve {
    std::string name;
    std::vector<double> off_mm;  // at each checkpoint
};

/// Value that `share` of them do not exceed; 0 of none.
double quantile(std::vector<double> values, double share);

/// Draws errors over distance as an SVG file, logarithmic, one line a curve, and prints where.
/// `every_m`: the way between two checkpoints. Throws std::runtime_error when it cannot be written.
void plot(const std::string& file, const std::vector<Curve>& curves, double every_m);

}  // namespace pulseline::experiments
