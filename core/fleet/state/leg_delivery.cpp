#include "core/fleet/state/leg_delivery.hpp"

namespace pulseline::fleet {

LegDelivery::Phase LegDelivery::phase() const {
    if (all_.lost) return Phase::kLost;
    if (all_.seen) return Phase::kSeen;
    return unconfirmed() ? Phase::kSent : Phase::kPlanned;
}

void LegDelivery::begin() {
    const std::size_t from = all_.sent_from;
    all_ = {};
    all_.sent_from = from;  // says nothing until the next message, and stands in old journals
}

void LegDelivery::sent(std::size_t from, bool connected, Time now) {
    all_.sent_from = from;
    all_.unconfirmed_since = now;
    if (connected) all_.on_this_connection = now;
    ++all_.sends;
}

bool LegDelivery::shown(Time now) {
    if (all_.seen) return false;
    all_.seen = true;
    all_.lost = false;  // it was on its way after all
    if (!all_.started) all_.started = now;
    return true;
}

void LegDelivery::confirmed() {
    all_.unconfirmed_since.reset();
    all_.sends = 0;
}

void LegDelivery::give_up() {
    all_.seen = false;
    all_.unconfirmed_since.reset();
    all_.lost = true;
}

void LegDelivery::cancel() {
    all_.cancelling = true;
    all_.unconfirmed_since.reset();
}

}  // namespace pulseline::fleet
