#include "core/fleet/order_book.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/fleet/views.hpp"

namespace pulseline::fleet {

JobOrder& OrderBook::add(JobOrder order) {
    const JobOrderId id = order.id;
    JobOrder& kept = orders_.insert_or_assign(id, std::move(order)).first->second;
    if (!kept.client_order_id.empty()) of_client_[kept.client_order_id] = id;
    if (is_final(kept.state)) {
        ended_.push_back(id);
    } else {
        open_.insert(id);
        if (!kept.assigned_vehicle.empty()) of_vehicle_[kept.assigned_vehicle] = id;
    }
    return kept;
}

JobOrder* OrderBook::find(JobOrderId id) {
    const auto it = orders_.find(id);
    return it == orders_.end() ? nullptr : &it->second;
}

const JobOrder* OrderBook::find(JobOrderId id) const {
    return const_cast<OrderBook*>(this)->find(id);
}

const JobOrder* OrderBook::with_client_id(const std::string& client_order_id) const {
    const auto it = of_client_.find(client_order_id);
    return it == of_client_.end() ? nullptr : find(it->second);
}

JobOrder* OrderBook::of(const plant::VehicleId& vehicle) {
    const auto it = of_vehicle_.find(vehicle);
    return it == of_vehicle_.end() ? nullptr : find(it->second);
}

const JobOrder* OrderBook::of(const plant::VehicleId& vehicle) const {
    return const_cast<OrderBook*>(this)->of(vehicle);
}

void OrderBook::assign(JobOrder& order, const plant::VehicleId& vehicle) {
    order.assigned_vehicle = vehicle;
    of_vehicle_[vehicle] = order.id;
}

void OrderBook::close(const JobOrder& order) {
    if (open_.erase(order.id) == 0) return;
    ended_.push_back(order.id);
    const auto it = of_vehicle_.find(order.assigned_vehicle);
    if (it != of_vehicle_.end() && it->second == order.id) of_vehicle_.erase(it);
}

void OrderBook::forget_ended_before(Time time) {
    while (!ended_.empty()) {
        const auto it = orders_.find(ended_.front());
        if (it != orders_.end()) {
            if (it->second.ended >= time) return;
            const auto client = of_client_.find(it->second.client_order_id);
            if (client != of_client_.end() && client->second == it->first) of_client_.erase(client);
            orders_.erase(it);
        }
        ended_.pop_front();
    }
}

std::vector<JobOrder> OrderBook::newest_first(std::size_t finished) const {
    // Not by a walk over all: a hundred thousand may have ended in a week, and every dashboard that
    // connects asks.
    std::vector<JobOrderId> ids(open_.begin(), open_.end());
    const std::size_t from = ended_.size() - std::min(finished, ended_.size());
    ids.insert(ids.end(), ended_.begin() + static_cast<std::ptrdiff_t>(from), ended_.end());
    std::ranges::sort(ids, std::greater<>());
    std::vector<JobOrder> orders;
    orders.reserve(ids.size());
    for (const auto& id : ids) {
        if (const JobOrder* order = find(id)) orders.push_back(*order);
    }
    return orders;
}

}  // namespace pulseline::fleet
