#include "tests/tools/load/dashboard.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace pulseline::load {

Dashboard::Dashboard(std::uint16_t port, const std::string& token, bool watches,
                     EventReader& reader)
    : peer_(std::make_unique<Peer>(port)), reader_(reader), watches_(watches) {
    peer_->ask_upgrade("/api/v1/stream", "Authorization: Bearer " + token + "\r\n");
}

void Dashboard::take(std::string_view text, const VehiclesById& vehicles, bool counts,
                     Totals& totals) {
    ++totals.frames;
    if (text.starts_with(R"({"type":"poses")")) {
        if (watches_) take_poses(text, vehicles, counts, totals);
    } else if (text.find(R"("type":"event")") != std::string_view::npos) {
        take_events(text, totals);
    }
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
                totals.to_dashboard.add(ms_since(found->second->sent_at[count]));
            }
            last = count;
        }
        at = static_cast<std::size_t>(from - text.data());
    }
}

void Dashboard::take_events(std::string_view text, Totals& totals) {
    for (const auto& event : reader_.read(text)) {
        if (last_seq_ != 0 && event.seq != last_seq_ + 1)
            totals.events_lost += static_cast<std::uint64_t>(std::abs(event.seq - last_seq_ - 1));
        last_seq_ = event.seq;
        ++totals.events;
        if (!event.lost.empty()) totals.vehicles_lost.insert(event.lost);
    }
}

const std::vector<HeardEvent>& EventReader::read(std::string_view text) {
    if (text == text_) return events_;
    text_ = text;
    events_.clear();
    const auto frame = nlohmann::json::parse(text, nullptr, false);
    if (!frame.is_object()) return events_;
    const auto& changes = frame.contains("changes") ? frame["changes"] : nlohmann::json{frame};
    for (const auto& change : changes) {
        if (!change.contains("event")) continue;
        const auto& event = change["event"];
        HeardEvent heard{event["seq"].get<std::int64_t>(), ""};
        if (event["type"] == "vehicle.link") {
            const auto to = event["params"].value("to", "");
            if (to == "lost" || to == "gone") heard.lost = event.value("vehicle", "");
        }
        events_.push_back(std::move(heard));
    }
    return events_;
}

}  // namespace pulseline::load
