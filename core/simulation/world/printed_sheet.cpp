#include "core/simulation/world/printed_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/plant/marker_geometry.hpp"
#include "core/printing/marker_cells.hpp"

namespace pulseline::simulation {
namespace {

namespace landmark = plant::landmark;
constexpr double kMillimetre = 1000;

/// Signed area between the chord p q (about the disc's centre) and the centre, inside the disc.
double sweep_in_disc(SheetPoint p, SheetPoint q, double r) {
    const auto sector = [r](SheetPoint a, SheetPoint b) {
        return r * r / 2 * std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    };
    const double dx = q.x - p.x;
    const double dy = q.y - p.y;
    const double a = dx * dx + dy * dy;
    if (a == 0) return 0;
    const double b = (p.x * dx + p.y * dy) / a;
    const double c = (p.x * p.x + p.y * p.y - r * r) / a;
    const double root = b * b - c;
    if (root <= 0) return sector(p, q);
    const double enter = std::clamp(-b - std::sqrt(root), 0.0, 1.0);
    const double leave = std::clamp(-b + std::sqrt(root), 0.0, 1.0);
    if (enter >= leave) return sector(p, q);
    const SheetPoint in{p.x + enter * dx, p.y + enter * dy};
    const SheetPoint out{p.x + leave * dx, p.y + leave * dy};
    return sector(p, in) + (in.x * out.y - in.y * out.x) / 2 + sector(out, q);
}

}  // namespace

double Piece::area() const {
    double twice = 0;
    for (int i = 1; i + 1 < count; ++i)
        twice += ((*this)[i].x - at[0].x) * ((*this)[i + 1].y - at[0].y) -
                 ((*this)[i + 1].x - at[0].x) * ((*this)[i].y - at[0].y);
    return std::abs(twice) / 2;
}

Piece Piece::beyond(double nx, double ny, double limit) const {
    Piece kept;
    for (int i = 0; i < count; ++i) {
        const SheetPoint& a = (*this)[i];
        const SheetPoint& b = (*this)[(i + 1) % count];
        const double da = nx * a.x + ny * a.y - limit;
        const double db = nx * b.x + ny * b.y - limit;
        if (da >= 0) kept.push(a);
        if ((da >= 0) != (db >= 0)) {
            const double t = da / (da - db);
            kept.push({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
    }
    return kept;
}

double Piece::area_in_disc(SheetPoint centre, double radius) const {
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        const SheetPoint& a = (*this)[i];
        const SheetPoint& b = (*this)[(i + 1) % count];
        sum += sweep_in_disc({a.x - centre.x, a.y - centre.y}, {b.x - centre.x, b.y - centre.y},
                             radius);
    }
    return std::abs(sum);
}

CellSheet::CellSheet(plant::MarkerKind kind, const std::string& payload, bool mirrored) {
    const auto cells = printing::marker_cells(kind, payload);
    if (!cells) throw std::invalid_argument(cells.error().what);
    side_ = cells->side + 2 * cells->quiet;
    cells_.assign(static_cast<std::size_t>(side_ * side_), kPaper);
    for (int row = 0; row < cells->side; ++row)
        for (int column = 0; column < cells->side; ++column)
            if (cells->at(row, mirrored ? cells->side - 1 - column : column))
                cells_[static_cast<std::size_t>((row + cells->quiet) * side_ + column +
                                                cells->quiet)] = kInk;
}

float CellSheet::mean(const Piece& quad, float floor) const {
    double low_x = quad[0].x, high_x = low_x, low_y = quad[0].y, high_y = low_y;
    for (int i = 1; i < quad.count; ++i) {
        low_x = std::min(low_x, quad[i].x);
        high_x = std::max(high_x, quad[i].x);
        low_y = std::min(low_y, quad[i].y);
        high_y = std::max(high_y, quad[i].y);
    }
    const double line_x = std::floor(high_x);
    const double line_y = std::floor(high_y);
    const bool one_column = line_x <= low_x;
    const bool one_row = line_y <= low_y;
    const auto at = [&](int right, int below) {
        return reflectance(region({line_x - 0.5 + right, line_y - 0.5 + below}), floor);
    };
    double sum = 0;
    double area = 0;
    for (const int right : {0, 1}) {
        if (right == 0 && one_column) continue;
        const Piece half =
            one_column ? quad
                       : (right == 1 ? quad.beyond(1, 0, line_x) : quad.beyond(-1, 0, -line_x));
        for (const int below : {0, 1}) {
            if (below == 0 && one_row) continue;
            const double a =
                one_row
                    ? half.area()
                    : (below == 1 ? half.beyond(0, 1, line_y) : half.beyond(0, -1, -line_y)).area();
            sum += a * static_cast<double>(at(right, below));
            area += a;
        }
    }
    return area > 0 ? static_cast<float>(sum / area) : at(1, 1);
}

int LandmarkSheet::region(SheetPoint p) const {
    if (!(p.x >= 0 && p.y >= 0 && p.x < kSide && p.y < kSide)) return -1;
    // Squared millimetres: a root for each of a million corners would cost a fifth of the image.
    const double right = as_printed(p).x - kMiddle.x;
    const double up = kMiddle.y - p.y;
    const double r2 = right * right + up * up;
    constexpr auto kSquare = [](double metres) {
        return kMillimetre * kMillimetre * metres * metres;
    };
    if (r2 > kSquare(landmark::kOuter_m)) return 0;
    if (r2 > kSquare(landmark::kInner_m)) {
        const int k = landmark::sector(right, up);
        return landmark::sector_dark(code_, k) ? 10 + k : 0;
    }
    for (std::size_t i = 0; i < landmark::kDots.size(); ++i) {
        const double x = right - kMillimetre * landmark::kDots[i].right_m;
        const double y = up - kMillimetre * landmark::kDots[i].up_m;
        if (x * x + y * y < kSquare(landmark::kDot_m)) return 1 + static_cast<int>(i);
    }
    return 0;
}

double LandmarkSheet::dark_ring_area(const Piece& quad) const {
    const auto in_ring = [&](const Piece& part) {
        return part.area_in_disc(kMiddle, kMillimetre * landmark::kOuter_m) -
               part.area_in_disc(kMiddle, kMillimetre * landmark::kInner_m);
    };
    double sum = 0;
    // Cut at the borders of the sectors; a piece of the ring touches two of them at most.
    for (int k = 0; k < landmark::kSectors; ++k) {
        if (!landmark::sector_dark(code_, k)) continue;
        const double from = k * kPi / 4;
        const double to = (k + 1) * kPi / 4;
        // Direction t has right sin t, down -cos t; clockwise of it lies (cos t, sin t).
        const auto clockwise_of = [&](const Piece& piece, double t, double sign) {
            const double nx = sign * std::cos(t);
            const double ny = sign * std::sin(t);
            return piece.beyond(nx, ny, nx * kMiddle.x + ny * kMiddle.y);
        };
        const Piece part = clockwise_of(clockwise_of(quad, from, 1), to, -1);
        if (part.count >= 3) sum += in_ring(part);
    }
    return sum;
}

float LandmarkSheet::mean(const Piece& quad, float floor) const {
    Piece piece;
    for (int i = 0; i < quad.count; ++i) piece.push(as_printed(quad[i]));
    const double whole = piece.area();
    const Piece on_sheet =
        piece.beyond(1, 0, 0).beyond(-1, 0, -kSide).beyond(0, 1, 0).beyond(0, -1, -kSide);
    if (whole <= 0 || on_sheet.count < 3) return floor;
    const double paper = on_sheet.area();
    const SheetPoint at = piece[0];
    const double r =
        std::hypot(at.x - kMiddle.x, at.y - kMiddle.y) / kMillimetre;  // pixels are far below 1 mm
    double dark = 0;
    if (r > landmark::kInner_m - 0.001 && r < landmark::kOuter_m + 0.001)
        dark = dark_ring_area(on_sheet);
    if (r < landmark::kInner_m)
        for (const auto& dot : landmark::kDots)
            dark += on_sheet.area_in_disc(
                {kMiddle.x + kMillimetre * dot.right_m, kMiddle.y - kMillimetre * dot.up_m},
                kMillimetre * landmark::kDot_m);
    const double f = static_cast<double>(floor);
    return static_cast<float>(f + (paper / whole) * (static_cast<double>(kPaper) - f) +
                              (dark / whole) * static_cast<double>(kInk - kPaper));
}

}  // namespace pulseline::simulation
