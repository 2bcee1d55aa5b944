#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "core/fleet/fleet.hpp"

/// Every call that may change a Fleet, as data. The list is the journal's vocabulary: a call's
/// number in the journal is its place here.
namespace pulseline::fleet::journal {

/// Arguments of a call of one method, but for the time.
template <auto Method>
struct To;
template <class R, class... Args, R (Fleet::*Method)(Args...)>
struct To<Method> {
    using All = std::tuple<std::remove_cvref_t<Args>...>;
    template <std::size_t... I>
    static std::tuple<std::tuple_element_t<I, All>...> but_last(std::index_sequence<I...>);
    using Arguments = decltype(but_last(std::make_index_sequence<sizeof...(Args) - 1>()));
    static_assert(std::same_as<std::tuple_element_t<sizeof...(Args) - 1, All>, Time>);

    Arguments arguments;
};

using Call = std::variant<
    To<&Fleet::take_outputs>, To<&Fleet::tick>, To<&Fleet::vehicle_heard>,
    To<&Fleet::vehicle_state>, To<&Fleet::vehicle_connected>, To<&Fleet::vehicle_disconnected>,
    To<&Fleet::vehicle_factsheet>, To<&Fleet::vehicle_message_refused>,
    To<&Fleet::vehicle_identity_conflict>, To<&Fleet::create>, To<&Fleet::control_order>,
    To<&Fleet::pause_order>, To<&Fleet::resume_order>, To<&Fleet::cancel_order>,
    To<&Fleet::store_template>, To<&Fleet::delete_template>, To<&Fleet::create_schedule>,
    To<&Fleet::pause_schedule>, To<&Fleet::delete_schedule>, To<&Fleet::pause_vehicle>,
    To<&Fleet::init_position>, To<&Fleet::integrate>, To<&Fleet::pause_fleet>,
    To<&Fleet::resume_fleet>, To<&Fleet::close_floor>, To<&Fleet::reopen_floor>,
    To<&Fleet::store_failed>, To<&Fleet::store_works_again>, To<&Fleet::server_stood_still>,
    To<&Fleet::commands_expired>, To<&Fleet::clock_differs>, To<&Fleet::clock_agrees>,
    To<&Fleet::leg_planned>, To<&Fleet::move_lifts>, To<&Fleet::stop_lifts>, To<&Fleet::place_load>,
    To<&Fleet::put_load>, To<&Fleet::retire_load>>;

/// Place of a method's call in the list; does not compile for a method that is not in it.
template <auto Method>
constexpr std::size_t number_of() {
    return Call(To<Method>{}).index();
}

struct Input {
    Time at;
    Call call;
};
/// "vehicle_state"
const char* name_of(const Call& call);

/// Ticks come at whole multiples of this, so that the journal keeps runs of them instead of each.
constexpr Duration kTickEvery = std::chrono::milliseconds(100);

constexpr std::uint8_t kTickRun = 0xff;  // in the place of a call's number

/// `count` times: a tick and, at the same time, take_outputs; kTickEvery apart.
struct TickRun {
    Time first;
    std::uint32_t count = 0;
};
using Entry = std::variant<Input, TickRun>;

/// What a Recorder wrote. Errors: journal_broken {why}.
Result<std::vector<Entry>> decode(std::string_view bytes);

/// Does what was done; `taken` gets every step's outputs.
using Taken = std::function<void(Outputs&&, Time at)>;
void apply(Fleet& fleet, const Entry& entry, const Taken& taken);

}  // namespace pulseline::fleet::journal
