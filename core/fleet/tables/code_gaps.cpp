#include "core/fleet/tables/code_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <string>
#include <utility>

#include "core/localisation/codes_on_way.hpp"

namespace pulseline::fleet {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where codes are in view along one way, in metres from its start.
struct Sights {
    bool any = false;
    double first_m = 0;
    double last_m = 0;
    double widest_m = 0;  // between two
    double widest_at_m = 0;
};

Sights sights_along(const std::vector<const plant::Marker*>& codes,
                    const std::vector<plant::Camera>& cameras, const kinematics::Segment& way) {
    std::vector<double> shares;
    for (const auto* code : codes) {
        for (const double share : localisation::seen_at(*code, cameras, way)) {
            shares.push_back(share);
        }
    }
    if (shares.empty()) return {};
    std::sort(shares.begin(), shares.end());
    const double length_m = std::abs(way.length_m);
    Sights sights{true, shares.front() * length_m, shares.back() * length_m, 0, 0};
    for (std::size_t i = 1; i < shares.size(); ++i) {
        const double gap_m = (shares[i] - shares[i - 1]) * length_m;
        if (gap_m <= sights.widest_m) continue;
        sights.widest_m = gap_m;
        sights.widest_at_m = (shares[i] + shares[i - 1]) / 2 * length_m;
    }
    return sights;
}

/// By place: the shortest way driven since the last code was in view (`backwards`: until the next
/// one will be). Dijkstra from all ways with codes at once.
std::vector<double> blind_to_places(const planning::MotionGraph& graph,
                                    const std::vector<Sights>& sights, bool backwards) {
    std::vector<std::vector<std::size_t>> leaving(graph.places.size());
    std::vector<double> blind_m(graph.places.size(), kNever);
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto reach = [&](std::size_t place, double way_m) {
        if (way_m >= blind_m[place]) return;
        blind_m[place] = way_m;
        open.push({way_m, place});
    };
    for (std::size_t w = 0; w < graph.ways.size(); ++w) {
        const auto& way = graph.ways[w];
        leaving[backwards ? way.to : way.from].push_back(w);
        if (!sights[w].any) continue;
        const double tail_m = std::abs(way.segment.length_m) - sights[w].last_m;
        reach(backwards ? way.from : way.to, backwards ? sights[w].first_m : tail_m);
    }
    while (!open.empty()) {
        const auto [way_m, place] = open.top();
        open.pop();
        if (way_m > blind_m[place]) continue;
        for (const std::size_t w : leaving[place]) {
            const auto& way = graph.ways[w];
            if (sights[w].any) continue;
            reach(backwards ? way.from : way.to, way_m + std::abs(way.segment.length_m));
        }
    }
    return blind_m;
}

/// By way: whether it can be come to from a station. A lane cut off by bodies that do not fit is
/// driven by nobody.
std::vector<bool> ways_driven(const planning::MotionGraph& graph) {
    std::vector<std::vector<std::size_t>> leaving(graph.places.size());
    for (std::size_t w = 0; w < graph.ways.size(); ++w) {
        leaving[graph.ways[w].from].push_back(w);
    }
    std::vector<bool> reached(graph.places.size());
    std::vector<std::size_t> open;
    for (std::size_t p = 0; p < graph.places.size(); ++p) {
        if (graph.places[p].station.empty()) continue;
        reached[p] = true;
        open.push_back(p);
    }
    std::vector<bool> driven(graph.ways.size());
    while (!open.empty()) {
        const std::size_t place = open.back();
        open.pop_back();
        for (const std::size_t w : leaving[place]) {
            driven[w] = true;
            const std::size_t to = graph.ways[w].to;
            if (!reached[to]) open.push_back(to);
            reached[to] = true;
        }
    }
    return driven;
}

/// How far the class may drive without a code: of its best camera, and the plant's smallest code.
double most_blind_m(const plant::Plant& plant, const std::vector<plant::Camera>& cameras) {
    double size_m = kNever;
    for (const auto& marker : plant.markers) size_m = std::min(size_m, marker.size_m);
    double most_m = 0;
    for (const auto& camera : cameras) {
        most_m = std::max(most_m, localisation::blind_way_m(camera, size_m));
    }
    return most_m;
}

struct Gap {
    double blind_m = 0;
    geometry::Point2 at;
    double off_middle_m = 0;  // of the gap

    /// All ways of one gap have it in full; the one in its middle tells where a code helps.
    bool is_worse_than(const Gap& other) const {
        constexpr double kSame_m = 1e-6;
        if (blind_m > other.blind_m + kSame_m) return true;
        return blind_m > other.blind_m - kSame_m && off_middle_m < other.off_middle_m;
    }
};

/// The widest gap that driving this way has, wherever it leads on.
Gap gap_of(const planning::MotionWay& way, const Sights& sights, double before_m, double after_m) {
    const double length_m = std::abs(way.segment.length_m);
    const auto at = [&](double along_m) {
        const double share = length_m > 0 ? along_m / length_m : 0.5;
        return kinematics::pose_at(way.segment, share).position();
    };
    // Where no code was before or none comes after, there is none to miss on that side.
    const bool none = !sights.any && before_m == kNever && after_m == kNever;
    if (none) return {kNever, at(length_m / 2), 0};
    if (before_m == kNever) before_m = 0;
    if (after_m == kNever) after_m = 0;
    if (!sights.any) {
        return {before_m + length_m + after_m, at(length_m / 2), std::abs(before_m - after_m) / 2};
    }
    Gap widest{sights.widest_m, at(sights.widest_at_m), 0};
    const double to_first_m = before_m + sights.first_m;
    if (to_first_m > widest.blind_m) widest = {to_first_m, at(0), to_first_m / 2};
    const double from_last_m = length_m - sights.last_m + after_m;
    if (from_last_m > widest.blind_m) widest = {from_last_m, at(length_m), from_last_m / 2};
    return widest;
}

std::optional<Reason> check_class(const plant::Plant& plant, const FloorClass& of_class) {
    const auto cameras = plant::cameras_of(*of_class.type, of_class.loaded);
    const auto& graph = of_class.motion;
    if (cameras.empty() || plant.markers.empty() || graph.ways.empty()) return std::nullopt;
    std::vector<Sights> sights;
    for (const auto& way : graph.ways) {
        std::vector<const plant::Marker*> codes;
        for (const auto& marker : plant.markers) {
            if (marker.hall == graph.places[way.from].hall) codes.push_back(&marker);
        }
        sights.push_back(sights_along(codes, cameras, way.segment));
    }
    const auto before_m = blind_to_places(graph, sights, false);
    const auto after_m = blind_to_places(graph, sights, true);
    const double most_m = most_blind_m(plant, cameras);
    Gap worst;
    std::int64_t count = 0;
    const auto driven = ways_driven(graph);
    for (std::size_t w = 0; w < graph.ways.size(); ++w) {
        const auto& way = graph.ways[w];
        if (!driven[w]) continue;
        const Gap gap = gap_of(way, sights[w], before_m[way.from], after_m[way.to]);
        if (gap.blind_m <= most_m) continue;
        ++count;
        if (gap.is_worse_than(worst)) worst = gap;
    }
    if (count == 0) return std::nullopt;
    const std::string name = of_class.type->id.str() + (of_class.loaded ? " with load" : "");
    Reason reason{kCodeGap,
                  {{"class", name},
                   {"at_most_m", most_m},
                   {"at_x_m", worst.at.x_m},
                   {"at_y_m", worst.at.y_m},
                   {"count", count}}};
    if (worst.blind_m < kNever) reason.params.push_back({"blind_m", worst.blind_m});
    return reason;
}

}  // namespace

std::vector<Reason> check_codes(const plant::Plant& plant, const std::vector<FloorClass>& classes) {
    std::vector<Reason> reasons;
    for (const auto& of_class : classes) {
        if (auto reason = check_class(plant, of_class)) reasons.push_back(std::move(*reason));
    }
    return reasons;
}

}  // namespace pulseline::fleet
