#pragma once

namespace pulseline {

constexpr double square(double x) { return x * x; }

}  // namespace pulseline
