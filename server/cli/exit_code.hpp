#pragma once

#include <fmt/core.h>

#include <cstdio>

#include "core/base/error.hpp"

namespace pulseline::server::cli {

/// Exit codes: 0 done, 1 failed, 2 wrong usage or configuration.
constexpr int kFailed = 1;
constexpr int kUsage = 2;

/// Says what went wrong and gives the exit code for it.
inline int failed(const Error& error) {
    fmt::print(stderr, "pulseline: {}\n", error.what);
    return error.code == Errc::kInvalid ? kUsage : kFailed;
}

}  // namespace pulseline::server::cli
