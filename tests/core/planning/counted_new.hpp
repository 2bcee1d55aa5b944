#pragma once

#include <cstdint>

/// Calls of operator new by this thread; the program's own operator new counts them.
std::int64_t allocations();
