#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/plant/marker_geometry.hpp"

namespace pulseline::vision {

/// How sure a cell is: +1 certainly dark, -1 certainly light, 0 unknown. [row][column]
using TagBits = std::array<std::array<double, plant::kTagCells>, plant::kTagCells>;

struct TagCode {
    int id = 0;
    int quarter_turns = 0;  // the tag's "up" is the sampled "up" turned so often clockwise
    int wrong_bits = 0;
    bool mirrored = false;
};

/// The 587 codes of AprilTag 36h11 as libapriltag and its authors' pictures have them. OpenCV 4's
/// ArUco draws and reads all of them turned by 180 degrees; such a sheet's "up" is the other way.
class TagFamily {
public:
    static const TagFamily& instance();

    /// The code that fits best in all four turns; nothing when none is clearly the best. Codes
    /// differ in 11 cells, so up to 5 wrong cells have one nearest code; unsure cells weigh less.
    std::optional<TagCode> decode(const TagBits& bits) const;
    /// Whether a cell of the printed tag is dark; outside the border: light.
    bool dark(int id, int row, int column) const;

private:
    TagFamily();
    static constexpr int kBits = 36;
    std::vector<std::uint64_t> codes_;  // bit i, 1 = light, lies at row_[i], column_[i]
    std::array<int, kBits> row_{};
    std::array<int, kBits> column_{};
};

}  // namespace pulseline::vision
