#pragma once

#include <cstddef>
#include <string>

#include "core/base/result.hpp"

namespace pulseline::api::localization {

/// A whole regular file; fails with file_unreadable {file} and file_too_large {file, limit_bytes}.
[[nodiscard]] Result<std::string> read_bytes(const std::string& path, std::size_t most_bytes);

}  // namespace pulseline::api::localization
