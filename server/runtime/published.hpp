#pragma once

#include <exception>
#include <optional>
#include <vector>

#include "core/fleet/fleet.hpp"
#include "server/base/log.hpp"
#include "server/base/store_fault.hpp"

namespace pulseline::server {

/// What a step of the fleet tells the vehicles and the dashboards.
struct Published {
    fleet::Outputs outputs;
    std::optional<fleet::FleetView> fleet;  // when it changed
};

void append(fleet::Records& to, const fleet::Records& from);
/// `from` came later.
void append(Published& to, Published from);

/// Takes out the messages that make a vehicle stand: they may go before anything is stored.
std::vector<fleet::VehicleMessage> take_stops(std::vector<fleet::VehicleMessage>& messages);
/// Whether it could set a vehicle in motion again.
bool starts(const fleet::VehicleMessage& message);

/// What people and programs set going, by the events of it.
struct Acts {
    std::vector<plant::VehicleId> vehicles;  // allowed to move
    std::vector<fleet::JobOrderId> orders;   // made, started or resumed
    bool empty() const { return vehicles.empty() && orders.empty(); }
};
void append_starts(Acts& to, const std::vector<fleet::Event>& events);

/// Does one of several things that have nothing to do with each other: what it throws is logged
/// and ends only that one.
template <class F>
void guarded(const char* what_for, F&& f) noexcept {
    try {
        try {
            f();
        } catch (...) {
            log::error("step_threw",
                       {{"step", what_for}, {"what", what(std::current_exception())}});
        }
    } catch (...) {  // no memory even for the line
    }
}

}  // namespace pulseline::server
