#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <tl/expected.hpp>
#include <vector>

/// Segmented navigation along a way (Li 2022, section 4, eq. 4 to 9 as corrected): rough from one
/// segment marker to the next, precise from the last one before the station, the boundary marker.
/// Ways are arc lengths from where the drive begins. One sigma each.
namespace pulseline::localisation {

/// A stretch of the way on which a camera has a surveyed code in view.
struct CodePass {
    std::size_t code = 0;  // names it to the caller
    double from_m = 0;
    double to_m = 0;
    /// Of a pose by it: the root of eq. 4, sqrt(s_LTS^2 + s_T^2 + s_c^2).
    double sigma_m = 0;
    /// The longest way without a code after which this one certainly comes into view (eq. 5,
    /// second line; blind_way_m).
    double caught_within_m = std::numeric_limits<double>::infinity();
};

struct ChainTask {
    std::vector<CodePass> passes;  // by from_m, rising
    double length_m = 0;
    double start_sigma_m = 0;
    /// As caught_within_m, of the station's codes at the end of the way.
    double goal_within_m = std::numeric_limits<double>::infinity();
    double limit_m = 0;  // that sigma exceeds nowhere
    /// What motion from one place of the way to another adds to sigma: C s_m of eq. 4. Never less
    /// for a longer stretch.
    std::function<double(double from_m, double to_m)> motion_m;
    /// A stretch of the way as caught_within_m counts it, with what turns on it add
    /// (as_straight_m).
    std::function<double(double from_m, double to_m)> as_straight_m =
        [](double from_m, double to_m) { return to_m - from_m; };
};

struct ChainMarker {
    std::size_t code = 0;
    double at_m = 0;      // where it comes into view
    double before_m = 0;  // sigma there, by eq. 4
    double after_m = 0;   // sigma by it
};

struct SegmentChain {
    /// The last one is the boundary marker. Empty: no code is passed, and none is needed.
    std::vector<ChainMarker> markers;
    double arrival_m = 0;  // sigma at the end of the way
    double worst_m = 0;    // the largest on the way
};

/// Where a chain breaks: the stretch without a code that exceeds most what may lie there.
struct ChainGap {
    double from_m = 0;
    double to_m = 0;
    double at_most_m = 0;  // long it might be
    double middle_m() const { return (from_m + to_m) / 2; }
};

/// The boundary marker is the one that leaves least sigma at the end, of equal ones the nearest.
/// Before it lie as many segments as eq. 7 wants, more where codes lie so: each next marker is, of
/// those that are certainly caught with sigma inside the limit and lead on to the boundary marker,
/// the one whose distance is nearest to eq. 8 (eq. 9). A chain is found wherever there is one.
tl::expected<SegmentChain, ChainGap> segment_chain(const ChainTask& task);

}  // namespace pulseline::localisation
