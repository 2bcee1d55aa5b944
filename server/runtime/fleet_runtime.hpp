#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/fleet/fleet.hpp"
#include "server/base/metrics.hpp"
#include "server/base/store_fault.hpp"
#include "server/runtime/journal_keeper.hpp"
#include "server/runtime/published.hpp"

namespace pulseline::server {

/// The database did not take a write; nothing of it was kept.
struct StoreUnavailable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Owns the fleet. One thread handles what is asked of it in batches, one thread commits what the
/// batches put out; nothing of a batch is answered, sent or shown before its COMMIT, and all of it
/// leaves in order. While a commit runs the next batch is handled; those that gather behind it
/// share one commit. A batch ends after some 20 ms, so that ticks and what vehicles say wait for no
/// flood of requests.
///
/// When a commit fails nothing of it leaves: its callers and those behind get store_unavailable and
/// the fleet is brought back to where it was at the last commit, from the newest snapshot and the
/// journal behind it. Until a commit succeeds again, tried every second, it is read-only: reads are
/// answered, nothing is accepted or sent. The same after an exception of the fleet.
///
/// A commit that hangs for a second does the same to new commands at once; reads are answered from
/// what was handled, stored or not. After five seconds those behind it are given up, its own
/// callers are told that the outcome is unknown, and whatever it started is stopped again once the
/// disk is back: nobody's act of a minute ago moves a vehicle.
///
/// Commands that make vehicles stand go first: their messages leave before they are stored, also
/// while nothing can be stored, and they are stored when that works again.
/// Thread safety: every function may be called from any thread; callbacks run through `deliver`.
class FleetRuntime {
public:
    using Job = std::function<void()>;
    using Published = server::Published;
    struct Ports {
        const plant::Plant& plant;
        fleet::Store& store;
        const Clock& clock;
        Metrics& metrics;
        std::function<void(Job)> deliver;        // runs jobs one after the other, in order given
        std::function<void(Published)> publish;  // a committed batch; called through `deliver`
        std::function<void()> rebuilt;  // the fleet missed what came in; called through `deliver`
    };

    FleetRuntime(Ports ports, std::uint64_t id_seed);
    ~FleetRuntime();
    FleetRuntime(const FleetRuntime&) = delete;
    FleetRuntime& operator=(const FleetRuntime&) = delete;

    /// Builds the fleet from `stored`, commits what that changes and starts both threads.
    Status start(fleet::StoredFleet stored);
    /// Handles and commits what was asked before, then ends both threads; waits for a disk that
    /// hangs.
    void stop();
    /// False while the store cannot be written: reads go on, commands are refused.
    bool writable() const;
    std::optional<fleet::StoreFault> store_fault() const;
    /// The sockets are being read. While nobody has said so for a second no vehicle is silent.
    void listening() { listened_ = std::chrono::steady_clock::now(); }
    QueueLengths queues() const;

    /// `done` gets what `f` returned, after the commit of its batch.
    template <class F>
    void command(F f,
                 std::function<void(Result<std::invoke_result_t<F, fleet::Fleet&, Time>>)> done) {
        using R = std::invoke_result_t<F, fleet::Fleet&, Time>;
        submit(commands_, task<R>(std::move(f), std::move(done)));
    }
    /// A command that makes vehicles stand. `f` may run again after `done`, on a fleet built anew:
    /// it owns all it needs.
    template <class F>
    void stop_command(
        F f, std::function<void(Result<std::invoke_result_t<F, fleet::Fleet&, Time>>)> done) {
        using R = std::invoke_result_t<F, fleet::Fleet&, Time>;
        submit(stops_, task<R>(std::move(f), std::move(done)));
    }
    /// As command, but changes nothing: sees the state after all commands of the same batch and is
    /// answered while the store cannot be written.
    template <class F>
    void read(F f, std::function<void(Result<std::invoke_result_t<F, fleet::Fleet&, Time>>)> done) {
        using R = std::invoke_result_t<F, fleet::Fleet&, Time>;
        submit(reads_, task<R>(std::move(f), std::move(done)));
    }
    /// What a vehicle reports; nobody waits for it. After one that the fleet threw at, the vehicle
    /// is not listened to for a while.
    void input(const plant::VehicleId& from, std::function<void(fleet::Fleet&, Time)> f);
    /// Any other write to the database: runs on the commit thread, blocks until it is done, some
    /// seconds at most. `job` owns all it needs: it may be done later than that. Throws
    /// StoreUnavailable. Not for the network thread.
    void write(Job job);

private:
    using Steady = std::chrono::steady_clock;
    using Answer = std::function<void(const Error*)>;  // null: committed
    /// Runs against the fleet at once and gives what to do after the commit.
    struct Task {
        std::function<void(fleet::Fleet&, Time)> run;
        Answer answer;  // empty: nobody waits
        Steady::time_point asked;
        plant::VehicleId from;  // whose report it is
        int tries = 0;
    };
    using Tasks = std::deque<Task>;
    struct Commit {
        std::uint64_t number = 0;  // grows
        Published batch;
        Tasks commands;                              // handled
        Tasks stops;                                 // handled, and their messages sent
        Tasks reads;                                 // handled; asked again when the batch is lost
        std::optional<fleet::SnapshotRow> snapshot;  // of the fleet behind the batch
        Job job;                                     // a write of others instead of a batch
        /// It releases floor, which what was asked then made possible.
        std::optional<Steady::time_point> releases_since;
        bool nothing() const;
    };
    using Commits = std::vector<Commit>;
    /// Why the fleet thread was woken.
    struct Turn {
        bool broken = false;  // the fleet holds what is lost
        bool hangs = false;   // the commit under way is given up
        bool stored = false;  // what a fleet built anew put out, or not
        bool retry = false;
        bool slow = false;  // nothing may be handled but what stops
        bool ending = false;
    };
    /// What a fleet built anew has put out, on its way to the store.
    struct Storing {
        Published batch;
        std::optional<fleet::SnapshotRow> snapshot;
        std::optional<WriteFailure> failure;
        bool done = false;  // guarded by the mutex
    };
    struct Quarantine {
        Time until{};
        int faults = 0;
        Tasks waiting;
    };

    template <class R, class F>
    static Task task(F f, std::function<void(Result<R>)> done) {
        auto result = std::make_shared<std::optional<Result<R>>>();
        Task made;
        made.run = [result, f = std::move(f)](fleet::Fleet& fleet, Time now) mutable {
            *result = f(fleet, now);
        };
        made.answer = [result, done = std::move(done)](const Error* error) {
            if (error) {
                done(fail(*error));
            } else {
                done(std::move(**result));
            }
        };
        return made;
    }

    // The fleet thread.
    void submit(Tasks& queue, Task task);
    std::optional<Task> next(Tasks& queue);
    void put_back(Tasks& queue, Tasks tasks);
    void fleet_loop();
    Turn wait();
    void turn(const Turn& turn);
    void handle(const Turn& turn);
    void run_batch(Commits& made, Time now, bool& broken);
    void keep_time(Commits& made, Time now);
    void run_stops(Commits& made, Time now, bool& broken, bool at_once);
    void run_commands(Commits& made, Time now, bool& broken);
    void run_reads(Commits& made, Time now);
    void redo(Commits made);
    void tick(Commit& commit, Time now);
    void take_snapshot(Commit& commit, Time now);
    bool run(Task& task, Time now);
    bool put_aside(Task& task, Time now);
    void end_quarantines(Time now);
    void refuse(Task& task, const Error& error);
    void refuse_all(Tasks& queue);
    void finish();
    Published take_published(Time at);
    void note_releases(Commit& commit, Steady::time_point since);
    Commit& begin(Commits& made);

    // When nothing can be stored, and afterwards.
    void rebuild();
    bool build_from_journal(Time now);
    bool build_from_tables(Time now);
    void begin_from_tables(fleet::StoredFleet stored, Time now);
    void stop_what_came_too_late(Time now);
    void do_what_is_owed(Time now);
    void begin_store();
    void end_store();
    void stop_while_read_only(Time now);
    void send_stops(Published& batch, std::uint64_t number);
    void give_up_on_commit();
    void answer_what_acts();
    void fleet_threw(const std::exception_ptr& error);
    void note_fault(const WriteFailure& failure);
    void show_fault();
    bool is_slow() const;  // REQUIRES: the mutex

    // The commit thread.
    void commit_loop();
    void write_all(Commits group);
    bool commit_group(Commits group, bool good);
    bool store(const Commits& group);
    bool end_write();  // false: what was written was given up meanwhile
    void put_snapshot(const fleet::SnapshotRow& snapshot);
    void try_snapshot(const fleet::SnapshotRow& snapshot);
    void deliver(Commit commit);
    void give_up(Commits lost, const Error& error);
    std::optional<WriteFailure> write_and_wait(Job job, std::chrono::milliseconds most);

    Ports ports_;
    std::uint64_t id_seed_;
    std::unique_ptr<fleet::Fleet> fleet_;               // fleet thread only
    std::shared_ptr<const fleet::PlantTables> tables_;  // of the plant, worked out once
    JournalKeeper journal_;
    Time last_tick_{};
    Time retry_at_{};
    Published unstored_;  // of a fleet built anew, until the store takes it
    std::optional<fleet::SnapshotRow> unstored_snapshot_;
    fleet::FleetView last_view_;
    std::uint64_t batches_ = 0;
    int faults_in_a_row_ = 0;  // of the fleet itself, without a minute of good ticks between
    Time last_fault_{};
    std::map<plant::VehicleId, Quarantine> quarantine_;

    mutable std::mutex mutex_;  // guards what follows
    std::condition_variable fleet_wake_;
    std::condition_variable commit_wake_;
    Tasks commands_;
    Tasks stops_;
    Tasks reads_;
    Commits commits_;
    Commits flight_;  // being written: the commit thread alone looks at their records
    std::optional<Steady::time_point> writes_since_;
    Steady::time_point looked_ = Steady::now();  // when the fleet thread saw that last
    bool given_up_ = false;                      // what is being written
    Tasks owed_;                                 // stops that act and are not stored
    Acts too_late_;  // stored after their callers were told that nobody knows
    std::shared_ptr<Storing> storing_;
    std::optional<fleet::StoreFault> fault_;
    std::map<plant::VehicleId, std::uint64_t> stopped_by_;  // number of the newest batch that did
    bool must_rebuild_ = false;
    bool stopping_ = false;
    bool commit_stopping_ = false;

    std::atomic<bool> degraded_{false};
    std::atomic<Steady::time_point> listened_{};
    std::atomic<Steady::time_point> ticked_{};
    std::thread fleet_thread_;
    std::thread commit_thread_;
};

}  // namespace pulseline::server
