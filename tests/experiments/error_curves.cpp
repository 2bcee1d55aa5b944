#include "tests/experiments/error_curves.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace pulseline::experiments {

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void plot(const std::string& file, const std::vector<Curve>& curves, double every_m) {
    constexpr double kWidth = 900;
    constexpr double kHeight = 480;
    constexpr double kLeft = 70;
    constexpr double kBottom = 430;
    std::size_t most = 1;
    for (const Curve& curve : curves) most = std::max(most, curve.off_mm.size());
    const auto x = [&](std::size_t i) {
        return kLeft + static_cast<double>(i + 1) / static_cast<double>(most) * 560;
    };
    const auto y = [](double mm) {
        return kBottom - std::log10(std::max(0.1, mm) / 0.1) / 4 * 400;
    };
    std::ofstream svg(file);
    svg << fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"sans-serif\" font-size=\"13\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
        kWidth, kHeight);
    for (const double mm : {0.1, 1.0, 10.0, 100.0, 1000.0}) {
        svg << fmt::format(
            "<path d=\"M{} {:.1f}h560\" stroke=\"#ddd\"/><text x=\"{}\" y=\"{:.1f}\" "
            "text-anchor=\"end\">{} mm</text>\n",
            kLeft, y(mm), kLeft - 6, y(mm) + 4, mm);
    }
    for (const std::size_t i : {std::size_t{4}, std::size_t{9}, std::size_t{14}, std::size_t{19}}) {
        svg << fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{} m</text>\n", x(i),
                           kBottom + 20, (i + 1) * static_cast<std::size_t>(every_m));
    }
    constexpr std::array kColours{"#0b5cad", "#7a3e9d", "#00796b", "#c2410c", "#a16207",
                                  "#b91c1c", "#4b5563", "#be185d", "#3f6212", "#0e7490"};
    for (std::size_t c = 0; c < curves.size(); ++c) {
        const char* colour = kColours[c % kColours.size()];
        std::string points;
        for (std::size_t i = 0; i < curves[c].off_mm.size(); ++i)
            points += fmt::format("{:.1f},{:.1f} ", x(i), y(curves[c].off_mm[i]));
        svg << fmt::format(
            "<polyline points=\"{0}\" fill=\"none\" stroke=\"{1}\" stroke-width=\"2\">"
            "<title>{3}</title></polyline>\n<text x=\"645\" y=\"{2}\" fill=\"{1}\">{3}</text>\n",
            points, colour, 50 + 22 * c, curves[c].name);
    }
    svg << "</svg>\n";
    if (!svg.flush()) throw std::runtime_error("cannot write " + file);
    fmt::print("drawn in {}\n", file);
}

}  // namespace pulseline::experiments
