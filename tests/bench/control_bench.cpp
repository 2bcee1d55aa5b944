// The control near the goal by itself: motion_bench_control.hpp says what is timed.
#include "tests/bench/motion_bench_control.hpp"

int main() { return pulseline::bench::bench_control() ? 0 : 1; }
