#include "server/runtime/fleet_runtime.hpp"

#include <algorithm>
#include <iterator>

#include "core/base/crash_point.hpp"
#include "core/fleet/journal/snapshot.hpp"
#include "server/base/log.hpp"
#include "server/base/refusals.hpp"
#include "server/base/runtime_limits.hpp"

// The fleet thread of FleetRuntime.
namespace pulseline::server {
namespace {

constexpr Duration kLookForStore = std::chrono::milliseconds(20);  // at what becomes of it
constexpr std::size_t kMaxQueued = 10'000;  // commands that wait; more are refused
constexpr Duration kLongestQuarantine = std::chrono::seconds(60);

}  // namespace

bool FleetRuntime::Commit::nothing() const {
    const auto& out = batch.outputs;
    return out.records.empty() && out.messages.empty() && out.vehicles.empty() &&
           out.stations.empty() && out.plans_wanted.empty() && !batch.fleet && commands.empty() &&
           stops.empty() && reads.empty() && !snapshot;
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

QueueLengths FleetRuntime::queues() const {
    QueueLengths lengths;
    const std::lock_guard lock(mutex_);
    lengths.commands = commands_.size() + stops_.size();
    lengths.reads = reads_.size();
    lengths.commits = commits_.size() + flight_.size();
    const auto ticked = ticked_.load();
    if (ticked != Steady::time_point{}) lengths.tick_age_s = seconds_since(ticked);
    return lengths;
}

void FleetRuntime::submit(Tasks& queue, Task task) {
    task.asked = Steady::now();
    std::optional<Error> refused;
    {
        const std::lock_guard lock(mutex_);
        if (stopping_) {
            refused = stopping();
        } else if (&queue == &commands_ && task.answer && is_slow()) {
            refused = store_unavailable(fleet::StoreFault{"disk_hangs", ports_.clock.now()});
        } else if (task.answer && queue.size() >= kMaxQueued) {
            refused = overloaded();
        } else {
            queue.push_back(std::move(task));
        }
    }
    if (refused) return refuse(task, *refused);
    fleet_wake_.notify_one();
}

void FleetRuntime::input(const plant::VehicleId& from, std::function<void(fleet::Fleet&, Time)> f) {
    submit(commands_, Task{std::move(f), nullptr, {}, from});
}

std::optional<FleetRuntime::Task> FleetRuntime::next(Tasks& queue) {
    const std::lock_guard lock(mutex_);
    if (queue.empty()) return std::nullopt;
    Task task = std::move(queue.front());
    queue.pop_front();
    return task;
}

void FleetRuntime::put_back(Tasks& queue, Tasks tasks) {
    const std::lock_guard lock(mutex_);
    for (auto task = tasks.rbegin(); task != tasks.rend(); ++task) {
        queue.push_front(std::move(*task));
    }
}

FleetRuntime::Turn FleetRuntime::wait() {
    std::unique_lock lock(mutex_);
    const auto listened = listened_.load();
    const bool deaf = Steady::now() - listened > kStoodStill;
    const bool looks = degraded_ || writes_since_ || deaf;
    const Duration until_tick =
        std::clamp(last_tick_ + kTick - ports_.clock.now(), Duration(0), kTick);
    fleet_wake_.wait_for(lock, looks ? kLookForStore : until_tick, [this] {
        // Commands wait while a fleet is built anew; with a fault of the store they are refused.
        const bool takes = !is_slow() && (!degraded_ || fault_);
        return stopping_ || must_rebuild_ || (storing_ && storing_->done) || !stops_.empty() ||
               !reads_.empty() || (takes && !commands_.empty());
    });
    const auto woken = Steady::now();
    const auto away = woken - std::exchange(looked_, woken);
    // A process that stood still says nothing of its disk.
    if (writes_since_ && away > kSlowAfter) writes_since_ = std::min(woken, *writes_since_ + away);
    Turn turn;
    turn.broken = std::exchange(must_rebuild_, false);
    turn.stored = !turn.broken && !given_up_ && storing_ && storing_->done;
    turn.hangs = writes_since_ && !given_up_ && Steady::now() - *writes_since_ > kGiveUpAfter;
    turn.retry =
        degraded_ && !turn.broken && !storing_ && !given_up_ && ports_.clock.now() >= retry_at_;
    turn.slow = is_slow();
    turn.ending = stopping_;
    return turn;
}

void FleetRuntime::fleet_loop() {
    for (;;) {
        const Turn now = wait();
        try {
            turn(now);
        } catch (...) {
            guarded("fleet", [error = std::current_exception(), this] { fleet_threw(error); });
        }
        if (!now.ending) continue;
        bool over = degraded_ || now.slow;
        {
            const std::lock_guard lock(mutex_);
            over = over || (commands_.empty() && stops_.empty() && reads_.empty());
        }
        if (over) return guarded("finish", [this] { finish(); });
    }
}

void FleetRuntime::turn(const Turn& turn) {
    if (turn.slow) answer_what_acts();
    if (turn.hangs) {
        give_up_on_commit();
    } else if (turn.broken) {
        rebuild();
    } else if (turn.stored) {
        end_store();
    } else if (turn.retry && !turn.ending) {
        if (fleet_) {
            begin_store();
        } else {
            rebuild();
        }
    }
    handle(turn);
}

/// The last thing that is committed: the state the server ends with.
void FleetRuntime::finish() {
    for (auto* queue : {&commands_, &stops_, &reads_}) {
        while (auto task = next(*queue)) refuse(*task, stopping());
    }
    if (degraded_ || !fleet_) return;
    const Time now = ports_.clock.now();
    Commit last;
    last.batch = take_published(now);
    take_snapshot(last, now);
    const std::lock_guard lock(mutex_);
    if (!must_rebuild_ && !is_slow()) commits_.push_back(std::move(last));
}

bool FleetRuntime::run(Task& task, Time now) {
    try {
        task.run(*fleet_, now);
        return true;
    } catch (...) {
        // Half a change may be in the fleet: nothing of this batch may be kept.
        log::error("fleet_task_threw",
                   {{"vehicle", task.from.str()}, {"what", what(std::current_exception())}});
        refuse(task, internal());
        if (task.from.empty()) return false;
        // It would say the same again at once, and have the fleet built anew for it each time.
        auto& kept_out = quarantine_[task.from];
        const int doubled = std::min(kept_out.faults++, 6);
        kept_out.until =
            now + std::min<Duration>(std::chrono::seconds(1 << doubled), kLongestQuarantine);
        return false;
    }
}

bool FleetRuntime::put_aside(Task& task, Time now) {
    if (task.from.empty() || quarantine_.empty()) return false;
    const auto found = quarantine_.find(task.from);
    if (found == quarantine_.end() || now >= found->second.until) return false;
    found->second.waiting.push_back(std::move(task));
    return true;
}

void FleetRuntime::end_quarantines(Time now) {
    for (auto& [vehicle, kept_out] : quarantine_) {
        if (now < kept_out.until || kept_out.waiting.empty()) continue;
        put_back(commands_, std::exchange(kept_out.waiting, {}));
    }
    std::erase_if(quarantine_, [&](const auto& entry) {
        return now - entry.second.until > kForgetFaults && entry.second.waiting.empty();
    });
}

void FleetRuntime::refuse(Task& task, const Error& error) {
    if (!task.answer) return;
    ports_.deliver([answer = std::move(task.answer), error] { answer(&error); });
}

void FleetRuntime::refuse_all(Tasks& queue) {
    Tasks tasks;
    {
        const std::lock_guard lock(mutex_);
        tasks.swap(queue);
    }
    const Error error = store_unavailable(store_fault());
    for (auto& task : tasks) refuse(task, error);
}

}  // namespace pulseline::server
