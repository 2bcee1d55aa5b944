#include "core/simulation/world/floor_print.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/plant/marker_geometry.hpp"
#include "core/simulation/world/printed_sheet.hpp"

namespace pulseline::simulation {
namespace {

struct Corner {
    SheetPoint point;
    int region = 0;
};

/// Pixels that can show a square sheet of the given half side, whichever way it is turned.
cv::Rect reach_of(const cv::Mat& scene, double half_m, const Pose2& camera_from_code,
                  const FloorProjection& projection) {
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (int i = 0; i < 4; ++i) {
        const double angle = (i + 0.5) * kPi / 2;
        const double reach = half_m * std::sqrt(2.0);
        const vision::Pixel p = projection.image_from_floor(
            camera_from_code * geometry::Point2{reach * std::cos(angle), reach * std::sin(angle)});
        left = std::min(left, p.u);
        right = std::max(right, p.u);
        top = std::min(top, p.v);
        bottom = std::max(bottom, p.v);
    }
    constexpr double kMargin_px = 6;  // distortion bends the sides between the corners
    const auto pixel = [](double value, int end) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(end)));
    };
    return {
        cv::Point(pixel(left - kMargin_px, scene.cols), pixel(top - kMargin_px, scene.rows)),
        cv::Point(pixel(right + kMargin_px, scene.cols), pixel(bottom + kMargin_px, scene.rows))};
}

template <class Sheet>
void print_sheet(cv::Mat& scene, const Sheet& sheet, double unit_m, const Pose2& camera_from_code,
                 const FloorProjection& projection, const FloorRows& corners) {
    const double half = sheet.side() / 2;
    const cv::Rect reach = reach_of(scene, unit_m * half, camera_from_code, projection);
    // Code frame: x up, y to the left. Sheet: right and down, from its top left corner.
    const Pose2 code_from_camera = inverse(camera_from_code);
    const double c = std::cos(code_from_camera.heading_rad) / unit_m;
    const double s = std::sin(code_from_camera.heading_rad) / unit_m;
    const double up0 = code_from_camera.x_m / unit_m;
    const double left0 = code_from_camera.y_m / unit_m;
    std::vector<Corner> upper(static_cast<std::size_t>(reach.width) + 1);
    std::vector<Corner> lower(upper.size());
    const auto fill = [&](std::vector<Corner>& line, int v) {
        const cv::Vec2f* row = corners(v) + reach.x;
        for (Corner& corner : line) {
            const double x = static_cast<double>((*row)[0]);
            const double y = static_cast<double>((*row)[1]);
            corner.point = {half - (left0 + s * x + c * y), half - (up0 + c * x - s * y)};
            corner.region = sheet.region(corner.point);
            ++row;
        }
    };
    fill(upper, reach.y);
    for (int v = reach.y; v < reach.y + reach.height; ++v) {
        fill(lower, v + 1);
        auto* row = scene.ptr<float>(v) + reach.x;
        for (std::size_t i = 0; i + 1 < upper.size(); ++i, ++row) {
            const int region = upper[i].region;
            if (region == upper[i + 1].region && region == lower[i].region &&
                region == lower[i + 1].region) {
                *row = sheet.reflectance(region, *row);
                continue;
            }
            Piece quad;
            quad.push(upper[i].point);
            quad.push(upper[i + 1].point);
            quad.push(lower[i + 1].point);
            quad.push(lower[i].point);
            *row = sheet.mean(quad, *row);
        }
        std::swap(upper, lower);
    }
}

int landmark_code(const std::string& payload) {
    int code = -1;
    const char* end = payload.data() + payload.size();
    const auto parsed = std::from_chars(payload.data(), end, code);
    if (parsed.ec != std::errc() || parsed.ptr != end || !plant::landmark::is_code(code))
        throw std::invalid_argument("\"" + payload + "\" is no landmark code (1 to 254)");
    return code;
}

}  // namespace

void print_code(cv::Mat& scene, const FloorCode& code, const Pose2& camera_from_code,
                const FloorProjection& projection, const FloorRows& corners) {
    switch (code.kind) {
        case plant::MarkerKind::kLandmark: {
            const LandmarkSheet sheet(landmark_code(code.payload), code.mirrored);
            const double outer = 2 * plant::landmark::kOuter_m;
            print_sheet(scene, sheet, 0.001 * code.size_m / outer, camera_from_code, projection,
                        corners);
            break;
        }
        case plant::MarkerKind::kQr:
        case plant::MarkerKind::kAprilTag: {
            const CellSheet sheet(code.kind, code.payload, code.mirrored);
            const int cells =
                code.kind == plant::MarkerKind::kQr ? plant::kQrModules : plant::kTagCells;
            print_sheet(scene, sheet, code.size_m / cells, camera_from_code, projection, corners);
            break;
        }
    }
}

}  // namespace pulseline::simulation
