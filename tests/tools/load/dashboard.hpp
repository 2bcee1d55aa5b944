#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "tests/tools/load/figures.hpp"
#include "tests/tools/load/machine_watch.hpp"
#include "tests/tools/load/peer.hpp"
#include "tests/tools/load/vehicle.hpp"

namespace pulseline::load {

using VehiclesById = std::map<std::string, Vehicle*, std::less<>>;

/// One that shows the stream. `watches`: it reads the poses in it, the others only take theirs.
class Dashboard {
public:
    Dashboard(std::uint16_t port, const std::string& token, bool watches,
              const MachineWatch& machine);
    /// `counts`: whether the figures of poses are wanted yet.
    void take(std::string_view text, const VehiclesById& vehicles, bool counts, Totals& totals);
    Peer& peer() { return *peer_; }

private:
    void take_poses(std::string_view text, const VehiclesById& vehicles, bool counts,
                    Totals& totals);
    void take_events(std::string_view text, Totals& totals);
    void take_event(std::string_view text, Totals& totals);

    std::unique_ptr<Peer> peer_;
    bool watches_;
    const MachineWatch& machine_;
    std::map<const Vehicle*, std::size_t> seen_;  // count of the newest state shown
    std::int64_t last_seq_ = 0;
};

}  // namespace pulseline::load
