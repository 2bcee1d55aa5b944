#pragma once

#include <memory>

#include "core/fleet/state/new_order.hpp"
#include "core/fleet/state/views.hpp"

/// What would become of an order, worked out beside the fleet: with many steps that takes seconds.
namespace pulseline::fleet {

struct FleetState;
struct PreviewState;  // what the fleet knows that it takes

/// A question with all that the fleet knows about it, to be answered on another thread.
struct OrderPreviewTask {
    NewOrder order;
    Time asked;
    std::shared_ptr<const PreviewState> state;
};

/// Answers such questions as Fleet::preview does, and keeps its planner, with all that has worked
/// out, for the next one. Thread safety: none. REQUIRES: the plant outlives it.
class OrderPreviewer {
public:
    OrderPreviewer();
    ~OrderPreviewer();
    OrderPreviewer(OrderPreviewer&&) noexcept;
    OrderPreviewer& operator=(OrderPreviewer&&) noexcept;

    Preview preview(const OrderPreviewTask& task);
    /// Plans what Fleet::create would, so that the fleet finds it planned (planning::LegMemo), and
    /// the free manoeuvres, which it does not. Errors: of a creation, and why one of those cannot
    /// be driven.
    Status plan_ahead(const OrderPreviewTask& task);

private:
    void know(const PreviewState& known);

    std::unique_ptr<FleetState> fleet_;  // one without floor, ids and outputs
};

}  // namespace pulseline::fleet
