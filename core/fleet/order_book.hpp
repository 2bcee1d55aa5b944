#pragma once

#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/fleet/job_order.hpp"

namespace pulseline::fleet {

/// The job orders in memory with the look-ups that every step of the fleet needs: no step may cost
/// more because many orders have ended.
class OrderBook {
public:
    /// A new order, or one from the store.
    JobOrder& add(JobOrder order);
    JobOrder* find(JobOrderId id);
    const JobOrder* find(JobOrderId id) const;
    /// The order a client gave this name, or null.
    const JobOrder* with_client_id(const std::string& client_order_id) const;

    /// Not yet final, oldest first (UUIDv7 sorts by age).
    const std::set<JobOrderId>& open() const { return open_; }
    /// The open order the vehicle works for, or null.
    JobOrder* of(const plant::VehicleId& vehicle);
    const JobOrder* of(const plant::VehicleId& vehicle) const;
    /// Also binds what is open of the order's sequence to the vehicle.
    void assign(JobOrder& order, const plant::VehicleId& vehicle);
    /// An open order has no vehicle any more.
    void release(JobOrder& order);

    /// Open orders of a sequence, oldest first; empty when there is none of that name. A sequence
    /// is over, and its name free, when all of its orders are final.
    const std::set<JobOrderId>& sequence(const std::string& name) const;
    /// The vehicle a sequence has; empty: none yet.
    plant::VehicleId vehicle_of_sequence(const std::string& name) const;
    /// The open sequence that keeps the vehicle; empty: none.
    std::string sequence_of(const plant::VehicleId& vehicle) const;
    /// Moves an open order to another sequence (empty: none).
    void set_sequence(JobOrder& order, const std::string& name);
    /// Orders whose sequence_vehicle changed since the last call.
    std::vector<JobOrderId> take_bound();

    /// To be called once when the order's state has become final.
    void close(const JobOrder& order);
    /// Forgets orders that ended before; the store keeps them.
    void forget_ended_before(Time time);

    /// All open ones and the newest `finished` of the others, without those that Cancel or Clear
    /// took out.
    std::vector<JobOrder> newest_first(std::size_t finished) const;

    /// Shows a visitor all members, for snapshots.
    template <class V, class Self>
    static void members(V& visit, Self& self) {
        auto& [orders, open, of_vehicle, of_client, sequences, bound, ended] = self;
        visit(orders, open, of_vehicle, of_client, sequences, bound, ended);
    }

private:
    struct Sequence {
        plant::VehicleId vehicle;
        std::set<JobOrderId> open;
        template <class V, class Self>
        static void members(V& visit, Self& self) {
            auto& [its_vehicle, its_open] = self;
            visit(its_vehicle, its_open);
        }
    };
    void join_sequence(JobOrder& order);
    void leave_sequence(const JobOrder& order);

    std::map<JobOrderId, JobOrder> orders_;
    std::set<JobOrderId> open_;
    std::map<plant::VehicleId, JobOrderId> of_vehicle_;
    std::map<std::string, JobOrderId> of_client_;
    std::map<std::string, Sequence> sequences_;
    std::vector<JobOrderId> bound_;
    std::deque<JobOrderId> ended_;  // in the order in which they ended
};

}  // namespace pulseline::fleet
