#include "tests/tools/load/dashboard.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace pulseline::load {

Dashboard::Dashboard(std::uint16_t port, const std::string& token, bool watches,
                     const MachineWatch& machine)
    : peer_(std::make_unique<Peer>(port)), watches_(watches), machine_(machine) {
    peer_->ask_upgrade("/api/v1/stream", "Authorization: Bearer " + token + "\r\n");
}

void Dashboard::take(std::string_view text, const VehiclesById& vehicles, bool counts,
                     Totals& totals) {
    ++totals.frames;
    const auto poses = text.rfind(R"("type":"poses")");
    if (poses != std::string_view::npos && watches_) {
        take_poses(text.substr(poses), vehicles, counts, totals);
    }
    if (poses != 1) take_events(text.substr(0, poses), totals);
}

/// [["V1",x_m,y_m,heading_rad,speed_mps,age_s],...], read by hand: it is most of what comes.
void Dashboard::take_poses(std::string_view text, const VehiclesById& vehicles, bool counts,
                           Totals& totals) {
    for (std::size_t at = text.find("[["); at != std::string_view::npos;) {
        at = text.find('"', at);
        if (at == std::string_view::npos) break;
        const auto end = text.find('"', at + 1);
        const std::string_view id = text.substr(at + 1, end - at - 1);
        std::array<double, 5> values{};
        const char* from = text.data() + end + 2;
        for (double& value : values)
            from = std::from_chars(from, text.data() + text.size(), value).ptr + 1;
        const auto found = vehicles.find(id);
        if (found != vehicles.end()) {
            const auto count = static_cast<std::size_t>(std::lround(values[3] * Vehicle::kCounts)) %
                               Vehicle::kCounts;
            auto& last = seen_[found->second];
            if (count != last && count != 0 && counts) {
                const auto sent_at = found->second->sent_at[count];
                totals.to_dashboard.add(ms_since(sent_at), machine_.stood_still_since(sent_at));
            }
            last = count;
        }
        at = static_cast<std::size_t>(from - text.data());
    }
}

/// Each {"event":{...,"seq":7,"type":"..."},"type":"event"} of a frame, alone or among its changes.
/// Looked for instead of parsed: a dashboard that falls behind would fall behind further by it.
void Dashboard::take_events(std::string_view text, Totals& totals) {
    constexpr std::string_view kBegin = R"({"event":{)", kEnd = R"("type":"event"})";
    for (auto at = text.find(kBegin); at != std::string_view::npos;) {
        const auto end = text.find(kEnd, at);
        if (end == std::string_view::npos) break;
        const std::string_view event = text.substr(at, end + kEnd.size() - at);
        take_event(event, totals);
        at = text.find(kBegin, end);
    }
}

void Dashboard::take_event(std::string_view text, Totals& totals) {
    constexpr std::string_view kSeq = R"("seq":)";
    const auto at = text.rfind(kSeq);
    std::int64_t seq = 0;
    if (at == std::string_view::npos ||
        std::from_chars(text.data() + at + kSeq.size(), text.data() + text.size(), seq).ec !=
            std::errc{}) {
        return;
    }
    if (last_seq_ != 0 && seq != last_seq_ + 1)
        totals.events_lost += static_cast<std::uint64_t>(std::abs(seq - last_seq_ - 1));
    last_seq_ = seq;
    ++totals.events;
    if (text.find(R"("type":"vehicle.link")") == std::string_view::npos) return;
    const auto event = nlohmann::json::parse(text, nullptr, false).value("event", nlohmann::json());
    const auto to = event.value("params", nlohmann::json::object()).value("to", "");
    if (to == "lost" || to == "gone") totals.vehicles_lost.insert(event.value("vehicle", ""));
}

}  // namespace pulseline::load
