#pragma once

#include <optional>
#include <string_view>

#include "core/fleet/state/job_order.hpp"

/// The Job Control machine of ISA-95 part 4 as OPC 10031-4, 6.2.1 states it: which method may be
/// called in which state and where it leads.
namespace pulseline::fleet {

enum class JobMethod {
    kStore,          // a new order that waits for Start
    kStoreAndStart,  // a new order that may start
    kStart,
    kRevokeStart,
    kPause,
    kResume,
    kUpdate,
    kAbort,   // ends it without its result
    kStop,    // ends it in good order before its last step
    kCancel,  // takes an order out that never started
    kClear,   // takes an order out that is over
};

const char* to_string(JobMethod method);  // "RevokeStart"
std::optional<JobMethod> job_method(std::string_view name);

/// Where a method leads. A removed order is no longer in the receiver's list; its rows stay.
struct JobTransition {
    JobState to = JobState::kNotAllowedToStart;
    bool removed = false;
};

/// What `method` does to an order in state `from`; absent where the machine does not allow it.
/// Store and StoreAndStart make orders: on one that exists they are never allowed.
std::optional<JobTransition> transition(JobState from, JobMethod method);

}  // namespace pulseline::fleet
