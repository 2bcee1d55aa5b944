#include "core/fleet/dispatch/urgency.hpp"

#include <algorithm>

#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {

std::vector<JobOrder*> by_urgency(FleetState& fleet, JobState state) {
    std::vector<JobOrder*> orders;
    for (const JobOrderId& id : fleet.orders.open()) {
        JobOrder* order = fleet.find(id);
        if (order->state == state) orders.push_back(order);
    }
    std::stable_sort(orders.begin(), orders.end(), [](const JobOrder* a, const JobOrder* b) {
        return a->priority != b->priority ? a->priority > b->priority : a->number < b->number;
    });
    return orders;
}

}  // namespace pulseline::fleet
