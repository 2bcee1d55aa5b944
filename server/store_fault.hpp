#pragma once

#include <exception>
#include <optional>
#include <string>

#include "core/base/error.hpp"
#include "core/fleet/views.hpp"

namespace pulseline::server {

/// Why the store refused a write: "disk_full", "write_protected" or "disk_error". Stable codes.
std::string cause_of(const std::exception_ptr& error);
/// What a caller is told while nothing can be stored, with the remedy for that cause.
Error store_unavailable(const std::optional<fleet::StoreFault>& fault);
std::string what(const std::exception_ptr& error);

}  // namespace pulseline::server
