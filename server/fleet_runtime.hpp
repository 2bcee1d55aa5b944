#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/fleet/fleet.hpp"
#include "server/journal_keeper.hpp"
#include "server/metrics.hpp"
#include "server/store_fault.hpp"

namespace pulseline::server {

/// The database did not take a write; nothing of it was kept.
struct StoreUnavailable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Owns the fleet. One thread handles what is asked of it in batches, one thread commits what the
/// batches put out; nothing of a batch is answered, sent or shown before its COMMIT, and all of it
/// leaves in order. While a commit runs the next batch is handled; those that gather behind it
/// share one commit. When a commit fails nothing of it leaves: its callers and those behind get
/// store_unavailable and the fleet is brought back to where it was at the last commit, from the
/// newest snapshot and the journal behind it. Until a commit succeeds again, tried every second, it
/// is read-only: reads are answered, nothing is accepted or sent.
/// Thread safety: every function may be called from any thread; callbacks run through `deliver`.
class FleetRuntime {
public:
    using Job = std::function<void()>;
    struct Published {
        fleet::Outputs outputs;
        std::optional<fleet::FleetView> fleet;  // when it changed
    };
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
    /// Handles and commits what was asked before, then ends both threads.
    void stop();
    /// False while the store cannot be written: reads go on, commands are refused.
    bool writable() const { return !degraded_; }
    std::optional<fleet::StoreFault> store_fault() const;

    /// `done` gets what `f` returned, after the commit of its batch.
    template <class F>
    void command(F f,
                 std::function<void(Result<std::invoke_result_t<F, fleet::Fleet&, Time>>)> done) {
        using R = std::invoke_result_t<F, fleet::Fleet&, Time>;
        submit(false, task<R>(std::move(f), std::move(done)));
    }
    /// As command, but changes nothing: sees the state after all commands of the same batch and is
    /// answered while the store cannot be written.
    template <class F>
    void read(F f, std::function<void(Result<std::invoke_result_t<F, fleet::Fleet&, Time>>)> done) {
        using R = std::invoke_result_t<F, fleet::Fleet&, Time>;
        submit(true, task<R>(std::move(f), std::move(done)));
    }
    /// What a vehicle reports; nobody waits for it.
    void input(std::function<void(fleet::Fleet&, Time)> f);
    /// Any other write to the database: runs on the commit thread, blocks until it is done. Throws
    /// StoreUnavailable. Not for the network thread.
    void write(Job job);

private:
    using Answer = std::function<void(const Error*)>;  // null: committed
    /// Runs against the fleet at once and gives what to do after the commit.
    struct Task {
        std::function<void(fleet::Fleet&, Time)> run;
        Answer answer;  // empty: nobody waits
        std::chrono::steady_clock::time_point asked;
    };
    struct Commit {
        Published batch;
        std::vector<Answer> answers;
        std::vector<Task> reads;                     // handled; asked again when the batch is lost
        std::optional<fleet::SnapshotRow> snapshot;  // of the fleet behind the batch
        Job job;                                     // a write of others instead of a batch
        /// It releases floor, which what was asked then made possible.
        std::optional<std::chrono::steady_clock::time_point> releases_since;
        bool nothing() const;
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

    void submit(bool reading, Task task);
    void fleet_loop();
    void handle(std::deque<Task>& commands, std::deque<Task>& reads);
    Commit tick(Time now);
    Commit run_commands(std::deque<Task>& commands, Time now, bool& broken);
    bool run(Task& task, Time now);
    Commit take_snapshot(Time now);
    void finish();
    void refuse(std::deque<Task>& tasks);
    void rebuild();
    bool build_from_journal(Time now);
    bool build_from_tables(Time now);
    void begin_from_tables(fleet::StoredFleet stored, Time now);
    void try_store();
    void note_fault(const std::exception_ptr& error);
    void show_fault();
    Published take_published(Time at);
    void note_releases(Commit& commit, std::chrono::steady_clock::time_point since);
    void commit_loop();
    bool commit_group(std::vector<Commit> group, bool good);
    bool store(const std::vector<Commit>& group);
    void put_snapshot(const fleet::SnapshotRow& snapshot);
    void try_snapshot(const fleet::SnapshotRow& snapshot);
    void deliver(Commit commit);
    void give_up(std::vector<Commit> lost);
    std::exception_ptr write_and_wait(Job job);

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

    mutable std::mutex mutex_;  // guards what follows
    std::condition_variable fleet_wake_;
    std::condition_variable commit_wake_;
    std::deque<Task> commands_;
    std::deque<Task> reads_;
    std::vector<Commit> commits_;
    std::optional<fleet::StoreFault> fault_;
    bool must_rebuild_ = false;
    bool stopping_ = false;
    bool commit_stopping_ = false;

    std::atomic<bool> degraded_{false};
    std::thread fleet_thread_;
    std::thread commit_thread_;
};

}  // namespace pulseline::server
