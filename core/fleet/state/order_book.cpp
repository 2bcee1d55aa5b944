#include "core/fleet/state/order_book.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/state/fields.hpp"

namespace pulseline::fleet {

JobOrder& OrderBook::add(JobOrder order) {
    const JobOrderId id = order.id;
    JobOrder& kept = orders_.insert_or_assign(id, std::move(order)).first->second;
    if (!kept.client_order_id.empty()) of_client_[kept.client_order_id] = id;
    if (is_final(kept.state)) {
        ended_.push_back(id);
        loose_.push_back(id);
    } else {
        open_.insert(id);
        join_sequence(kept);
        if (!kept.assigned_vehicle.empty()) of_vehicle_[kept.assigned_vehicle] = id;
    }
    return kept;
}

JobOrder* OrderBook::find(JobOrderId id) {
    const auto it = orders_.find(id);
    if (it != orders_.end()) return &it->second;
    const auto packed = packed_.find(id);
    if (packed == packed_.end()) return nullptr;
    JobOrder& order = orders_.insert_or_assign(id, packed->second.order()).first->second;
    packed_.erase(packed);
    loose_.push_back(id);
    return &order;
}

const JobOrder* OrderBook::find(JobOrderId id) const {
    const auto it = orders_.find(id);
    return it == orders_.end() ? nullptr : &it->second;
}

std::optional<JobOrder> OrderBook::look_up(JobOrderId id) const {
    if (const JobOrder* order = find(id)) return *order;
    const auto packed = packed_.find(id);
    return packed == packed_.end() ? std::nullopt : std::optional(packed->second.order());
}

JobOrder OrderBook::Packed::order() const {
    JobOrder order;
    journal::Reader reader(bytes);
    reader.get(order);
    return order;
}

std::optional<JobOrderId> OrderBook::with_client_id(const std::string& client_order_id) const {
    const auto it = of_client_.find(client_order_id);
    return it == of_client_.end() ? std::nullopt : std::optional(it->second);
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
    const auto it = sequences_.find(order.sequence);
    if (it == sequences_.end() || it->second.vehicle == vehicle) return;
    it->second.vehicle = vehicle;
    for (const JobOrderId& id : it->second.open) {
        find(id)->sequence_vehicle = vehicle;
        bound_.push_back(id);
    }
}

void OrderBook::release(JobOrder& order) {
    of_vehicle_.erase(order.assigned_vehicle);
    order.assigned_vehicle = {};
}

void OrderBook::join_sequence(JobOrder& order) {
    if (order.sequence.empty()) return;
    Sequence& sequence = sequences_[order.sequence];
    sequence.open.insert(order.id);
    // From the store: whichever member knows the vehicle tells the others.
    if (sequence.vehicle.empty()) sequence.vehicle = order.sequence_vehicle;
    if (sequence.vehicle.empty()) sequence.vehicle = order.assigned_vehicle;
    for (const JobOrderId& id : sequence.open) {
        JobOrder& member = *find(id);
        if (member.sequence_vehicle == sequence.vehicle) continue;
        member.sequence_vehicle = sequence.vehicle;
        bound_.push_back(id);
    }
}

void OrderBook::leave_sequence(const JobOrder& order) {
    const auto it = sequences_.find(order.sequence);
    if (it == sequences_.end()) return;
    it->second.open.erase(order.id);
    if (it->second.open.empty()) sequences_.erase(it);
}

const std::set<JobOrderId>& OrderBook::sequence(const std::string& name) const {
    static const std::set<JobOrderId> kNone;
    const auto it = sequences_.find(name);
    return it == sequences_.end() ? kNone : it->second.open;
}

plant::VehicleId OrderBook::vehicle_of_sequence(const std::string& name) const {
    const auto it = sequences_.find(name);
    return it == sequences_.end() ? plant::VehicleId() : it->second.vehicle;
}

std::string OrderBook::sequence_of(const plant::VehicleId& vehicle) const {
    for (const auto& [name, sequence] : sequences_) {
        if (sequence.vehicle == vehicle) return name;
    }
    return {};
}

void OrderBook::set_sequence(JobOrder& order, const std::string& name) {
    if (order.sequence == name) return;
    leave_sequence(order);
    order.sequence = name;
    order.sequence_vehicle = {};
    join_sequence(order);
}

std::vector<JobOrderId> OrderBook::take_bound() { return std::exchange(bound_, {}); }

void OrderBook::close(const JobOrder& order) {
    if (open_.erase(order.id) == 0) return;
    ended_.push_back(order.id);
    loose_.push_back(order.id);
    leave_sequence(order);
    const auto it = of_vehicle_.find(order.assigned_vehicle);
    if (it != of_vehicle_.end() && it->second == order.id) of_vehicle_.erase(it);
}

/// True: one fewer is known.
bool OrderBook::forget_oldest(Time ended_before) {
    if (ended_.empty()) return false;
    const JobOrderId id = ended_.front();
    const auto loose = orders_.find(id);
    const auto packed = packed_.find(id);
    const bool known = loose != orders_.end() || packed != packed_.end();
    if (known && ended_.size() <= kMostEnded) {
        const Time ended = loose != orders_.end() ? loose->second.ended : packed->second.ended;
        if (ended >= ended_before) return false;
    }
    if (const auto order = look_up(id)) {
        const auto client = of_client_.find(order->client_order_id);
        if (client != of_client_.end() && client->second == id) of_client_.erase(client);
    }
    orders_.erase(id);
    packed_.erase(id);
    ended_.pop_front();
    return true;
}

void OrderBook::tidy(Time forget_ended_before) {
    while (forget_oldest(forget_ended_before)) {
    }
    for (; loose_.size() > kMostLoose; loose_.pop_front()) {
        const auto it = orders_.find(loose_.front());
        if (it == orders_.end()) continue;
        journal::Writer writer;
        writer.put(it->second);
        packed_.insert_or_assign(it->first, Packed{it->second.ended, writer.take()});
        orders_.erase(it);
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
        auto order = look_up(id);
        if (order && !order->removed) orders.push_back(std::move(*order));
    }
    return orders;
}

}  // namespace pulseline::fleet
