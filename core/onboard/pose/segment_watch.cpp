#include "core/onboard/pose/segment_watch.hpp"

#include <algorithm>
#include <utility>

#include "core/localisation/codes_on_way.hpp"

namespace pulseline::onboard {
namespace {

// A code at the end of an edge is read behind it, of a picture taken before.
constexpr double kBehind_m = 0.5;
constexpr double kSurely = 3;  // sigmas

bool has(const std::vector<std::string>& payloads, const std::string& payload) {
    return std::ranges::find(payloads, payload) != payloads.end();
}

}  // namespace

void SegmentWatch::step(const std::deque<vda5050::OrderEdge>& ahead,
                        std::span<const std::string> read, double way_m, double sigma_m) {
    if (ahead.empty()) {  // it stops and measures, or has nothing to do
        if (edges_ > 0) *this = SegmentWatch(std::move(type_));
        return;
    }
    follow(ahead);
    note_read(read);
    note_missed(way_m);
    unsure_ = precise_ && kSurely * sigma_m > in_view_m_;
}

void SegmentWatch::follow(const std::deque<vda5050::OrderEdge>& ahead) {
    const std::int64_t first = ahead.front().sequence_id;
    if (ahead.size() == edges_ && first == first_sequence_id_) return;
    edges_ = ahead.size();
    first_sequence_id_ = first;
    auto now = awaited_on(ahead);
    for (Awaited& before : ahead_) {
        const auto still = std::ranges::find(now, before.payload, &Awaited::payload);
        if (still != now.end()) {
            still->read = before.read;
        } else if (before.sequence_id < first) {  // else its part of the horizon is no more
            if (before.boundary) enter_precise(before);
            if (!before.read) behind_.push_back(std::move(before));
        }
    }
    ahead_ = std::move(now);
}

std::vector<SegmentWatch::Awaited> SegmentWatch::awaited_on(
    const std::deque<vda5050::OrderEdge>& ahead) const {
    std::vector<Awaited> awaited;
    for (const auto& edge : ahead) {
        for (const auto& action : edge.actions) {
            for (const auto& marker : action.markers) {
                if (!has(action.segment_markers, marker.payload)) continue;
                std::erase_if(awaited,
                              [&](const Awaited& a) { return a.payload == marker.payload; });
                awaited.push_back({marker.payload, edge.sequence_id, marker.size_m,
                                   marker.payload == action.boundary_marker});
            }
        }
    }
    return awaited;
}

void SegmentWatch::note_read(std::span<const std::string> payloads) {
    for (const std::string& payload : payloads) {
        missed_.clear();
        std::erase_if(behind_, [&](const Awaited& a) { return a.payload == payload; });
        const auto found = std::ranges::find(ahead_, payload, &Awaited::payload);
        if (found == ahead_.end()) continue;
        found->read = true;
        if (found->boundary) enter_precise(*found);
    }
}

void SegmentWatch::note_missed(double way_m) {
    for (Awaited& one : behind_) {
        one.behind_m += way_m;
        if (one.behind_m > kBehind_m) missed_.push_back(one.payload);
    }
    std::erase_if(behind_, [](const Awaited& one) { return one.behind_m > kBehind_m; });
}

void SegmentWatch::enter_precise(const Awaited& boundary) {
    precise_ = true;
    in_view_m_ = 0;
    for (const auto& camera : type_.cameras) {
        in_view_m_ = std::max(in_view_m_, localisation::view_radius_m(camera, boundary.size_m));
    }
}

double SegmentWatch::speed_share() const {
    const bool slowly = !missed_.empty() || unsure_;
    return slowly && type_.max_speed_mps > kPrecise_mps ? kPrecise_mps / type_.max_speed_mps : 1;
}

void SegmentWatch::write_state(vda5050::StateMessage& state) const {
    for (const std::string& payload : missed_) {
        state.errors.push_back({kMissed,
                                false,
                                "Code " + payload +
                                    ", which the way relies on, was passed without being read. The "
                                    "vehicle goes slowly until it reads the next one.",
                                {{"marker", payload}}});
    }
}

}  // namespace pulseline::onboard
