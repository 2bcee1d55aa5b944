#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/tools/load/figures.hpp"
#include "tests/tools/load/peer.hpp"
#include "tests/tools/load/vehicle.hpp"

namespace pulseline::load {

using VehiclesById = std::map<std::string, Vehicle*, std::less<>>;

/// An event as far as the load looks at it.
struct HeardEvent {
    std::int64_t seq = 0;
    std::string lost;  // vehicle it tells the loss of
};

/// The events in frames. Most dashboards get the same text one after the other, so the last one
/// that was read is kept: the load must not cost more than what it measures.
class EventReader {
public:
    const std::vector<HeardEvent>& read(std::string_view text);

private:
    std::string text_;
    std::vector<HeardEvent> events_;
};

/// One that shows the stream. `watches`: it reads the poses in it, the others only take theirs.
class Dashboard {
public:
    Dashboard(std::uint16_t port, const std::string& token, bool watches, EventReader& reader);
    /// `counts`: whether the figures of poses are wanted yet.
    void take(std::string_view text, const VehiclesById& vehicles, bool counts, Totals& totals);
    Peer& peer() { return *peer_; }

private:
    void take_poses(std::string_view text, const VehiclesById& vehicles, bool counts,
                    Totals& totals);
    void take_events(std::string_view text, Totals& totals);

    std::unique_ptr<Peer> peer_;
    EventReader& reader_;
    bool watches_;
    std::map<const Vehicle*, std::size_t> seen_;  // count of the newest state shown
    std::int64_t last_seq_ = 0;
};

}  // namespace pulseline::load
