#include "core/localisation/segment_chain.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pulseline::localisation {
namespace {

constexpr double kChainRounding_m = 1e-9;

/// The way's places where sigma is known: [0] the start, then the codes that help, then the end.
class ChainSearch {
public:
    explicit ChainSearch(const ChainTask& task) : task_(task) {
        places_.push_back({0, 0, 0, task.start_sigma_m});
        // A code that alone tells less than the limit asks is none to rely on.
        for (const CodePass& pass : task.passes) {
            if (pass.sigma_m <= task.limit_m) places_.push_back(pass);
        }
        places_.push_back({0, task.length_m, task.length_m, 0, task.goal_within_m});
    }

    tl::expected<SegmentChain, ChainGap> run() const {
        const auto boundary = boundary_marker();
        if (boundary) return chain_to(*boundary);
        if (holds(0, end())) return chain_to(0);
        return tl::make_unexpected(worst_gap());
    }

private:
    std::size_t end() const { return places_.size() - 1; }
    double gap_m(std::size_t from, std::size_t to) const {
        return std::max(0.0, places_[to].from_m - places_[from].to_m);
    }

    /// Without a code, as its reach is counted.
    double blind_m(std::size_t from, std::size_t to) const {
        const double gap = gap_m(from, to);
        if (gap == 0 || gap > places_[to].caught_within_m) return gap;
        return task_.as_straight_m(places_[from].to_m, places_[to].from_m);
    }

    /// Eq. 4.
    double sigma_before_m(std::size_t from, std::size_t to) const {
        const CodePass& last = places_[from];
        return last.sigma_m + task_.motion_m(last.to_m, std::max(last.to_m, places_[to].from_m));
    }

    bool holds(std::size_t from, std::size_t to) const {
        return blind_m(from, to) <= places_[to].caught_within_m + kChainRounding_m &&
               sigma_before_m(from, to) <= task_.limit_m + kChainRounding_m;
    }

    std::optional<std::size_t> boundary_marker() const {
        std::vector<bool> reached(places_.size());
        reached[0] = true;
        std::optional<std::size_t> best;
        for (std::size_t to = 1; to < end(); ++to) {
            for (std::size_t from = to; from-- > 0 && !reached[to];) {
                reached[to] = reached[from] && holds(from, to);
            }
            if (!reached[to] || !holds(to, end())) continue;
            const bool better = !best || sigma_before_m(to, end()) <=
                                             sigma_before_m(*best, end()) + kChainRounding_m;
            if (better) best = to;
        }
        return best;
    }

    /// By place: whether the boundary marker can be come to from there.
    std::vector<bool> leading_to(std::size_t boundary) const {
        std::vector<bool> leads(boundary + 1);
        leads[boundary] = true;
        for (std::size_t from = boundary; from-- > 0;) {
            for (std::size_t to = boundary; to > from && !leads[from]; --to) {
                leads[from] = leads[to] && holds(from, to);
            }
        }
        return leads;
    }

    /// Eq. 9; of equal ones the nearer to the goal.
    std::size_t next_marker(std::size_t from, double segment_m,
                            const std::vector<bool>& leads) const {
        std::size_t best = leads.size() - 1;
        double least_m = std::numeric_limits<double>::infinity();
        for (std::size_t to = from + 1; to < leads.size(); ++to) {
            if (!leads[to] || !holds(from, to)) continue;
            const double off_m = std::abs(places_[to].from_m - places_[from].from_m - segment_m);
            if (off_m > least_m + kChainRounding_m) continue;
            least_m = off_m;
            best = to;
        }
        return best;
    }

    SegmentChain chain_to(std::size_t boundary) const {
        const auto leads = leading_to(boundary);
        // Eq. 7 and 8.
        const double wanted = std::ceil(sigma_before_m(0, boundary) / task_.limit_m);
        const double segments = std::max(1.0, wanted);
        const double segment_m = places_[boundary].from_m / segments;
        SegmentChain chain;
        std::size_t at = 0;
        while (at != boundary) {
            const bool last = static_cast<double>(chain.markers.size()) + 1 >= segments;
            const std::size_t next =
                last && holds(at, boundary) ? boundary : next_marker(at, segment_m, leads);
            chain.markers.push_back({places_[next].code, places_[next].from_m,
                                     sigma_before_m(at, next), places_[next].sigma_m});
            chain.worst_m =
                std::max({chain.worst_m, chain.markers.back().before_m, places_[next].sigma_m});
            at = next;
        }
        chain.arrival_m = sigma_before_m(boundary, end());
        chain.worst_m = std::max(chain.worst_m, chain.arrival_m);
        return chain;
    }

    /// The longest way from there with sigma inside the limit.
    double way_within_limit_m(std::size_t from) const {
        double inside_m = 0;
        double outside_m = task_.length_m - places_[from].to_m;
        while (outside_m - inside_m > 1e-3) {
            const double middle_m = (inside_m + outside_m) / 2;
            const double to_m = places_[from].to_m + middle_m;
            const double sigma_m = places_[from].sigma_m + task_.motion_m(places_[from].to_m, to_m);
            (sigma_m <= task_.limit_m ? inside_m : outside_m) = middle_m;
        }
        return outside_m;
    }

    /// Without a chain, two places next to each other are too far apart: else all are one.
    ChainGap worst_gap() const {
        ChainGap worst;
        double most_m = -std::numeric_limits<double>::infinity();
        for (std::size_t to = 1; to < places_.size(); ++to) {
            if (holds(to - 1, to)) continue;
            const double turns_m = blind_m(to - 1, to) - gap_m(to - 1, to);
            const double at_most_m =
                std::min(places_[to].caught_within_m - turns_m, way_within_limit_m(to - 1));
            const double too_much_m = gap_m(to - 1, to) - at_most_m;
            if (too_much_m <= most_m) continue;
            most_m = too_much_m;
            worst = {places_[to - 1].to_m, places_[to].from_m, at_most_m};
        }
        return worst;
    }

    const ChainTask& task_;
    std::vector<CodePass> places_;
};

}  // namespace

tl::expected<SegmentChain, ChainGap> segment_chain(const ChainTask& task) {
    return ChainSearch(task).run();
}

}  // namespace pulseline::localisation
