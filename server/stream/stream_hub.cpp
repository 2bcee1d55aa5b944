#include "server/stream/stream_hub.hpp"

#include <algorithm>

namespace pulseline::server {
namespace {

constexpr std::size_t kStopsShown = 50;
constexpr std::size_t kFinishedShown = 50;
constexpr std::size_t kEventsKept = 4096;
// Of changes in one frame: poses must not wait long behind them.
constexpr std::size_t kJoinedBytes = 64 << 10;

Frame frame(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

}  // namespace

StreamHub::StreamHub(const plant::Plant& plant, const api::CameraImages& images, const Clock& clock,
                     Metrics& metrics)
    : plant_(plant), images_(images), clock_(clock), metrics_(metrics) {
    for (const auto& vehicle : plant.vehicles) row_of(vehicle.id);
}

StreamHub::VehicleRow& StreamHub::row_of(const plant::VehicleId& id) {
    const auto [found, is_new] =
        row_of_.try_emplace(id, static_cast<VehicleRowIndex>(vehicles_.size()));
    if (is_new) vehicles_.emplace_back().view.id = id;
    return vehicles_[found->second];
}

void StreamHub::start(std::vector<fleet::StopRecord> stops, std::int64_t last_event_seq) {
    stops_.assign(std::make_move_iterator(stops.begin()), std::make_move_iterator(stops.end()));
    last_event_seq_ = last_event_seq;
    metrics_.event_seq = last_event_seq;
}

void StreamHub::publish(const FleetRuntime::Published& batch) {
    const auto& out = batch.outputs;
    for (const auto& vehicle : out.vehicles) {
        VehicleRow& row = row_of(vehicle.id);
        row = {vehicle, nullptr};
        const auto index = static_cast<VehicleRowIndex>(&row - vehicles_.data());
        for (auto* client : clients_) {
            if (!client->subscribed) continue;
            client->vehicles.resize(vehicles_.size());
            if (client->vehicles[index]) continue;
            client->vehicles[index] = true;
            client->changes.emplace_back(index);
        }
    }
    for (const auto& station : out.stations) push_all(frame(events::station_frame(station)));
    for (const auto& order : out.records.orders) {
        note_order(order);
        push_all(frame(events::job_order_frame(plant_, order)));
    }
    for (const auto& stop : out.records.stops) {
        stops_.push_front(stop);
        if (stops_.size() > kStopsShown) stops_.pop_back();
        push_all(frame(events::stop_record_frame(stop)));
    }
    for (const auto& event : out.records.events) {
        events_.push_back(frame(events::sse(event)));
        if (events_.size() > kEventsKept) events_.pop_front();
        last_event_seq_ = event.seq;
        push_all(frame(events::event_frame(event)));
    }
    metrics_.event_seq = last_event_seq_;
    if (batch.fleet) push_all(frame(events::fleet_frame(plant_, *batch.fleet)));
    if (!out.records.events.empty()) {
        for (const auto& [id, wake] : std::exchange(waiters_, {})) wake();
    }
}

void StreamHub::note_order(const fleet::JobOrder& order) {
    if (!fleet::is_final(order.state)) {
        open_orders_[order.id] = order.state;
    } else if (open_orders_.erase(order.id) > 0) {
        ++finished_orders_[fleet::to_string(order.state)];
    }
}

void StreamHub::beat() {
    beat_ = (beat_ + 1) % kBeats;
    for (auto* client : clients_) {
        if (client->beat != beat_ || !client->subscribed) continue;
        if (client->poses_seen != poses_.version()) {
            if (client->poses_due) ++metrics_.poses_skipped;
            client->poses_due = true;
        }
        if (client->poses_due || !client->changes.empty()) let_write(*client);
    }
}

void StreamHub::let_write(StreamClient& client) {
    client.due = client.changes.size();
    client.wake();
}

void StreamHub::add(StreamClient& client) {
    clients_.insert(&client);
    client.beat = added_++ % kBeats;
    ++metrics_.stream_clients;
}

void StreamHub::remove(StreamClient& client) {
    wanting_.erase(&client);
    if (clients_.erase(&client) > 0) --metrics_.stream_clients;
}

events::Snapshot StreamHub::take(fleet::Fleet& fleet, Time now) {
    events::Snapshot snapshot;
    snapshot.now = now;
    snapshot.fleet = fleet.view(now);
    snapshot.vehicles = fleet.vehicles(now);
    snapshot.stations = fleet.stations();
    std::size_t finished = 0;
    for (auto& order : fleet.orders()) {
        if (fleet::is_final(order.state) && ++finished > kFinishedShown) continue;
        snapshot.job_orders.push_back(std::move(order));
    }
    return snapshot;
}

void StreamHub::subscribe(StreamClient& client) {
    wanting_.insert(&client);
    if (!asking_) ask();
}

void StreamHub::resubscribe_all() {
    known_ = false;
    for (auto* client : clients_) {
        if (client->subscribed) wanting_.insert(client);
    }
    if (!asking_) ask();
}

void StreamHub::ask() {
    asking_ = true;
    ports_.snapshot([this](Result<events::Snapshot> snapshot) { share(std::move(snapshot)); });
}

void StreamHub::share(Result<events::Snapshot> snapshot) {
    if (!snapshot) {
        asking_ = false;
        return refuse_those_who_want();
    }
    if (!std::exchange(known_, true)) {
        for (const auto& vehicle : snapshot->vehicles) row_of(vehicle.id) = {vehicle, nullptr};
        open_orders_.clear();
        for (const auto& order : snapshot->job_orders) note_order(order);
    }
    snapshot->stop_records.assign(stops_.begin(), stops_.end());
    const auto place = std::make_shared<Frame>();
    for (auto* client : std::exchange(wanting_, {})) {
        if (client->overflowed) continue;
        // Changes that wait are older than the snapshot and go before it.
        client->subscribed = true;
        client->poses_seen = 0;
        // The snapshot itself is outside the limit: it is as large as the plant.
        client->changes.emplace_back(place);
    }
    const auto full = std::make_shared<const events::Snapshot>(std::move(*snapshot));
    ports_.write([this, full] { return events::snapshot_frame(plant_, images_, *full); },
                 [this, place](Frame frame) { written(place, std::move(frame)); });
}

void StreamHub::written(const Unwritten& place, Frame frame) {
    *place = std::move(frame);
    for (auto* client : clients_) {
        for (const auto& change : client->changes) {
            const auto* waits = std::get_if<Unwritten>(&change);
            if (!waits || *waits != place) continue;
            if (!*place) client->refused = true;
            let_write(*client);
        }
    }
    asking_ = false;
    if (!wanting_.empty()) ask();
}

void StreamHub::refuse_those_who_want() {
    for (auto* client : std::exchange(wanting_, {})) {
        client->refused = true;
        client->wake();
    }
}

void StreamHub::wake_all() {
    for (auto* client : clients_) client->wake();
    for (const auto& [id, wake] : std::exchange(waiters_, {})) wake();
}

void StreamHub::push(StreamClient& client, const Frame& text) {
    if (!client.subscribed || client.overflowed) return;
    client.changes.emplace_back(text);
    ++client.frames;
    client.bytes += text->size();
    if (client.frames > StreamClient::kMaxFrames || client.bytes > StreamClient::kMaxBytes) {
        client.overflowed = true;
        client.subscribed = false;
        client.changes.clear();
        client.vehicles.clear();
        client.frames = client.bytes = client.due = 0;
        ++metrics_.slow_readers_closed;
        client.wake();
    } else if (2 * client.frames >= StreamClient::kMaxFrames ||
               2 * client.bytes >= StreamClient::kMaxBytes) {
        let_write(client);  // much at once makes nobody a slow reader
    }
}

void StreamHub::push_all(const Frame& text) {
    for (auto* client : clients_) push(*client, text);
}

Frame StreamHub::next(StreamClient& client) {
    std::vector<Frame> parts;
    std::size_t bytes = 0;
    while (client.due > 0 && bytes < kJoinedBytes) {
        if (const auto* waits = std::get_if<Unwritten>(&client.changes.front())) {
            if (!parts.empty()) break;
            if (!**waits) return nullptr;
            const Frame snapshot = **waits;
            client.changes.pop_front();
            --client.due;
            return snapshot;
        }
        parts.push_back(take_change(client));
        bytes += parts.back()->size();
    }
    if (client.poses_due) parts.push_back(take_poses(client));
    return joined(std::move(parts));
}

Frame StreamHub::take_poses(StreamClient& client) {
    client.poses_due = false;
    const auto from = std::exchange(client.poses_seen, poses_.version());
    if (!last_poses_.frame || last_poses_.from != from || last_poses_.to != poses_.version()) {
        const Time now = clock_.now();
        last_poses_ = {from, poses_.version(),
                       frame(events::poses_frame(now, poses_.since(from, now)))};
    }
    return last_poses_.frame;
}

Frame StreamHub::joined(std::vector<Frame> parts) {
    if (parts.empty()) return nullptr;
    if (parts.size() == 1) return parts.front();
    if (last_joined_.parts != parts) {
        std::vector<std::string_view> texts;
        texts.reserve(parts.size());
        for (const auto& part : parts) texts.emplace_back(*part);
        last_joined_ = {std::move(parts), frame(events::changes_frame(texts))};
    }
    return last_joined_.frame;
}

Frame StreamHub::take_change(StreamClient& client) {
    const auto change = std::move(client.changes.front());
    client.changes.pop_front();
    --client.due;
    if (const auto* text = std::get_if<Frame>(&change)) {
        --client.frames;
        client.bytes -= (*text)->size();
        return *text;
    }
    const auto index = std::get<VehicleRowIndex>(change);
    client.vehicles[index] = false;
    auto& row = vehicles_[index];
    if (!row.frame) row.frame = frame(events::vehicle_frame(plant_, images_, row.view));
    return row.frame;
}

Frame StreamHub::event(std::int64_t seq) const {
    const auto oldest = last_event_seq_ - static_cast<std::int64_t>(events_.size()) + 1;
    if (seq < oldest || seq > last_event_seq_) return nullptr;
    return events_[static_cast<std::size_t>(seq - oldest)];
}

StreamHub::Waiter StreamHub::wait_for_event(std::function<void()> wake) {
    waiters_[next_waiter_] = std::move(wake);
    return next_waiter_++;
}

void StreamHub::forget(Waiter waiter) { waiters_.erase(waiter); }

std::map<std::string, int> StreamHub::orders_by_state() const {
    std::map<std::string, int> counts = finished_orders_;
    for (const auto state : {fleet::JobState::kNotAllowedToStart, fleet::JobState::kAllowedToStart,
                             fleet::JobState::kRunning, fleet::JobState::kInterrupted,
                             fleet::JobState::kEnded, fleet::JobState::kAborted}) {
        counts.try_emplace(fleet::to_string(state), 0);
    }
    for (const auto& [id, state] : open_orders_) ++counts[fleet::to_string(state)];
    return counts;
}

std::map<std::string, int> StreamHub::vehicles_by_link() const {
    std::map<std::string, int> counts;
    for (const auto link : {fleet::Link::kNever, fleet::Link::kLive, fleet::Link::kLate,
                            fleet::Link::kLost, fleet::Link::kGone}) {
        counts[fleet::to_string(link)] = 0;
    }
    for (const auto& row : vehicles_) ++counts[fleet::to_string(row.view.link)];
    return counts;
}

}  // namespace pulseline::server
