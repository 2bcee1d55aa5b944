#pragma once

#include <chrono>
#include <cstddef>

#include "core/base/time.hpp"
#include "core/fleet/journal/input.hpp"

/// What FleetRuntime's two threads wait for, and how long.
namespace pulseline::server {

/// A commit that takes longer than this is shown as a fault of the disk.
constexpr auto kSlowAfter = std::chrono::seconds(1);
/// A caller that has waited for so long is told; a person who gave up may stand on the floor.
constexpr auto kGiveUpAfter = std::chrono::seconds(5);
/// A disk that hangs holds what comes in for a second, some hundred batches.
constexpr std::size_t kMostCommits = 1024;
constexpr auto kRetryStore = std::chrono::seconds(1);
/// A fleet that threw and has been good for so long is as good as new.
constexpr auto kForgetFaults = std::chrono::seconds(60);

constexpr Duration kTick = fleet::journal::kTickEvery;
/// A second without a tick: vehicles were not listened to, whatever the reason.
constexpr Duration kStoodStill = std::chrono::seconds(1);
/// The newest time of a tick not after `now`.
inline Time tick_time(Time now) { return now - now.time_since_epoch() % kTick; }

inline double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace pulseline::server
