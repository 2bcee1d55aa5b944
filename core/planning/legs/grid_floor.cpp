#include "core/planning/legs/grid_floor.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;

constexpr double kCell_m = 0.3;
constexpr double kMostCells = 300'000;
// The hull of a step of 3 deg stands out by half of it times half the body's length.
constexpr double kStandOut = 0.027;
constexpr double kLook_m = 1.5;
constexpr double kBetween_m = 0.012;  // that a body may come nearer between two tested places

double cell_size_m(const geometry::Box& box) {
    const double area_m2 = (box.max.x_m - box.min.x_m) * (box.max.y_m - box.min.y_m);
    return std::max(kCell_m, std::sqrt(area_m2 / kMostCells));
}

int cells_along(double way_m, double cell_m) {
    return std::max(1, static_cast<int>(std::ceil(way_m / cell_m - 1e-9)));
}

Polygon circle_of(double radius_m) {
    constexpr int kCorners = 24;
    const double r = radius_m / std::cos(kPi / kCorners);
    Polygon circle;
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2 * kPi * i / kCorners;
        circle.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return circle;
}

/// Between two places a step apart a convex body comes nearer by (step / 2)^2 / (2 clearance).
double step_m(double clearance_m) { return 2 * std::sqrt(2 * clearance_m * kBetween_m); }

}  // namespace

GridFloor::GridFloor(const FloorField& field, const Body& body)
    : field_(field),
      pieces_(body.pieces),
      body_(body.pieces, body.clearance_m + kBetween_m, field),
      turning_({circle_of(body_.reach_m())}, body.clearance_m + kBetween_m, field),
      swinging_(body.pieces, body.clearance_m + kBetween_m + kStandOut * body_.reach_m(), field),
      turning_needed_m_(field.needed_m(body_.reach_m() + body_.clearance_m())),
      cell_m_(cell_size_m(field.box())),
      width_(cells_along(field.box().max.x_m - field.box().min.x_m, cell_m_)),
      height_(cells_along(field.box().max.y_m - field.box().min.y_m, cell_m_)),
      map_(all_layers()) {
    find_parts();
}

GridFloor GridFloor::with(std::vector<ClosedFloor> closed) const {
    GridFloor floor = *this;
    for (const ClosedFloor& closure : closed) floor.field_.add(closure.pieces);
    GridLayers layers = map_.layers();
    for (const ClosedFloor& closure : closed) {
        for (const Polygon& piece : closure.pieces) {
            if (!piece.empty()) floor.close(piece, layers);
        }
    }
    floor.closed_ = std::move(closed);
    floor.find_parts();
    return floor;
}

/// Looks again at all cells where the body could come near to the piece, which is in the field.
void GridFloor::close(const Polygon& piece, GridLayers& layers) {
    const double near_m = reach_m() + body_.clearance_m() + 2 * cell_m_;
    const auto box = geometry::bounding_box(piece);
    const Cell low = cell_at(box.min - Point2{near_m, near_m});
    const Cell high = cell_at(box.max + Point2{near_m, near_m});
    const CellBox changed{{std::max(low.col, 0), std::max(low.row, 0)},
                          {std::min(high.col, width_ - 1), std::min(high.row, height_ - 1)}};
    if (changed.empty()) return;
    for (int row = changed.first.row; row <= changed.last.row; ++row) {
        for (int col = changed.first.col; col <= changed.last.col; ++col) {
            look_at({col, row}, layers);
        }
    }
    map_.update(layers, changed);
}

Cell GridFloor::cell_at(Point2 at) const {
    const Point2 off = at - field_.box().min;
    // Far outside would not fit into an int.
    const auto number = [&](double way_m, int count) {
        return static_cast<int>(std::clamp(std::floor(way_m / cell_m_), -1.0, double(count)));
    };
    return {number(off.x_m, width_), number(off.y_m, height_)};
}

Point2 GridFloor::centre_of(Cell cell) const {
    return field_.box().min + Point2{(cell.col + 0.5) * cell_m_, (cell.row + 0.5) * cell_m_};
}

bool GridFloor::is_free(const Pose2& from, Point2 to) const {
    const Point2 way = to - from.position();
    const double length_m = norm(way);
    const auto at = [&](double done_m) {
        const Point2 place = from.position() + (length_m > 0 ? done_m / length_m : 0) * way;
        return Pose2{place.x_m, place.y_m, from.heading_rad};
    };
    if (!is_free(at(0)) || !is_free(at(length_m))) return false;
    if (length_m == 0 || is_band_free(from, to)) return true;
    // Ways that are not free mostly show it over a body's length: found soonest by halving.
    for (int parts = 2; length_m > kLook_m * parts / 2; parts *= 2) {
        for (int k = 1; k < parts; k += 2) {
            if (!is_free(at(length_m * k / parts))) return false;
        }
    }
    const double step = step_m(body_.clearance_m());
    for (double done_m = 0; done_m < length_m;) {
        const double slack_m = body_.slack_m(field_, at(done_m));
        if (slack_m < 0) return false;
        done_m += slack_m + step;  // as far as the slack is known to be free
    }
    return true;
}

bool GridFloor::may_turn_by(const Pose2& from, double turn_rad) const {
    if (may_turn_at(from.position())) return true;
    const double sign = turn_rad < 0 ? -1 : 1;
    const auto slack_at = [&](double done_rad) {
        return swinging_.slack_m(field_, {from.x_m, from.y_m, from.heading_rad + sign * done_rad});
    };
    const double whole_rad = std::abs(turn_rad);
    const double step = step_m(body_.clearance_m());
    for (double done_rad = 0; done_rad < whole_rad;) {
        const double slack_m = slack_at(done_rad);
        if (slack_m < 0) return false;
        done_rad += (slack_m + step) / reach_m();
    }
    return slack_at(whole_rad) >= 0;
}

/// Whether the floor between the two places is free as wide as the body is across the way: discs
/// one after the other on the line cover it, a read each.
bool GridFloor::is_band_free(const Pose2& from, Point2 to) const {
    const Point2 way = to - from.position();
    const double length_m = norm(way);
    const Point2 ahead = (1 / length_m) * way;
    double half_m = 0;
    for (const Polygon& piece : pieces_) {
        for (const Point2& corner : piece) {
            const Point2 off = Pose2{0, 0, from.heading_rad} * corner;
            half_m = std::max(half_m, std::abs(cross(ahead, off)));
        }
    }
    const double kept_m = half_m + body_.clearance_m();
    const double excess_m = field_.needed_m(kept_m) - kept_m;
    const double step = step_m(kept_m);
    for (double done_m = 0; done_m < length_m;) {
        const double radius_m = field_.distance_m(from.position() + done_m * ahead) - excess_m;
        if (radius_m < kept_m) return false;
        done_m += std::max(step, std::sqrt(radius_m * radius_m - kept_m * kept_m));
    }
    return true;
}

GridLayers GridFloor::all_layers() const {
    GridLayers layers;
    layers.width = width_;
    layers.height = height_;
    layers.blocked.fill(BitGrid(width_, height_));
    layers.no_turn = BitGrid(width_, height_);
    for (int row = 0; row < height_; ++row) {
        for (int col = 0; col < width_; ++col) look_at({col, row}, layers);
    }
    return layers;
}

void GridFloor::look_at(Cell cell, GridLayers& layers) const {
    const Point2 at = centre_of(cell);
    const double half_m = cell_m_ / 2;
    const bool turns = turning_slack_m(at) >= half_m ||
                       turning_.slack_m(field_, {at.x_m, at.y_m, 0}, half_m) >= half_m;
    layers.no_turn.set(cell, !turns);
    for (int d = 0; d < kDirections; ++d) {
        layers.blocked[static_cast<std::size_t>(d)].set(cell, !turns && !fits_along(at, d));
    }
}

void GridFloor::find_parts() {
    parts_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
    int number = 0;
    for (int row = 0; row < height_; ++row) {
        for (int col = 0; col < width_; ++col) {
            const Cell cell{col, row};
            if (part_of(cell) == 0 && !map_.nowhere(cell)) fill_part(cell, ++number);
        }
    }
}

void GridFloor::fill_part(Cell first, int number) {
    std::vector<Cell> open{first};
    part_of(first) = number;
    while (!open.empty()) {
        const Cell cell = open.back();
        open.pop_back();
        for (int d = 0; d < kDirections; ++d) {
            const Cell next = next_to(cell, d);
            if (!map_.inside(next) || part_of(next) != 0 || map_.nowhere(next)) continue;
            part_of(next) = number;
            open.push_back(next);
        }
    }
}

bool GridFloor::fits_along(Point2 at, int heading) const {
    const double heading_rad = heading * kPi / 2;
    const double half_m = cell_m_ / 2;
    const double slack_m = body_.slack_m(field_, {at.x_m, at.y_m, heading_rad}, half_m);
    if (slack_m < 0 || slack_m >= half_m) return slack_m >= 0;
    const Point2 ahead{half_m * std::cos(heading_rad), half_m * std::sin(heading_rad)};
    const Point2 before = at - ahead;
    const Point2 behind = at + ahead;
    return is_free({before.x_m, before.y_m, heading_rad}) &&
           is_free({behind.x_m, behind.y_m, heading_rad});
}

}  // namespace pulseline::planning
