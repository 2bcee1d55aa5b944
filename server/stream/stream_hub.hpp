#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "api/events/frames.hpp"
#include "server/base/metrics.hpp"
#include "server/base/pose_table.hpp"
#include "server/runtime/fleet_runtime.hpp"

namespace pulseline::server {

using Frame = std::shared_ptr<const std::string>;

/// A snapshot that is being written down elsewhere: what changes meanwhile waits behind it.
using Unwritten = std::shared_ptr<Frame>;

/// Of a vehicle in StreamHub's rows. A thousand of them may wait for each of two hundred
/// dashboards.
using VehicleRowIndex = std::uint32_t;

/// What waits to be written to one dashboard: changes in order, of poses and vehicles only the
/// newest. The session's writer takes frames with StreamHub::next().
struct StreamClient {
    // Of what cannot be left out. Vehicles in `changes` do not count: there is one entry for each.
    static constexpr std::size_t kMaxFrames = 1024;
    static constexpr std::size_t kMaxBytes = 1 << 20;

    std::function<void()> wake;  // there is something to write
    unsigned beat = 0;           // of StreamHub::kBeats
    bool subscribed = false;     // a snapshot is in the queue or written
    bool overflowed = false;     // fell behind: close with 1013
    bool refused = false;        // there is no snapshot for it now: close with 1013
    std::deque<std::variant<Frame, VehicleRowIndex, Unwritten>> changes;
    std::size_t due = 0;         // of `changes`: were there when it had its turn
    std::vector<bool> vehicles;  // by row: in `changes`
    std::size_t frames = 0;      // in `changes`
    std::size_t bytes = 0;       // of those
    std::uint64_t poses_seen = 0;
    bool poses_due = false;
};

/// Tells dashboards and event readers what was committed. Thread safety: none, the network thread
/// owns it.
class StreamHub {
public:
    struct Ports {
        /// Asks the fleet; answers on the network thread.
        std::function<void(std::function<void(Result<events::Snapshot>)>)> snapshot;
        /// Writes a long frame down on another thread; answers on the network thread. Null: it
        /// could not.
        std::function<void(std::function<std::string()>, std::function<void(Frame)>)> write;
    };
    StreamHub(const plant::Plant& plant, const api::CameraImages& images, const Clock& clock,
              Metrics& metrics);

    /// Before anything else.
    void connect(Ports ports) { ports_ = std::move(ports); }

    /// State at start: `stops` newest first.
    void start(std::vector<fleet::StopRecord> stops, std::int64_t last_event_seq);
    void publish(const FleetRuntime::Published& batch);
    /// Dashboards write ten times a second what came meanwhile, not each change by itself: with two
    /// hundred of them the writes are what costs. In four turns, one every kBeatPeriod, so that
    /// nobody's request waits until all two hundred have written; those of a turn share frames.
    static constexpr unsigned kBeats = 4;
    static constexpr auto kBeatPeriod = std::chrono::milliseconds(100) / kBeats;
    /// Lets those whose turn it is write: there are changes, or poses put since their last turn.
    void beat();
    PoseTable& poses() { return poses_; }

    void add(StreamClient& client);
    void remove(StreamClient& client);
    /// The client gets a snapshot soon, and every change since. Those who ask while one is on its
    /// way share the next: however many come at once, one is written down at a time.
    void subscribe(StreamClient& client);
    /// What a snapshot needs of the fleet; runs on the fleet thread.
    static events::Snapshot take(fleet::Fleet& fleet, Time now);
    /// Everybody gets a new snapshot, since changes were lost with the fleet.
    void resubscribe_all();
    /// Every stream looks again whether it may go on: somebody's rights may have changed.
    void wake_all();
    /// Next frame to write; null until the client's next turn. What waits goes together in one.
    Frame next(StreamClient& client);

    // Event readers: kept by sequence number, so that a reader joins without gap or double.
    std::int64_t last_event_seq() const { return last_event_seq_; }
    /// The event in server-sent form when it is still in memory.
    Frame event(std::int64_t seq) const;
    using Waiter = std::uint64_t;
    Waiter wait_for_event(std::function<void()> wake);
    void forget(Waiter waiter);

    // Counted for /metrics.
    std::map<std::string, int> orders_by_state() const;
    std::map<std::string, int> vehicles_by_link() const;

private:
    struct VehicleRow {
        fleet::VehicleView view;
        Frame frame;  // made when first needed
    };

    static void let_write(StreamClient& client);
    Frame take_change(StreamClient& client);
    Frame take_poses(StreamClient& client);
    Frame joined(std::vector<Frame> parts);
    VehicleRow& row_of(const plant::VehicleId& id);
    void push(StreamClient& client, const Frame& frame);
    void push_all(const Frame& frame);
    void ask();
    void share(Result<events::Snapshot> snapshot);
    void written(const Unwritten& place, Frame frame);
    void refuse_those_who_want();
    void note_order(const fleet::JobOrder& order);

    const plant::Plant& plant_;
    const api::CameraImages& images_;
    const Clock& clock_;
    Metrics& metrics_;
    PoseTable poses_;
    Ports ports_;
    std::set<StreamClient*> clients_;
    unsigned added_ = 0;               // clients, ever; they take the beats in turn
    unsigned beat_ = 0;                // whose turn was last
    std::set<StreamClient*> wanting_;  // a snapshot
    bool asking_ = false;              // one is on its way to be written
    bool known_ = true;                // false: the rows here may be of a fleet that is no more
    std::vector<VehicleRow> vehicles_;
    std::map<plant::VehicleId, VehicleRowIndex> row_of_;
    std::map<fleet::JobOrderId, fleet::JobState> open_orders_;
    std::map<std::string, int> finished_orders_;  // since start
    std::deque<fleet::StopRecord> stops_;         // newest first
    std::deque<Frame> events_;                    // the newest, oldest first
    std::int64_t last_event_seq_ = 0;
    std::map<Waiter, std::function<void()>> waiters_;
    Waiter next_waiter_ = 1;
    struct {
        std::uint64_t from = 0;
        std::uint64_t to = 0;
        Frame frame;
    } last_poses_;  // most clients have seen the same poses
    struct {
        std::vector<Frame> parts;
        Frame frame;
    } last_joined_;  // and miss the same changes
};

}  // namespace pulseline::server
