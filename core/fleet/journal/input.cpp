#include "core/fleet/journal/input.hpp"

#include <array>

#include "core/fleet/state/fields.hpp"

namespace pulseline::fleet::journal {
namespace {

constexpr std::uint64_t kMostTicks = 10'000'000;  // twelve days

constexpr std::array<const char*, std::variant_size_v<Call>> kNames = {
    "take_outputs",
    "tick",
    "vehicle_heard",
    "vehicle_state",
    "vehicle_connected",
    "vehicle_disconnected",
    "vehicle_factsheet",
    "vehicle_message_refused",
    "vehicle_identity_conflict",
    "create",
    "control_order",
    "pause_order",
    "resume_order",
    "cancel_order",
    "store_template",
    "delete_template",
    "create_schedule",
    "pause_schedule",
    "delete_schedule",
    "pause_vehicle",
    "init_position",
    "integrate",
    "pause_fleet",
    "resume_fleet",
    "close_floor",
    "reopen_floor",
    "store_failed",
    "store_works_again",
    "server_stood_still",
    "commands_expired",
    "clock_differs",
    "clock_agrees",
    "leg_planned",
    "move_lifts",
    "stop_lifts",
    "place_load",
    "put_load",
    "retire_load",
};

/// What `call` gives back: only outputs are of interest, answers went to whoever asked.
template <auto Method>
void run(Fleet& fleet, const To<Method>& call, Time at, const Taken& taken) {
    std::apply(
        [&](const auto&... arguments) {
            if constexpr (std::same_as<To<Method>, To<&Fleet::take_outputs>>) {
                taken((fleet.*Method)(arguments..., at), at);
            } else {
                static_cast<void>((fleet.*Method)(arguments..., at));
            }
        },
        call.arguments);
}

/// Core time moves in small steps; one that a broken byte makes may not overflow.
bool moved(Time& at, std::int64_t by_ns) {
    std::int64_t ns = 0;
    if (__builtin_add_overflow(to_ns(at), by_ns, &ns)) return false;
    at = time_from_ns(ns);
    return true;
}

}  // namespace

const char* name_of(const Call& call) { return kNames[call.index()]; }

template <auto Method>
void write(Writer& out, const To<Method>& call) {
    std::apply(out, call.arguments);
}

template <auto Method>
void read(Reader& in, To<Method>& call) {
    std::apply(in, call.arguments);
}

Result<std::vector<Entry>> decode(std::string_view bytes) {
    Reader in(bytes);
    std::vector<Entry> entries;
    Time at{};
    while (in.ok() && !in.at_end()) {
        const std::uint8_t kind = in.byte();
        if (!moved(at, in.difference())) in.refuse("a time out of range");
        if (kind == kTickRun) {
            const std::uint64_t count = in.number();
            if (count == 0 || count > kMostTicks) in.refuse("an impossible run of ticks");
            if (!in.ok()) break;
            entries.emplace_back(TickRun{at, static_cast<std::uint32_t>(count)});
            const auto last = kTickEvery * static_cast<std::int64_t>(count - 1);
            if (!moved(at, last.count())) in.refuse("a time out of range");
            continue;
        }
        Input input{at, {}};
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            const bool known = ((I == kind && (in.get(input.call.emplace<I>()), true)) || ...);
            if (!known) in.refuse("an unknown call");
        }
        (std::make_index_sequence<std::variant_size_v<Call>>());
        entries.emplace_back(std::move(input));
    }
    if (!in.ok()) return broken(in.why());
    return entries;
}

void apply(Fleet& fleet, const Entry& entry, const Taken& taken) {
    if (const auto* run_of_ticks = std::get_if<TickRun>(&entry)) {
        Time at = run_of_ticks->first;
        for (std::uint32_t i = 0; i < run_of_ticks->count; ++i, at += kTickEvery) {
            fleet.tick(at);
            taken(fleet.take_outputs(at), at);
        }
        return;
    }
    const Input& input = std::get<Input>(entry);
    std::visit([&](const auto& call) { run(fleet, call, input.at, taken); }, input.call);
}

}  // namespace pulseline::fleet::journal
