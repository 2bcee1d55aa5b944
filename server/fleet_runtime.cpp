#include "server/fleet_runtime.hpp"

#include <algorithm>
#include <iterator>

#include "core/base/crash_point.hpp"
#include "core/fleet/journal/snapshot.hpp"
#include "server/log.hpp"

namespace pulseline::server {
namespace {

constexpr Duration kTick = fleet::journal::kTickEvery;
constexpr Duration kRetryStore = std::chrono::seconds(1);
constexpr Duration kLookForStore = std::chrono::milliseconds(20);  // at the time for a retry
constexpr std::size_t kMaxQueued = 10'000;  // commands that wait; more are refused

Error overloaded() {
    return {Errc::kUnavailable,
            {"overloaded", {}},
            "Too many commands wait. Try again in a second.",
            {}};
}
Error internal() {
    return {Errc::kUnavailable,
            {"internal", {}},
            "The server met a fault of its own and changed nothing; its log has the request id.",
            {}};
}

/// The newest time of a tick not after `now`.
Time tick_time(Time now) { return now - now.time_since_epoch() % kTick; }

}  // namespace

bool FleetRuntime::Commit::nothing() const {
    const auto& out = batch.outputs;
    return out.records.empty() && out.messages.empty() && out.vehicles.empty() &&
           out.stations.empty() && !batch.fleet && answers.empty() && reads.empty() && !snapshot;
}

FleetRuntime::FleetRuntime(Ports ports, std::uint64_t id_seed)
    : ports_(std::move(ports)), id_seed_(id_seed) {}

FleetRuntime::~FleetRuntime() { stop(); }

Status FleetRuntime::start(fleet::StoredFleet stored) {
    const Time now = ports_.clock.now();
    last_tick_ = tick_time(now);
    begin_from_tables(std::move(stored), now);
    Published first = std::exchange(unstored_, {});
    try {
        crash_point(CrashPoint::kStartBeforeFirstCommit);
        ports_.store.commit(first.outputs.records);
        crash_point(CrashPoint::kStartAfterFirstCommit);
        put_snapshot(*std::exchange(unstored_snapshot_, std::nullopt));
    } catch (const std::exception& e) {
        return fail(Errc::kUnavailable, "store_unavailable",
                    std::string("the database cannot be written: ") + e.what() +
                        "; free disk space or check the file's permissions");
    }
    Commit commit;
    commit.batch = std::move(first);
    deliver(std::move(commit));
    commit_thread_ = std::thread([this] { commit_loop(); });
    fleet_thread_ = std::thread([this] { fleet_loop(); });
    return {};
}

void FleetRuntime::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    fleet_wake_.notify_all();
    if (fleet_thread_.joinable()) fleet_thread_.join();
    {
        const std::lock_guard lock(mutex_);
        commit_stopping_ = true;
    }
    commit_wake_.notify_all();
    if (commit_thread_.joinable()) commit_thread_.join();
}

void FleetRuntime::submit(bool reading, Task task) {
    task.asked = std::chrono::steady_clock::now();
    std::optional<Error> refused;
    {
        const std::lock_guard lock(mutex_);
        auto& queue = reading ? reads_ : commands_;
        if (stopping_) {
            refused = store_unavailable(std::nullopt);
        } else if (task.answer && queue.size() >= kMaxQueued) {
            refused = overloaded();
        } else {
            queue.push_back(std::move(task));
        }
    }
    if (refused && task.answer) {
        ports_.deliver([answer = std::move(task.answer), error = *refused] { answer(&error); });
    }
    fleet_wake_.notify_one();
}

void FleetRuntime::input(std::function<void(fleet::Fleet&, Time)> f) {
    submit(false, Task{std::move(f), nullptr, {}});
}

void FleetRuntime::write(Job job) {
    const auto error = write_and_wait(std::move(job));
    if (!error) return;
    log::error("write_failed", {{"what", what(error)}});
    throw StoreUnavailable(what(error));
}

void FleetRuntime::fleet_loop() {
    for (;;) {
        std::deque<Task> commands;
        std::deque<Task> reads;
        bool broken = false;
        bool ending = false;
        {
            std::unique_lock lock(mutex_);
            const Duration wait =
                degraded_ ? kLookForStore
                          : std::clamp(last_tick_ + kTick - ports_.clock.now(), Duration(0), kTick);
            fleet_wake_.wait_for(lock, wait, [this] {
                return stopping_ || must_rebuild_ || !commands_.empty() || !reads_.empty();
            });
            commands.swap(commands_);
            reads.swap(reads_);
            broken = std::exchange(must_rebuild_, false);
            ending = stopping_;
        }
        if (broken) {
            // These were asked while the fleet held what the store refused.
            refuse(commands);
            rebuild();
        } else if (degraded_ && !ending && ports_.clock.now() >= retry_at_) {
            if (fleet_) {
                try_store();
            } else {
                rebuild();
            }
        }
        handle(commands, reads);
        if (ending) return finish();
    }
}

FleetRuntime::Commit FleetRuntime::tick(Time now) {
    const auto begin = std::chrono::steady_clock::now();
    last_tick_ = now;
    fleet_->tick(now);
    journal_.count_tick();
    Commit commit;
    commit.batch = take_published(now);
    note_releases(commit, begin);
    return commit;
}

FleetRuntime::Commit FleetRuntime::run_commands(std::deque<Task>& commands, Time now,
                                                bool& broken) {
    Commit commit;
    if (commands.empty()) return commit;
    const auto first_asked = commands.front().asked;
    for (auto& task : commands) {
        if (!run(task, now)) {
            broken = true;
        } else if (task.answer) {
            commit.answers.push_back(std::move(task.answer));
        }
    }
    commands.clear();
    commit.batch = take_published(now);
    note_releases(commit, first_asked);
    crash_point(CrashPoint::kBatchHandled);
    return commit;
}

void FleetRuntime::handle(std::deque<Task>& commands, std::deque<Task>& reads) {
    // One time for all of a batch: the tick that is due comes first, and core time never goes back.
    const Time now = ports_.clock.now();
    std::vector<Commit> made;
    bool broken = false;
    const bool read_only = degraded_;
    if (read_only) {
        refuse(commands);
        if (!fleet_) refuse(reads);
    } else {
        if (tick_time(now) > last_tick_) made.push_back(tick(tick_time(now)));
        made.push_back(run_commands(commands, now, broken));
        if (!broken && journal_.snapshot_is_due()) made.push_back(take_snapshot(now));
    }
    // Reads come last, so that they see exactly what their batch commits; one that throws changed
    // nothing.
    Commit seen;
    for (auto& task : reads) {
        if (run(task, now)) seen.reads.push_back(std::move(task));
    }
    reads.clear();
    made.push_back(std::move(seen));
    if (!broken) std::erase_if(made, [](const Commit& commit) { return commit.nothing(); });
    if (made.empty()) return;
    bool lost = false;
    {
        const std::lock_guard lock(mutex_);
        if (broken) must_rebuild_ = true;
        // What a fleet that is to be built anew has shown is as lost as what it has decided.
        lost = must_rebuild_;
        if (!lost && !read_only) std::ranges::move(made, std::back_inserter(commits_));
    }
    if (lost) {
        give_up(std::move(made));
    } else if (read_only) {
        for (auto& commit : made) deliver(std::move(commit));
    } else {
        commit_wake_.notify_one();
    }
}

FleetRuntime::Commit FleetRuntime::take_snapshot(Time now) {
    const auto start = std::chrono::steady_clock::now();
    Commit commit;
    journal_.add_rest(*fleet_, commit.batch.outputs.records, now);
    commit.snapshot = journal_.snapshot(*fleet_, ports_.plant);
    ports_.metrics.snapshot_taken(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return commit;
}

/// The last thing that is committed: the state the server ends with.
void FleetRuntime::finish() {
    if (degraded_ || !fleet_) return;
    Commit last = take_snapshot(ports_.clock.now());
    const std::lock_guard lock(mutex_);
    if (!must_rebuild_) commits_.push_back(std::move(last));
}

bool FleetRuntime::run(Task& task, Time now) {
    try {
        task.run(*fleet_, now);
        return true;
    } catch (const std::exception& e) {
        // Half a change may be in the fleet: nothing of this batch may be kept.
        log::error("fleet_task_threw", {{"what", e.what()}});
        if (task.answer) {
            ports_.deliver([answer = std::move(task.answer)] {
                const Error error = internal();
                answer(&error);
            });
        }
        return false;
    }
}

void FleetRuntime::refuse(std::deque<Task>& tasks) {
    for (auto& task : tasks) {
        if (!task.answer) continue;
        ports_.deliver([answer = std::move(task.answer), error = store_unavailable(store_fault())] {
            answer(&error);
        });
    }
    tasks.clear();
}

FleetRuntime::Published FleetRuntime::take_published(Time at) {
    Published batch;
    batch.outputs = fleet_->take_outputs(at);
    journal_.add_row(*fleet_, batch.outputs, at);
    if (batch.outputs.fleet_changed) batch.fleet = last_view_ = fleet_->view(at);
    return batch;
}

void FleetRuntime::note_releases(Commit& commit, std::chrono::steady_clock::time_point since) {
    const auto& messages = commit.batch.outputs.messages;
    const bool releases = std::ranges::any_of(
        messages, [](const fleet::VehicleMessage& message) { return message.order.has_value(); });
    if (!releases) return;
    commit.releases_since = since;
    ports_.metrics.release_decided(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count());
}

void FleetRuntime::rebuild() {
    ++ports_.metrics.fleet_rebuilds;
    degraded_ = true;
    const Time now = ports_.clock.now();
    retry_at_ = now + kRetryStore;
    if (!build_from_journal(now) && !build_from_tables(now)) {
        fleet_.reset();
        show_fault();
        return;
    }
    try_store();
    if (degraded_) show_fault();
}

/// The fleet as it was at the last commit. False: the store cannot be read, or its journal is of
/// no use.
bool FleetRuntime::build_from_journal(Time now) {
    fleet::StoredJournal stored;
    if (const auto error = write_and_wait([&] { stored = ports_.store.load_journal(); })) {
        note_fault(error);
        return false;
    }
    try {
        auto rebuilt = journal_.rebuild(ports_.plant, tables_, stored);
        if (!rebuilt) {
            log::error("journal_unusable", {{"what", rebuilt.error().what}});
            return false;
        }
        fleet_ = std::move(*rebuilt);
    } catch (const std::exception& e) {
        log::error("journal_unusable", {{"what", e.what()}});
        return false;
    }
    log::warn("fleet_replayed", {{"rows", std::to_string(stored.rows.size())}});
    unstored_snapshot_.reset();
    if (const auto fault = store_fault()) fleet_->store_failed(*fault, now);
    unstored_ = take_published(now);
    return true;
}

/// As after a restart: orders are interrupted.
bool FleetRuntime::build_from_tables(Time now) {
    std::optional<fleet::StoredFleet> stored;
    if (const auto error = write_and_wait([&] { stored = ports_.store.load(); })) {
        note_fault(error);
        return false;
    }
    begin_from_tables(std::move(*stored), now);
    return true;
}

/// REQUIRES: the commit thread has nothing to do. What it puts out is in unstored_.
void FleetRuntime::begin_from_tables(fleet::StoredFleet stored, Time now) {
    const std::int64_t last_seq = stored.last_journal_seq;
    fleet_ =
        std::make_unique<fleet::Fleet>(ports_.plant, std::move(stored), id_seed_++, now, tables_);
    tables_ = fleet_->tables();
    if (const auto fault = store_fault()) fleet_->store_failed(*fault, now);
    unstored_ = {};
    unstored_.outputs = fleet_->take_outputs(now);
    if (unstored_.outputs.fleet_changed) unstored_.fleet = last_view_ = fleet_->view(now);
    unstored_snapshot_ =
        journal_.begin(*fleet_, ports_.plant, last_seq, unstored_.outputs.records, now);
}

/// Stores what the fleet built anew has put out. REQUIRES: fleet_, which answers reads until then.
void FleetRuntime::try_store() {
    retry_at_ = ports_.clock.now() + kRetryStore;
    const auto write = [&] {
        ports_.store.commit(unstored_.outputs.records);
        if (unstored_snapshot_) put_snapshot(*unstored_snapshot_);
    };
    if (const auto error = write_and_wait(write)) {
        // One that was good for reads only has to say now why it takes no commands.
        const bool first = !store_fault();
        note_fault(error);
        if (first) {
            fleet_.reset();
            retry_at_ = {};
        }
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        fault_.reset();
    }
    const Time now = ports_.clock.now();
    fleet_->store_works_again(now);
    last_tick_ = tick_time(now);
    ports_.metrics.read_only = 0;
    degraded_ = false;
    log::warn("fleet_rebuilt");
    Commit commit;
    unstored_snapshot_.reset();
    commit.batch = std::exchange(unstored_, {});
    commit.batch.fleet = fleet_->view(now);
    deliver(std::move(commit));
    ports_.deliver(ports_.rebuilt);
}

std::optional<fleet::StoreFault> FleetRuntime::store_fault() const {
    const std::lock_guard lock(mutex_);
    return fault_;
}

void FleetRuntime::note_fault(const std::exception_ptr& error) {
    {
        const std::lock_guard lock(mutex_);
        if (fault_) return;  // one alarm until the store works again
        fault_ = fleet::StoreFault{cause_of(error), ports_.clock.now()};
    }
    ports_.metrics.read_only = 1;
    log::error("read_only", {{"cause", cause_of(error)}, {"what", what(error)}});
}

/// Tells the dashboards at once; the event of it follows when it can be stored.
void FleetRuntime::show_fault() {
    Commit commit;
    commit.batch.fleet = fleet_ ? fleet_->view(ports_.clock.now()) : last_view_;
    commit.batch.fleet->store_fault = store_fault();
    deliver(std::move(commit));
}

}  // namespace pulseline::server
