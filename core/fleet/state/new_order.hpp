#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/time.hpp"
#include "core/fleet/state/job_control.hpp"
#include "core/fleet/state/job_order.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::fleet {

struct NewStep {
    int station_number = 0;
    plant::MotionMode mode = plant::MotionMode::kAuto;
    std::vector<StepAction> before = {};
    std::vector<StepAction> after = {};
    bool says_before = false;  // be it that nothing is done; else what its stations are for
    bool says_after = false;
    friend bool operator==(const NewStep&, const NewStep&) = default;
};

/// What somebody asks for; create_order() makes a job order of it.
struct NewOrder {
    std::string client_order_id;        // empty: none
    plant::VehicleId vehicle;           // empty: any
    plant::VehicleTypeId vehicle_type;  // empty: any
    int priority = 0;
    bool start = true;  // StoreAndStart; false: Store, it waits for Start
    std::optional<Time> earliest_start;
    std::optional<Time> due;
    std::vector<std::string> after;  // ids, or client order ids, of orders that have to end first
    std::string sequence;            // empty: none
    std::vector<NewStep> steps;
    bool planned_beside =
        false;  // its free manoeuvres are known to be possible (legs/leg_plans.hpp)
    std::string from_template;
    ScheduleId from_schedule;
    std::string actor;  // who asks
    // Idempotency-Key of the request; empty: none.
    std::string idempotency_client;
    std::string idempotency_key;
    std::string body_sha256;
    friend bool operator==(const NewOrder&, const NewOrder&) = default;
};

/// Outcome of a create: `repeated` says that this is the stored answer to an earlier request.
struct Created {
    JobOrder order;
    bool repeated = false;
};

/// A call of one of the 11 methods on an order that exists.
struct ControlRequest {
    JobMethod method = JobMethod::kStart;
    std::optional<NewOrder> update;  // Update: all that may change, as in a creation
    std::optional<std::int64_t> if_revision;
    std::string actor;
    std::string idempotency_client;
    std::string idempotency_key;
    std::string body_sha256;
};

}  // namespace pulseline::fleet
