#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/fleet/state/job_order.hpp"

namespace pulseline::fleet {

/// The job orders in memory with the look-ups that every step of the fleet needs: no step may cost
/// more because many orders have ended. Those that ended a while ago lie packed, as few hundred
/// bytes each, and are unpacked for whoever changes them.
class OrderBook {
public:
    static constexpr std::size_t kMostLoose = 1000;    // ended and not packed
    static constexpr std::size_t kMostEnded = 100000;  // known at all; the store has the rest

    /// A new order, or one from the store.
    JobOrder& add(JobOrder order);
    /// To change it. A packed one is unpacked; references stay valid until the next tidy().
    JobOrder* find(JobOrderId id);
    /// Null also for a packed one.
    const JobOrder* find(JobOrderId id) const;
    /// A copy of it, packed or not.
    std::optional<JobOrder> look_up(JobOrderId id) const;
    /// The order a client gave this name.
    std::optional<JobOrderId> with_client_id(const std::string& client_order_id) const;
    bool knows(JobOrderId id) const { return orders_.contains(id) || packed_.contains(id); }

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
    /// Forgets orders that ended before, and the oldest of too many; the store keeps them. Packs
    /// all ended ones but the last.
    void tidy(Time forget_ended_before);

    /// All open ones and the newest `finished` of the others, without those that Cancel or Clear
    /// took out.
    std::vector<JobOrder> newest_first(std::size_t finished) const;

    /// Shows a visitor all members, for snapshots.
    template <class V, class Self>
    static void members(V& visit, Self& self) {
        auto& [orders, packed, open, of_vehicle, of_client, sequences, bound, ended, loose] = self;
        visit(orders, packed, open, of_vehicle, of_client, sequences, bound, ended, loose);
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
    struct Packed {
        Time ended;
        std::string bytes;  // as the journal writes an order
        JobOrder order() const;
        template <class V, class Self>
        static void members(V& visit, Self& self) {
            auto& [its_end, its_bytes] = self;
            visit(its_end, its_bytes);
        }
    };
    bool forget_oldest(Time ended_before);
    void join_sequence(JobOrder& order);
    void leave_sequence(const JobOrder& order);

    std::map<JobOrderId, JobOrder> orders_;
    std::map<JobOrderId, Packed> packed_;
    std::set<JobOrderId> open_;
    std::map<plant::VehicleId, JobOrderId> of_vehicle_;
    std::map<std::string, JobOrderId> of_client_;
    std::map<std::string, Sequence> sequences_;
    std::vector<JobOrderId> bound_;
    std::deque<JobOrderId> ended_;  // in the order in which they ended
    std::deque<JobOrderId> loose_;  // of them, those to be packed next
};

}  // namespace pulseline::fleet
