#include "api/events/frames.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <iterator>

#include "api/http/orders/job_order_json.hpp"
#include "api/http/vehicles/vehicle_json.hpp"
#include "api/http/wire/common_json.hpp"

namespace pulseline::events {
namespace {

using api::Json;

std::string frame(const char* type, Json content) {
    return api::dump({{"type", type}, {type, std::move(content)}});
}

/// As fmt's "{:.5f}", without zeros at the end and a fifth of its time: whole numbers are quick.
void append_rounded(std::string& text, double value, int decimals) {
    constexpr std::array kTens{1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6};
    constexpr double kWhole = 1e15;  // up to there a double holds whole numbers exactly
    const double scaled = value * kTens.at(static_cast<std::size_t>(decimals));
    if (!(std::abs(scaled) < kWhole)) {
        fmt::format_to(std::back_inserter(text), "{:.{}f}", value, decimals);
        return;
    }
    auto digits = std::llround(std::abs(scaled));
    for (; decimals > 0 && digits % 10 == 0; --decimals) digits /= 10;
    if (digits != 0 && value < 0) text += '-';
    std::array<char, 20> buffer;
    auto at = buffer.end();
    for (int n = 0; digits > 0 || n <= decimals; ++n) {
        if (n == decimals && n > 0) *--at = '.';
        *--at = static_cast<char>('0' + digits % 10);
        digits /= 10;
    }
    text.append(at, buffer.end());
}

}  // namespace

std::string snapshot_frame(const plant::Plant& plant, const api::CameraImages& images,
                           const Snapshot& snapshot) {
    const auto vehicle = [&](const fleet::VehicleView& view) {
        return api::vehicle_json(plant, images, view);
    };
    const auto order = [&](const fleet::JobOrder& one) { return api::job_order_json(plant, one); };
    return api::dump(
        {{"type", "snapshot"},
         {"server_time", api::rfc3339(snapshot.now)},
         {"fleet", api::fleet_json(plant, snapshot.fleet)},
         {"vehicles", api::list_json(snapshot.vehicles, vehicle)},
         {"stations", api::list_json(snapshot.stations, api::station_state_json)},
         {"job_orders", api::list_json(snapshot.job_orders, order)},
         {"stop_records", api::list_json(snapshot.stop_records, api::stop_record_json)}});
}

std::string poses_frame(Time at, const std::vector<PoseSample>& poses) {
    // Ten times a second for every vehicle: rounded to 0.01 mm and written without a tree.
    std::string text = fmt::format(R"({{"type":"poses","at":"{}","poses":[)", api::rfc3339(at));
    text.reserve(text.size() + 64 * poses.size());
    for (const PoseSample& sample : poses) {
        text += &sample == poses.data() ? "[" : ",[";
        text += api::dump(sample.vehicle.str());
        append_rounded(text += ',', sample.pose.x_m, 5);
        append_rounded(text += ',', sample.pose.y_m, 5);
        append_rounded(text += ',', sample.pose.heading_rad, 6);
        append_rounded(text += ',', sample.speed_mps, 4);
        append_rounded(text += ',', sample.age_s, 2);
        text += ']';
    }
    return text + "]}";
}

std::string vehicle_frame(const plant::Plant& plant, const api::CameraImages& images,
                          const fleet::VehicleView& vehicle) {
    return frame("vehicle", api::vehicle_json(plant, images, vehicle));
}

std::string station_frame(const fleet::StationView& station) {
    return frame("station", api::station_state_json(station));
}

std::string job_order_frame(const plant::Plant& plant, const fleet::JobOrder& order) {
    return frame("job_order", api::job_order_json(plant, order));
}

std::string stop_record_frame(const fleet::StopRecord& stop) {
    return frame("stop_record", api::stop_record_json(stop));
}

std::string fleet_frame(const plant::Plant& plant, const fleet::FleetView& fleet) {
    return frame("fleet", api::fleet_json(plant, fleet));
}

std::string event_frame(const fleet::Event& event) {
    return frame("event", api::event_json(event));
}

std::string changes_frame(const std::vector<std::string_view>& frames) {
    return fmt::format(R"({{"type":"changes","changes":[{}]}})", fmt::join(frames, ","));
}

std::string sse(const fleet::Event& event) {
    // dump() escapes line ends, so one data line always suffices.
    return fmt::format("id: {}\nevent: {}\ndata: {}\n\n", event.seq, event.type,
                       api::dump(api::event_json(event)));
}

std::string sse_reset(std::int64_t from, std::int64_t oldest) {
    return fmt::format("id: {}\nevent: stream.reset\ndata: {{\"from\":{},\"oldest\":{}}}\n\n",
                       oldest - 1, from, oldest);
}

std::string sse_keep_alive() { return ": still here\n\n"; }

}  // namespace pulseline::events
