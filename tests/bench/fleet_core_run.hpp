#pragma once

#include <cstdint>
#include <vector>

/// The whole state machine with a real database file under it, as the server runs them: what
/// releases of floor take from the vehicle's report, order or tick that makes them possible.
namespace pulseline::bench {

struct CoreRun {
    std::vector<double> decided_us;  // until the fleet has put the messages out
    std::vector<double> stored_us;   // until what they rest on is committed, one commit each
    std::uint64_t inputs = 0;
    std::uint64_t orders = 0;
};

/// `vehicles` on lanes of their own report once a second each, and three orders a second come, for
/// `seconds` of simulated time. Times are wall clock.
CoreRun run_core(int vehicles, double seconds);

}  // namespace pulseline::bench
