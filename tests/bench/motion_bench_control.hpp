#pragma once

namespace pulseline::bench {

/// Times a step of the dynamic window, a check of the protective fields and a scan of the simulated
/// scanner, and prints p50 and p99 of each. False when one takes longer than is asked of it.
bool bench_control();

}  // namespace pulseline::bench
