#include "core/fleet/orders/idempotency.hpp"

namespace pulseline::fleet {

Result<std::optional<JobOrder>> earlier_answer(const FleetState& fleet, const std::string& client,
                                               const std::string& key,
                                               const std::string& body_sha256) {
    if (key.empty()) return std::optional<JobOrder>();
    const auto it = fleet.idempotency.find({client, key});
    if (it == fleet.idempotency.end()) return std::optional<JobOrder>();
    if (it->second.body_sha256 != body_sha256) {
        return fail(Errc::kInvalid, "idempotency_key_reused",
                    "This Idempotency-Key was used with another body. Use a new key.");
    }
    return fleet.orders.look_up(it->second.order);
}

void keep_answer(FleetState& fleet, const IdempotencyRecord& record) {
    if (record.key.empty()) return;
    fleet.idempotency[{record.client, record.key}] = record;
    fleet.out.records.idempotency.push_back(record);
}

}  // namespace pulseline::fleet
