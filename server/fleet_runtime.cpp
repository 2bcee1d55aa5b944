#include "server/fleet_runtime.hpp"

#include <future>

#include "server/log.hpp"

namespace pulseline::server {
namespace {

constexpr auto kTick = std::chrono::milliseconds(50);
constexpr auto kRetryStore = std::chrono::seconds(1);
constexpr std::size_t kMaxQueued = 10'000;  // commands that wait; more are refused

Error store_unavailable() {
    return {Errc::kUnavailable,
            {"store_unavailable", {}},
            "The database cannot be written now, so nothing was changed. Free disk space if it is "
            "full, then try again.",
            {}};
}
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

std::string what(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const std::exception& e) {
        return e.what();
    } catch (...) {
        return "unknown exception";
    }
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
        if (!first.outputs.records.empty()) ports_.store.commit(first.outputs.records);
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
            refused = store_unavailable();
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
            rebuild();
        }
        handle(commands, reads);
        if (ending) return;
    }
}

void FleetRuntime::handle(std::deque<Task>& commands, std::deque<Task>& reads) {
    Commit commit;
    bool broken = false;
    if (degraded_) {
        refuse(commands);
        if (!fleet_) refuse(reads);
        run_all(reads, commit.answers, broken);
        if (!commit.answers.empty()) {
            ports_.deliver([answers = std::move(commit.answers)] {
                for (const auto& answer : answers) answer(nullptr);
            });
        }
        return;
    }
    run_all(commands, commit.answers, broken);
    const Time now = ports_.clock.now();
    if (now - last_tick_ >= kTick) {
        last_tick_ = now;
        fleet_->tick(now);
    }
    commit.batch = take_published();
    // Reads come last, so that they see exactly what their batch commits; one that throws changed
    // nothing.
    bool ignored = false;
    run_all(reads, commit.answers, ignored);
    bool lost = false;
    {
        const std::lock_guard lock(mutex_);
        if (broken) must_rebuild_ = true;
        lost = must_rebuild_;
        const auto& out = commit.batch.outputs;
        const bool nothing = out.records.empty() && out.messages.empty() && out.vehicles.empty() &&
                             out.stations.empty() && !commit.batch.fleet && commit.answers.empty();
        if (!lost && !nothing) commits_.push_back(std::move(commit));
    }
    if (lost) {
        std::vector<Commit> one;
        one.push_back(std::move(commit));
        give_up(std::move(one));
    } else {
        commit_wake_.notify_one();
    }
}

void FleetRuntime::run_all(std::deque<Task>& tasks, std::vector<Answer>& answers, bool& broken) {
    for (auto& task : tasks) {
        try {
            task.run(*fleet_, ports_.clock.now());
            if (task.answer) answers.push_back(std::move(task.answer));
        } catch (const std::exception& e) {
            // Half a change may be in the fleet: nothing of this batch may be kept.
            log::error("fleet_task_threw", {{"what", e.what()}});
            broken = true;
            if (task.answer) {
                ports_.deliver([answer = std::move(task.answer)] {
                    const Error error = internal();
                    answer(&error);
                });
            }
        }
    }
    tasks.clear();
}

void FleetRuntime::refuse(std::deque<Task>& tasks) {
    for (auto& task : tasks) {
        if (!task.answer) continue;
        ports_.deliver([answer = std::move(task.answer)] {
            const Error error = store_unavailable();
            answer(&error);
        });
    }
    tasks.clear();
}

FleetRuntime::Published FleetRuntime::take_published() {
    Published batch;
    const Time now = ports_.clock.now();
    batch.outputs = fleet_->take_outputs(now);
    if (batch.outputs.fleet_changed) batch.fleet = fleet_->view(now);
    return batch;
}

void FleetRuntime::rebuild() {
    ++ports_.metrics.fleet_rebuilds;
    degraded_ = true;
    retry_at_ = ports_.clock.now() + kRetryStore;
    std::optional<fleet::StoredFleet> stored;
    if (const auto error = write_and_wait([&] { stored = ports_.store.load(); })) {
        log::error("store_unreadable", {{"what", what(error)}});
        fleet_.reset();
        return;
    }
    fleet_ = std::make_unique<fleet::Fleet>(ports_.plant, std::move(*stored), id_seed_++,
                                            ports_.clock.now());
    Published first = take_published();
    if (const auto error = write_and_wait([&] { ports_.store.commit(first.outputs.records); })) {
        log::error("store_unwritable", {{"what", what(error)}});
        return;  // readable: this fleet answers reads until the next try
    }
    degraded_ = false;
    log::warn("fleet_rebuilt");
    Commit commit;
    commit.batch = std::move(first);
    deliver(std::move(commit));
    ports_.deliver(ports_.rebuilt);
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
        log::error("commit_failed", {{"what", what(std::current_exception())}});
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
        ports_.publish(std::move(shared->batch));
        for (const auto& answer : shared->answers) answer(nullptr);
    });
}

void FleetRuntime::give_up(std::vector<Commit> lost) {
    auto shared = std::make_shared<std::vector<Commit>>(std::move(lost));
    ports_.deliver([shared] {
        const Error error = store_unavailable();
        for (const auto& commit : *shared) {
            for (const auto& answer : commit.answers) answer(&error);
        }
    });
}

}  // namespace pulseline::server
