#include "server/agent/outbox.hpp"

#include <utility>

namespace pulseline::agent {

std::optional<Outbox::Frame> Outbox::take() {
    if (!events_.empty()) {
        Frame frame{std::move(events_.front()), false};
        events_.pop_front();
        return frame;
    }
    for (auto* slot : {&state_, &visualization_}) {
        if (!*slot) continue;
        Frame frame{std::move(**slot), false};
        slot->reset();
        return frame;
    }
    if (!pictures_.empty()) {
        Frame frame{std::move(pictures_.begin()->second), true};
        pictures_.erase(pictures_.begin());
        return frame;
    }
    return std::nullopt;
}

void Outbox::clear() {
    events_.clear();
    state_.reset();
    visualization_.reset();
    pictures_.clear();
}

}  // namespace pulseline::agent
