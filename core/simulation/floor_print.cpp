#include "core/simulation/floor_print.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <opencv2/objdetect.hpp>

namespace pulseline::simulation {
namespace {

constexpr float kPaper = 0.90F;
constexpr float kInk = 0.05F;
constexpr int kQuiet = 4;
constexpr int kSheet = kQrModules + 2 * kQuiet;

struct Corner {
    float x = 0;  // modules, from the sheet's left edge to the right
    float y = 0;  // downwards
};

/// Convex polygon of at most 8 corners, on the stack.
struct Piece {
    std::array<Corner, 8> at;
    int count = 0;
    void push(Corner c) { at[static_cast<std::size_t>(count++)] = c; }
    const Corner& operator[](int i) const { return at[static_cast<std::size_t>(i)]; }
    float area() const {
        float twice = 0;
        for (int i = 0; i < count; ++i) {
            const Corner& a = (*this)[i];
            const Corner& b = (*this)[(i + 1) % count];
            twice += (a.x - at[0].x) * (b.y - at[0].y) - (b.x - at[0].x) * (a.y - at[0].y);
        }
        return std::abs(twice) / 2;
    }
};

/// The part of a piece on one side of a grid line x = line (or y = line).
Piece clipped(const Piece& piece, float Corner::*axis, float line, bool keep_below) {
    Piece kept;
    for (int i = 0; i < piece.count; ++i) {
        const Corner& a = piece[i];
        const Corner& b = piece[(i + 1) % piece.count];
        const bool in_a = (a.*axis < line) == keep_below;
        const bool in_b = (b.*axis < line) == keep_below;
        if (in_a) kept.push(a);
        if (in_a != in_b) {
            const float t = (line - a.*axis) / (b.*axis - a.*axis);
            kept.push({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
    }
    return kept;
}

/// Reflectance of the sheet's cells; the bare floor around them.
struct Sheet {
    std::array<std::array<float, kSheet>, kSheet> cells{};

    Sheet(const QrModules& modules, bool mirrored) {
        for (auto& row : cells) row.fill(kPaper);
        for (std::size_t r = 0; r < kQrModules; ++r)
            for (std::size_t c = 0; c < kQrModules; ++c)
                if (modules[r][mirrored ? kQrModules - 1 - c : c])
                    cells[r + kQuiet][c + kQuiet] = kInk;
    }
    float at(int column, int row, float floor) const {
        if (column < 0 || row < 0 || column >= kSheet || row >= kSheet) return floor;
        return cells[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    }
    /// Mean over a quadrilateral that is smaller than a cell.
    float mean(const Piece& quad, float floor) const {
        float low_x = quad[0].x, high_x = low_x, low_y = quad[0].y, high_y = low_y;
        for (int i = 1; i < 4; ++i) {
            low_x = std::min(low_x, quad[i].x);
            high_x = std::max(high_x, quad[i].x);
            low_y = std::min(low_y, quad[i].y);
            high_y = std::max(high_y, quad[i].y);
        }
        const int left = static_cast<int>(std::floor(low_x));
        const int right = static_cast<int>(std::floor(high_x));
        const int top = static_cast<int>(std::floor(low_y));
        const int bottom = static_cast<int>(std::floor(high_y));
        const float first = at(left, top, floor);
        if (first == at(right, top, floor) && first == at(left, bottom, floor) &&
            first == at(right, bottom, floor))
            return first;
        float sum = 0;
        float area = 0;
        for (const bool below_x : {true, false}) {
            if (!below_x && left == right) break;
            const Piece half = left == right
                                   ? quad
                                   : clipped(quad, &Corner::x, static_cast<float>(right), below_x);
            for (const bool below_y : {true, false}) {
                if (!below_y && top == bottom) break;
                const Piece part =
                    top == bottom ? half
                                  : clipped(half, &Corner::y, static_cast<float>(bottom), below_y);
                const float a = part.count < 3 ? 0 : part.area();
                sum += a * at(below_x ? left : right, below_y ? top : bottom, floor);
                area += a;
            }
        }
        return area > 0 ? sum / area : first;
    }
};

}  // namespace

QrModules qr_modules(const std::string& payload) {
    static std::mutex guard;  // simulated vehicles render in several threads
    static std::map<std::string, QrModules> cache;
    const std::scoped_lock lock(guard);
    if (const auto known = cache.find(payload); known != cache.end()) return known->second;
    cv::QRCodeEncoder::Params params;
    params.version = 1;
    params.correction_level = cv::QRCodeEncoder::CORRECT_LEVEL_Q;
    cv::Mat image;
    cv::QRCodeEncoder::create(params)->encode(payload, image);
    QrModules modules{};
    const int border = (image.cols - kQrModules) / 2;
    for (int r = 0; r < kQrModules; ++r)
        for (int c = 0; c < kQrModules; ++c)
            modules[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] =
                image.at<std::uint8_t>(r + border, c + border) < 128;
    return cache.emplace(payload, modules).first->second;
}

void print_code(cv::Mat& scene, const FloorCode& code, const Pose2& camera_from_code,
                const FloorProjection& projection,
                const std::function<const cv::Vec2f*(int)>& corners) {
    const double module_m = code.size_m / kQrModules;
    const double half_m = module_m * kSheet / 2;
    // Bounding box in the image of the octagon through the corners, whichever way it is turned.
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (int i = 0; i < 8; ++i) {
        const double angle = i * kPi / 4;
        const double reach = half_m * std::sqrt(2.0);
        const vision::Pixel p = projection.image_from_floor(
            camera_from_code * geometry::Point2{reach * std::cos(angle), reach * std::sin(angle)});
        left = std::min(left, p.u);
        right = std::max(right, p.u);
        top = std::min(top, p.v);
        bottom = std::max(bottom, p.v);
    }
    constexpr double kMargin_px = 4;
    const auto pixel = [](double value, int end) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(end)));
    };
    const int u0 = pixel(left - kMargin_px, scene.cols), u1 = pixel(right + kMargin_px, scene.cols);
    const int v0 = pixel(top - kMargin_px, scene.rows), v1 = pixel(bottom + kMargin_px, scene.rows);

    // Code frame: x up, y to the left. Sheet coordinates: right and down, from its top left corner.
    const Pose2 code_from_camera = inverse(camera_from_code);
    const double c = std::cos(code_from_camera.heading_rad) / module_m;
    const double s = std::sin(code_from_camera.heading_rad) / module_m;
    const double up0 = code_from_camera.x_m / module_m;
    const double left0 = code_from_camera.y_m / module_m;
    const auto to_sheet = [&](const cv::Vec2f& p) {
        const double up = up0 + c * p[0] - s * p[1];
        const double leftward = left0 + s * p[0] + c * p[1];
        return Corner{static_cast<float>(kSheet / 2.0 - leftward),
                      static_cast<float>(kSheet / 2.0 - up)};
    };
    const Sheet sheet(qr_modules(code.payload), code.mirrored);
    std::vector<Corner> upper(static_cast<std::size_t>(std::max(0, u1 - u0) + 1));
    std::vector<Corner> lower(upper.size());
    const auto fill = [&](std::vector<Corner>& line, int v) {
        const cv::Vec2f* row = corners(v);
        for (std::size_t i = 0; i < line.size(); ++i)
            line[i] = to_sheet(row[u0 + static_cast<int>(i)]);
    };
    fill(upper, v0);
    for (int v = v0; v < v1; ++v) {
        fill(lower, v + 1);
        auto* row = scene.ptr<float>(v);
        for (int u = u0; u < u1; ++u) {
            const auto i = static_cast<std::size_t>(u - u0);
            Piece quad;
            quad.push(upper[i]);
            quad.push(upper[i + 1]);
            quad.push(lower[i + 1]);
            quad.push(lower[i]);
            row[u] = sheet.mean(quad, row[u]);
        }
        std::swap(upper, lower);
    }
}

}  // namespace pulseline::simulation
