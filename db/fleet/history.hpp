#pragma once

#include "core/fleet/state/ports.hpp"
#include "db/database.hpp"

namespace pulseline::db {

/// Reads orders, stops and events on a connection of its own. Pages go by id, which grows with
/// time, so rows added meanwhile shift nothing. `connection` must outlive it. Thread safety: none,
/// as ReadOnly.
class History : public fleet::History {
public:
    explicit History(ReadOnly& connection) : connection_(connection) {}

    std::vector<fleet::StopRecord> stops(const fleet::StopQuery& query) override;
    std::optional<fleet::StopRecord> stop(fleet::StopRecordId id) override;
    std::vector<fleet::Event> unmeasured_stops(const fleet::UnmeasuredQuery& query) override;
    std::vector<fleet::LoadMove> load_moves(const fleet::LoadMoveQuery& query) override;
    bool has_load_sheet(const plant::LoadId& id) override;
    std::vector<fleet::JobOrder> orders(const fleet::OrderQuery& query) override;
    std::optional<fleet::JobOrder> order(fleet::JobOrderId id) override;
    std::vector<fleet::Event> events_after(std::int64_t seq, int limit) override;
    fleet::StopStatistics statistics(const std::vector<plant::VehicleId>& vehicles,
                                     plant::MotionMode mode, int newest) override;

private:
    ReadOnly& connection_;
};

}  // namespace pulseline::db
