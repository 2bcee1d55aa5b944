#pragma once

#include <chrono>

#include "core/base/time.hpp"

namespace pulseline::agent {

/// Wall clock, for stamps only.
inline Time utc_now() {
    return time_from_ns(std::chrono::duration_cast<std::chrono::nanoseconds>(
                            std::chrono::system_clock::now().time_since_epoch())
                            .count());
}

}  // namespace pulseline::agent
