#pragma once

#include <exception>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/base/error.hpp"
#include "core/fleet/state/views.hpp"

namespace pulseline::server {

/// The store has not answered in time; what it was asked may still be done.
struct StoreHangs : std::runtime_error {
    StoreHangs() : std::runtime_error("the disk does not answer") {}
};

/// Why the store refused a write.
struct WriteFailure {
    /// "disk_full", "write_protected", "disk_hangs" or "disk_error", stable codes; a fleet that
    /// cannot go on says "internal" in the same place.
    std::string cause;
    std::string what;
};
/// Of what the store threw: said on its thread, so that no other has to share the exception.
WriteFailure write_failure(const std::exception_ptr& error);
/// What a caller is told while nothing can be stored, with the remedy for that cause.
Error store_unavailable(const std::optional<fleet::StoreFault>& fault);
/// As above, for one whose write had begun: nobody knows whether it is kept.
Error outcome_unknown(const std::optional<fleet::StoreFault>& fault);
std::string what(const std::exception_ptr& error);

}  // namespace pulseline::server
