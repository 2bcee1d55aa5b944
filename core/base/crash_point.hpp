#pragma once

namespace pulseline {

/// A named place where a test may let the process die as by kill -9. PULSELINE_CRASH_AT=name:n
/// kills it at the n-th passage of that place.
///
/// Only builds with tests have them (CMake option PULSELINE_CRASH_POINTS, on with PULSELINE_TESTS):
/// a product that dies when its environment says so is a way to stop a plant. In a release build
/// the function is empty. It is a function in both, so that one source is all that tests compile
/// anew.
enum class CrashPoint {
#define CRASH_POINT(name, text) name,
#include "core/base/crash_points.def"
#undef CRASH_POINT
};

void crash_point(CrashPoint here);

}  // namespace pulseline
