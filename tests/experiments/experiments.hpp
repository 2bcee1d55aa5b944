#pragma once

#include <cstdint>
#include <optional>
#include <string>

/// The papers' experiments in simulation, each printed beside the paper's own table.
namespace pulseline::experiments {

struct Options {
    std::uint64_t seed = 1;
    std::optional<int> runs;         // absent: the experiment's own number
    std::string errors = "nominal";  // of the stops: nominal, kind, harsh
    double spoil_mm = 0;  // of the stops: measurements that are off by so much without knowing it
    double stretch = 1;   // of the navigation: codes so many times farther apart than computed
    std::string plots;    // folder of the drawings of navigation and igps
    std::string folder;   // of the experiments' own files
};

/// Li 2020, section 4.2, Tables 1 and 2: distance and angle between two landmarks. False when a row
/// is not as much better than the paper's as is claimed.
bool landmark_accuracy(const Options& options);

/// Li 2020, section 4.3, Fig. 12: the end of the adjustment to a landmark. False when an image is
/// not read or the compensated loop is not ten times better than the paper's.
bool stop_adjustment(const Options& options);

/// Li 2022, eq. 4 and 5: eq. 5 as printed and as corrected; drives of 200 m by odometry alone, over
/// codes at the spacing that is computed for the type, by iGPS, by reflectors and by contours,
/// drawn in navigation.svg. False when a code is missed, or a drive ends too far off. With a
/// `stretch` above 1 the counter-test: drives over codes only, and false when a family misses none.
bool navigation(const Options& options);

/// Li 2022, section 5.1, Table 1: where a measuring vehicle believes to stand over four markers, by
/// them and by reflectors. False when it is worse than is asked, or a stated sigma does not hold.
bool self_positioning(const Options& options);

/// Li 2022, section 5.2, Table 2: where a measuring vehicle arrives on three routes by no marker,
/// by every first to fourth one, and by the chain that is planned. False when the chain is worse
/// than Li's, or one is found where markers lie too far apart.
bool segments(const Options& options);

/// Wang, section 5: stops at one place of the iGPS cell, steered and measured by light alone; what
/// is left when transmitters fail; how well the light tells a pose over the whole cell, drawn in
/// igps.svg. False when a stop is more than 0.5 mm off, or a stated sigma does not hold.
bool igps(const Options& options);

/// Stops of each family by the true pose: Tang 2020 (platform), Wang (Mecanum, iGPS), Li 2020
/// (differential vehicle, landmark), with the whole error budget. False when one is refused or
/// misses what is asked of it.
bool stops(const Options& options);

}  // namespace pulseline::experiments
