#pragma once

#include <string>
#include <vector>

namespace pulseline::experiments {

struct Curve {
    std::string name;
    std::vector<double> off_mm;  // at each checkpoint
};

/// Draws errors over distance as an SVG file, logarithmic, one line a curve. `every_m`: the way
/// between two checkpoints.
void plot(const std::string& file, const std::vector<Curve>& curves, double every_m);

}  // namespace pulseline::experiments
