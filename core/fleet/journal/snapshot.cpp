#include "core/fleet/journal/snapshot.hpp"

#include <cassert>
#include <memory>

#include "core/fleet/fleet.hpp"
#include "core/fleet/floor/closures.hpp"
#include "core/fleet/floor/holding.hpp"
#include "core/fleet/journal/state_fields.hpp"
#include "core/fleet/restore.hpp"
#include "core/fleet/vehicle/loads.hpp"

namespace pulseline::fleet {
namespace journal {
namespace {

constexpr std::size_t kChecksumSize = 8;

/// Vehicles by the plant's names. False: these are not the plant's.
void read_vehicles(Reader& in, FleetState& fleet) {
    if (in.length() != fleet.vehicles.size()) return in.refuse("other vehicles than the plant's");
    for (auto& [id, live] : fleet.vehicles) {
        in.get(live);
        if (live.awaited_plan) live.awaited_plan->request.type = live.type;
        if (live.record.id != id) return in.refuse("other vehicles than the plant's");
    }
}

/// By the loads, which stand behind the vehicles, and by what a vehicle is about to take over.
void read_classes(Reader& in, FleetState& fleet) {
    for (const auto& [id, record] : fleet.loads) {
        if (id != record.id || !find_load(fleet, id)) {
            return in.refuse("a place of a load that nobody knows");
        }
    }
    find_loads(fleet);
    for (auto& [id, live] : fleet.vehicles) {
        const std::size_t of_class = live.floor.of_class;
        find_class(fleet, live);
        if (live.floor.of_class != of_class) return in.refuse("other classes than the plant's");
    }
}

/// Traffic with the graphs of the plant in it takes what was written of it, if that was of the
/// same graphs.
bool same_floor(const std::vector<traffic::TileId>& of_graphs, const traffic::Traffic& traffic) {
    const auto& order = traffic.tile_order();
    return order.size() >= of_graphs.size() &&
           std::equal(of_graphs.begin(), of_graphs.end(), order.begin());
}

void read_state(Reader& in, FleetState& fleet) {
    take_vehicles_of_plant(fleet);
    fleet.floor.traffic = fleet.tables->empty_floor;
    const std::vector<traffic::TileId> of_graphs = fleet.floor.traffic.tile_order();
    read_vehicles(in, fleet);
    in.get(fleet);
    if (!in.ok()) return;
    read_classes(in, fleet);
    if (!in.ok()) return;
    if (!in.at_end()) return in.refuse("more bytes than a snapshot has");
    if (!same_floor(of_graphs, fleet.floor.traffic)) return in.refuse("another floor");
    if (fleet.floor.traffic.vehicle_count() != fleet.vehicles.size()) {
        return in.refuse("other vehicles in traffic");
    }
    for (const auto& [id, live] : fleet.vehicles) {
        if (live.floor.vehicle >= fleet.vehicles.size()) in.refuse("a vehicle traffic has not");
    }
    close_to_planner(fleet);
    // What it found before has stopped the floor already (Floor::stopped).
    static_cast<void>(fleet.floor.monitor.apply(fleet.floor.traffic.all_as_changes()));
}

}  // namespace

std::string sealed(std::string_view bytes) {
    Writer out;
    out.fixed(checksum(bytes));
    out.raw(bytes);
    return out.take();
}

Result<std::string_view> unsealed(std::string_view bytes) {
    if (bytes.size() < kChecksumSize) return broken("it is too short");
    Reader in(bytes.substr(0, kChecksumSize));
    const std::string_view content = bytes.substr(kChecksumSize);
    if (in.fixed() != checksum(content)) return broken("its checksum does not fit");
    return content;
}

}  // namespace journal

std::string Fleet::snapshot() const {
    const FleetState& fleet = *state_;
    assert(fleet.stored_orders.empty() && fleet.stored_vehicles.empty() &&
           fleet.changed_vehicles.empty() && fleet.out.records.empty());
    journal::Writer out;
    out.reserve(std::size_t{1} << 20);
    out.number(fleet.vehicles.size());
    for (const auto& [id, live] : fleet.vehicles) out.put(live);
    out.put(fleet);
    return out.take();
}

Result<std::unique_ptr<Fleet>> Fleet::from_snapshot(const plant::Plant& plant,
                                                    std::string_view bytes,
                                                    std::shared_ptr<const PlantTables> tables) {
    auto state = std::make_unique<FleetState>(
        plant, tables ? std::move(tables) : plant_tables(plant), 0, Time{});
    journal::Reader in(bytes);
    journal::read_state(in, *state);
    if (!in.ok()) return journal::broken(in.why());
    return std::unique_ptr<Fleet>(new Fleet(std::move(state)));
}

}  // namespace pulseline::fleet
