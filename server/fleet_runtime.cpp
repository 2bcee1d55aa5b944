#include "server/fleet_runtime.hpp"

#include <future>

#include "core/base/crash_point.hpp"
#include "server/log.hpp"

namespace pulseline::server {
namespace {

constexpr auto kTick = std::chrono::milliseconds(50);
constexpr auto kRetryStore = std::chrono::seconds(1);
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

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}
void append(fleet::Records& to, const fleet::Records& from) {
    append(to.orders, from.orders);
    append(to.vehicles, from.vehicles);
    append(to.stops, from.stops);
    append(to.events, from.events);
    append(to.idempotency, from.idempotency);
    append(to.schedules, from.schedules);
    append(to.templates, from.templates);
}

}  // namespace

FleetRuntime::FleetRuntime(Ports ports, std::uint64_t id_seed)
    : ports_(std::move(ports)), id_seed_(id_seed) {}

FleetRuntime::~FleetRuntime() { stop(); }

Status FleetRuntime::start(fleet::StoredFleet stored) {
    fleet_ = std::make_unique<fleet::Fleet>(ports_.plant, std::move(stored), id_seed_++,
                                            ports_.clock.now());
    Published first = take_published();
    try {
        crash_point(CrashPoint::kStartBeforeFirstCommit);
        if (!first.outputs.records.empty()) ports_.store.commit(first.outputs.records);
        crash_point(CrashPoint::kStartAfterFirstCommit);
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
    submit(false, Task{std::move(f), nullptr});
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
            fleet_wake_.wait_for(lock, kTick, [this] {
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
        if (ending) return;
    }
}

void FleetRuntime::handle(std::deque<Task>& commands, std::deque<Task>& reads) {
    Commit commit;
    bool broken = false;
    const bool read_only = degraded_;
    if (read_only) {
        refuse(commands);
        if (!fleet_) refuse(reads);
    } else {
        for (auto& task : commands) {
            if (!run(task)) {
                broken = true;
            } else if (task.answer) {
                commit.answers.push_back(std::move(task.answer));
            }
        }
        commands.clear();
        const Time now = ports_.clock.now();
        if (now - last_tick_ >= kTick) {
            last_tick_ = now;
            fleet_->tick(now);
        }
        commit.batch = take_published();
        crash_point(CrashPoint::kBatchHandled);
    }
    // Reads come last, so that they see exactly what their batch commits; one that throws changed
    // nothing.
    for (auto& task : reads) {
        if (run(task)) commit.reads.push_back(std::move(task));
    }
    reads.clear();
    const auto& out = commit.batch.outputs;
    const bool nothing = out.records.empty() && out.messages.empty() && out.vehicles.empty() &&
                         out.stations.empty() && !commit.batch.fleet && commit.answers.empty() &&
                         commit.reads.empty();
    if (nothing && !broken) return;
    bool lost = false;
    {
        const std::lock_guard lock(mutex_);
        if (broken) must_rebuild_ = true;
        // What a fleet that is to be built anew has shown is as lost as what it has decided.
        lost = must_rebuild_;
        if (!lost && !read_only) commits_.push_back(std::move(commit));
    }
    if (lost) {
        std::vector<Commit> one;
        one.push_back(std::move(commit));
        give_up(std::move(one));
    } else if (read_only) {
        deliver(std::move(commit));
    } else {
        commit_wake_.notify_one();
    }
}

bool FleetRuntime::run(Task& task) {
    try {
        task.run(*fleet_, ports_.clock.now());
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

FleetRuntime::Published FleetRuntime::take_published() {
    Published batch;
    const Time now = ports_.clock.now();
    batch.outputs = fleet_->take_outputs(now);
    if (batch.outputs.fleet_changed) batch.fleet = last_view_ = fleet_->view(now);
    return batch;
}

void FleetRuntime::rebuild() {
    ++ports_.metrics.fleet_rebuilds;
    degraded_ = true;
    retry_at_ = ports_.clock.now() + kRetryStore;
    std::optional<fleet::StoredFleet> stored;
    if (const auto error = write_and_wait([&] { stored = ports_.store.load(); })) {
        note_fault(error);
        fleet_.reset();
        show_fault();
        return;
    }
    build_fleet(std::move(*stored));
    try_store();
    if (degraded_) show_fault();
}

void FleetRuntime::build_fleet(fleet::StoredFleet stored) {
    const Time now = ports_.clock.now();
    auto tables = fleet_->tables();
    fleet_ = std::make_unique<fleet::Fleet>(ports_.plant, std::move(stored), id_seed_++, now,
                                            std::move(tables));
    if (const auto fault = store_fault()) fleet_->store_failed(*fault, now);
    unstored_ = take_published();
}

/// Stores what the fleet built anew has put out. REQUIRES: fleet_, which answers reads until then.
void FleetRuntime::try_store() {
    retry_at_ = ports_.clock.now() + kRetryStore;
    const auto write = [&] { ports_.store.commit(unstored_.outputs.records); };
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
    fleet_->store_works_again(ports_.clock.now());
    ports_.metrics.read_only = 0;
    degraded_ = false;
    log::warn("fleet_rebuilt");
    Commit commit;
    commit.batch = std::exchange(unstored_, {});
    commit.batch.fleet = fleet_->view(ports_.clock.now());
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

std::exception_ptr FleetRuntime::write_and_wait(Job job) {
    std::promise<std::exception_ptr> done;
    auto result = done.get_future();
    Commit commit;
    commit.job = [&] {
        try {
            job();
            done.set_value(nullptr);
        } catch (...) {
            done.set_value(std::current_exception());
        }
    };
    {
        const std::lock_guard lock(mutex_);
        if (commit_stopping_) {
            return std::make_exception_ptr(std::runtime_error("the server is stopping"));
        }
        commits_.push_back(std::move(commit));
    }
    commit_wake_.notify_one();
    return result.get();
}

void FleetRuntime::commit_loop() {
    for (;;) {
        std::vector<Commit> group;
        {
            std::unique_lock lock(mutex_);
            commit_wake_.wait(lock, [this] { return commit_stopping_ || !commits_.empty(); });
            if (commits_.empty()) return;
            group.swap(commits_);
        }
        // Batches up to the next write of somebody else share one commit. After one that failed the
        // rest stands on what is lost.
        std::vector<Commit> batches;
        bool good = true;
        for (auto& commit : group) {
            if (!commit.job) {
                batches.push_back(std::move(commit));
                continue;
            }
            good = commit_group(std::exchange(batches, {}), good);
            commit.job();
        }
        commit_group(std::move(batches), good);
    }
}

bool FleetRuntime::commit_group(std::vector<Commit> group, bool good) {
    if (group.empty()) return good;
    if (good && store(group)) {
        crash_point(CrashPoint::kBatchBeforeRelease);
        for (auto& commit : group) deliver(std::move(commit));
        return true;
    }
    {
        const std::lock_guard lock(mutex_);
        must_rebuild_ = true;
        degraded_ = true;
        std::vector<Commit> kept;
        for (auto& commit : commits_) {
            (commit.job ? kept : group).push_back(std::move(commit));
        }
        commits_ = std::move(kept);
    }
    give_up(std::move(group));
    fleet_wake_.notify_one();
    return false;
}

bool FleetRuntime::store(const std::vector<Commit>& group) {
    fleet::Records merged;
    if (group.size() > 1) {
        for (const auto& commit : group) append(merged, commit.batch.outputs.records);
    }
    const auto& records = group.size() > 1 ? merged : group.front().batch.outputs.records;
    if (records.empty()) return true;
    const auto start = std::chrono::steady_clock::now();
    try {
        ports_.store.commit(records);
    } catch (...) {
        note_fault(std::current_exception());
        ports_.metrics.commit_failed();
        return false;
    }
    ports_.metrics.commit(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
        group.size());
    return true;
}

void FleetRuntime::deliver(Commit commit) {
    auto shared = std::make_shared<Commit>(std::move(commit));
    ports_.deliver([this, shared] {
        crash_point(CrashPoint::kReleaseBeforeMessages);
        ports_.publish(std::move(shared->batch));
        crash_point(CrashPoint::kReleaseBeforeAnswers);
        for (const auto& answer : shared->answers) {
            answer(nullptr);
            crash_point(CrashPoint::kReleaseBetweenAnswers);
        }
        for (const auto& read : shared->reads) {
            if (read.answer) read.answer(nullptr);
        }
        crash_point(CrashPoint::kReleaseDone);
    });
}

void FleetRuntime::give_up(std::vector<Commit> lost) {
    std::vector<Answer> refused;
    for (auto& commit : lost) {
        for (auto& answer : commit.answers) refused.push_back(std::move(answer));
        // They read what is not stored: the fleet built from the store answers them.
        for (auto& read : commit.reads) submit(true, std::move(read));
    }
    ports_.deliver([refused = std::move(refused), error = store_unavailable(store_fault())] {
        for (const auto& answer : refused) answer(&error);
    });
}

}  // namespace pulseline::server
