#include "server/runtime/published.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>

#include "core/fleet/state/event_types.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::server {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

bool has_action(const fleet::VehicleMessage& message, std::initializer_list<const char*> types) {
    if (!message.instant_actions) return false;
    return std::ranges::any_of(message.instant_actions->actions,
                               [&](const vda5050::Action& action) {
                                   return std::ranges::find(types, action.type) != types.end();
                               });
}

bool goes_on(const fleet::Event& event) {
    return std::ranges::any_of(event.params, [](const auto& param) {
        const auto* to = std::get_if<std::string>(&param.value);
        return param.name == "to" && to && (*to == "Running" || *to == "AllowedToStart");
    });
}

}  // namespace

void append(fleet::Records& to, const fleet::Records& from) {
    std::apply(
        [&](auto&... into) {
            std::apply([&](const auto&... lists) { (append(into, lists), ...); },
                       fleet::lists_of(from));
        },
        fleet::lists_of(to));
}

void append(Published& to, Published from) {
    append(to.outputs.records, from.outputs.records);
    append(to.outputs.messages, from.outputs.messages);
    append(to.outputs.vehicles, from.outputs.vehicles);
    append(to.outputs.stations, from.outputs.stations);
    append(to.outputs.plans_wanted, from.outputs.plans_wanted);
    to.outputs.fleet_changed |= from.outputs.fleet_changed;
    if (from.fleet) to.fleet = std::move(from.fleet);
}

std::vector<fleet::VehicleMessage> take_stops(std::vector<fleet::VehicleMessage>& messages) {
    std::vector<fleet::VehicleMessage> stops;
    std::vector<fleet::VehicleMessage> rest;
    for (auto& message : messages) {
        const bool stop =
            !message.order && !starts(message) &&
            has_action(message, {vda5050::kStartPause, vda5050::kCancelOrder, vda5050::kStopLifts});
        (stop ? stops : rest).push_back(std::move(message));
    }
    messages = std::move(rest);
    return stops;
}

bool starts(const fleet::VehicleMessage& message) {
    return message.order || has_action(message, {vda5050::kStopPause, vda5050::kSetBracketHeight,
                                                 vda5050::kLowerParking, vda5050::kRaiseParking,
                                                 vda5050::kPick, vda5050::kDrop});
}

void append_starts(Acts& to, const std::vector<fleet::Event>& events) {
    for (const auto& event : events) {
        if (event.actor.empty()) continue;
        const bool vehicle = event.type == fleet::event::kVehicleResumed ||
                             event.type == fleet::event::kVehicleLifts;
        if (vehicle) to.vehicles.push_back(event.vehicle);
        const bool order = event.type == fleet::event::kJobOrderCreated ||
                           (event.type == fleet::event::kJobOrderState && goes_on(event));
        if (order) to.orders.push_back(event.order);
    }
}

}  // namespace pulseline::server
