#pragma once

#include <vector>

#include "core/plant/validate.hpp"

namespace pulseline::server::cli {

/// Where vehicles of a sound plant can keep each other from stations for good, in words (see
/// fleet::check_layout). The plant can be used all the same: such orders wait with a reason.
std::vector<plant::Fault> layout_warnings(const plant::Plant& plant);

}  // namespace pulseline::server::cli
