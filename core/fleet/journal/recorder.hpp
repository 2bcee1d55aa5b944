#pragma once

#include <optional>
#include <string>

#include "core/fleet/journal/input.hpp"
#include "core/fleet/state/fields.hpp"

namespace pulseline::fleet::journal {

/// Writes down the calls of a fleet in the order they came (Fleet::journal_into). Thread safety:
/// none, it belongs to the fleet's thread.
class Recorder {
public:
    template <auto Method, class... Args>
    void call(Time now, const Args&... arguments) {
        static_assert(std::same_as<typename To<Method>::Arguments, std::tuple<Args...>>,
                      "the arguments of the method, all of them");
        if constexpr (std::same_as<To<Method>, To<&Fleet::tick>>) {
            tick(now);
        } else {
            if (std::same_as<To<Method>, To<&Fleet::take_outputs>> && took_after_tick(now)) return;
            finish_ticks();
            begin(static_cast<std::uint8_t>(number_of<Method>()), now);
            out_(arguments...);
            if (!std::same_as<To<Method>, To<&Fleet::take_outputs>>) ++inputs_;
        }
    }

    /// All calls since the last take.
    std::string take();
    /// Forgets them: they never happened.
    void clear();
    std::size_t size() const { return out_.size(); }
    bool empty() const { return out_.size() == 0 && !tick_ && run_.count == 0; }
    /// Calls since the last take but for ticks and take_outputs, which cost nothing to keep.
    std::uint32_t inputs() const { return inputs_; }

private:
    void tick(Time now);
    bool took_after_tick(Time now);
    void finish_ticks();
    void begin(std::uint8_t number, Time now);

    Writer out_;
    Time last_{};
    std::optional<Time> tick_;  // that no take_outputs followed yet
    TickRun run_;
    std::uint32_t inputs_ = 0;
};

}  // namespace pulseline::fleet::journal

namespace pulseline::fleet {

template <auto Method, class... Args>
FleetState& Fleet::input(Time now, const Args&... arguments) {
    if (recorder_) recorder_->call<Method>(now, arguments...);
    return state_.for_input();
}

}  // namespace pulseline::fleet
