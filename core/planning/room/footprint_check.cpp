#include "core/planning/room/footprint_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;

constexpr double kExcess_m = 0.010;       // of the discs along the edges over the clearance
constexpr double kLeastRadius_m = 0.080;  // or there would be thousands of them
constexpr double kLargestCell_m = 0.1;
constexpr double kGroup_m = 1.6;     // body length that one group stands for
constexpr double kWellFree_m = 0.5;  // more slack than this need not be known better

/// Depth of a point in a convex counter-clockwise polygon; negative outside.
double depth_m(const Polygon& piece, Point2 p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const Point2 edge = piece[(i + 1) % piece.size()] - piece[i];
        least = std::min(least, cross(edge, p - piece[i]) / norm(edge));
    }
    return least;
}

}  // namespace

FootprintCheck::FootprintCheck(const std::vector<Polygon>& pieces, double clearance_m,
                               const FloorField& field)
    : clearance_m_(clearance_m),
      edge_radius_m_(std::max(clearance_m + kExcess_m, kLeastRadius_m)),
      edge_needed_m_(field.needed_m(edge_radius_m_)) {
    const double largest_m = field.reach_m() - 2 * field.spacing_m();
    std::vector<Disc> discs;
    for (const Polygon& piece : pieces) {
        for (const Point2& p : piece) reach_m_ = std::max(reach_m_, norm(p));
        const std::vector<Disc> more = cover(piece, largest_m);
        discs.insert(discs.end(), more.begin(), more.end());
    }
    group(std::move(discs), field);
}

/// Discs that hold every place nearer to the piece than the clearance.
std::vector<FootprintCheck::Disc> FootprintCheck::cover(const Polygon& piece,
                                                        double largest_m) const {
    // Along the edges: two neighbours s apart hold the clearance between them when
    // radius^2 >= clearance^2 + (s/2)^2. They stand closer than that, so that cells at the edge are
    // held with their corners.
    std::vector<Disc> discs;
    const double farthest_m =
        1.4 * std::sqrt(edge_radius_m_ * edge_radius_m_ - clearance_m_ * clearance_m_);
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const Point2 edge = piece[(i + 1) % piece.size()] - piece[i];
        const int steps = std::max(1, static_cast<int>(std::ceil(norm(edge) / farthest_m)));
        for (int k = 0; k < steps; ++k) {
            discs.push_back({piece[i] + (static_cast<double>(k) / steps) * edge, edge_radius_m_});
        }
    }
    // Inside: cells not yet held by one disc, each time the largest disc that the clearance allows
    // (depth + clearance) and that holds the first such cell.
    const double cell_m = std::min(kLargestCell_m, edge_radius_m_ / 4);
    const double corner_m = cell_m * std::numbers::sqrt2 / 2;
    const auto box = geometry::bounding_box(piece);
    std::vector<Disc> open;  // cells: centre and greatest allowed radius of a disc there
    for (double y = box.min.y_m; y < box.max.y_m + cell_m; y += cell_m) {
        for (double x = box.min.x_m; x < box.max.x_m + cell_m; x += cell_m) {
            const double depth = depth_m(piece, {x, y});
            if (depth > -corner_m)
                open.push_back({{x, y}, std::min(depth + clearance_m_, largest_m)});
        }
    }
    const auto holds = [&](const Disc& disc, Point2 cell) {
        const Point2 off = cell - disc.centre;
        const double room = disc.radius_m - corner_m;
        return room >= 0 && dot(off, off) <= room * room;
    };
    const std::vector<Disc> places = open;
    std::erase_if(open, [&](const Disc& cell) {
        return std::any_of(discs.begin(), discs.end(),
                           [&](const Disc& disc) { return holds(disc, cell.centre); });
    });
    while (!open.empty()) {
        Disc best{open.front().centre, std::max(open.front().radius_m, corner_m)};
        for (const Disc& place : places) {
            if (place.radius_m > best.radius_m && holds(place, open.front().centre)) best = place;
        }
        discs.push_back(best);
        std::erase_if(open, [&](const Disc& cell) { return holds(best, cell.centre); });
        if (!open.empty() && open.front().centre == best.centre) open.erase(open.begin());
    }
    return discs;
}

void FootprintCheck::group(std::vector<Disc> discs, const FloorField& field) {
    std::map<std::pair<int, int>, std::vector<Disc>> buckets;
    for (Disc& disc : discs) {
        disc.needed_m = field.needed_m(disc.radius_m);
        const auto slot = [](double v) { return static_cast<int>(std::floor(v / kGroup_m + 0.5)); };
        buckets[{slot(disc.centre.x_m), slot(disc.centre.y_m)}].push_back(disc);
    }
    for (auto& [slot, members] : buckets) {
        std::sort(members.begin(), members.end(),
                  [](const Disc& a, const Disc& b) { return a.radius_m > b.radius_m; });
        Polygon centres;
        for (const Disc& disc : members) centres.push_back(disc.centre);
        const auto box = geometry::bounding_box(centres);
        Group group{{0.5 * (box.min + box.max), 0}, members};
        for (const Disc& disc : members) {
            group.around.radius_m =
                std::max(group.around.radius_m,
                         geometry::distance(disc.centre, group.around.centre) + disc.radius_m);
        }
        group.around.needed_m = field.needed_m(group.around.radius_m);
        groups_.push_back(std::move(group));
    }
}

double FootprintCheck::slack_m(const FloorField& field, const Pose2& pose, double enough_m) const {
    const double c = std::cos(pose.heading_rad);
    const double s = std::sin(pose.heading_rad);
    const auto slack = [&](const Disc& disc) {
        const Point2 p = disc.centre;
        return field.distance_m(
                   {pose.x_m + c * p.x_m - s * p.y_m, pose.y_m + s * p.x_m + c * p.y_m}) -
               disc.needed_m;
    };
    double least = enough_m;
    for (const Group& group : groups_) {
        const double roughly = slack(group.around);
        if (roughly >= least) continue;
        if (roughly >= kWellFree_m) {
            least = roughly;
            continue;
        }
        for (const Disc& disc : group.discs) {
            const double exactly = slack(disc);
            if (exactly < 0) return exactly;
            least = std::min(least, exactly);
        }
    }
    return least;
}

}  // namespace pulseline::planning
