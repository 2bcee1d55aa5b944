#include <chrono>
#include <future>

#include "core/base/crash_point.hpp"
#include "core/fleet/journal/snapshot.hpp"
#include "server/base/log.hpp"
#include "server/base/runtime_limits.hpp"
#include "server/runtime/fleet_runtime.hpp"

// The commit thread of FleetRuntime: what leaves the fleet's thread is stored here, and only then
// answered, sent and shown.
namespace pulseline::server {

void FleetRuntime::write(Job job) {
    {
        const std::lock_guard lock(mutex_);
        if (is_slow()) throw StoreUnavailable(StoreHangs().what());
    }
    const auto failure = write_and_wait(std::move(job), kGiveUpAfter);
    if (!failure) return;
    log::error("write_failed", {{"what", failure->what}});
    throw StoreUnavailable(failure->what);
}

std::optional<WriteFailure> FleetRuntime::write_and_wait(Job job, std::chrono::milliseconds most) {
    const auto done = std::make_shared<std::promise<std::optional<WriteFailure>>>();
    auto result = done->get_future();
    Commit commit;
    commit.job = [job = std::move(job), done] {
        try {
            job();
            done->set_value(std::nullopt);
        } catch (...) {
            done->set_value(write_failure(std::current_exception()));
        }
    };
    {
        const std::lock_guard lock(mutex_);
        if (commit_stopping_) return WriteFailure{"disk_error", "the server is stopping"};
        commits_.push_back(std::move(commit));
    }
    commit_wake_.notify_one();
    if (result.wait_for(most) != std::future_status::ready) {
        return write_failure(std::make_exception_ptr(StoreHangs()));
    }
    return result.get();
}

void FleetRuntime::commit_loop() {
    for (;;) {
        Commits group;
        {
            std::unique_lock lock(mutex_);
            commit_wake_.wait(lock, [this] { return commit_stopping_ || !commits_.empty(); });
            if (commits_.empty()) return;
            group.swap(commits_);
        }
        try {
            write_all(std::move(group));
        } catch (...) {
            log::error("commit_threw", {{"what", what(std::current_exception())}});
            end_write();
            {
                const std::lock_guard lock(mutex_);
                must_rebuild_ = true;
                degraded_ = true;
            }
            fleet_wake_.notify_one();
        }
    }
}

void FleetRuntime::write_all(Commits group) {
    // Batches up to the next write of somebody else share one commit. After one that failed the
    // rest stands on what is lost.
    Commits batches;
    bool good = true;
    for (auto& commit : group) {
        if (!commit.job) {
            batches.push_back(std::move(commit));
            continue;
        }
        good = commit_group(std::exchange(batches, {}), good);
        {
            const std::lock_guard lock(mutex_);
            writes_since_ = Steady::now();
        }
        guarded("write", commit.job);
        good = end_write() && good;
    }
    commit_group(std::move(batches), good);
}

/// False: it was given up, and with it all that the fleet has handled since.
bool FleetRuntime::end_write() {
    const std::lock_guard lock(mutex_);
    writes_since_.reset();
    if (!given_up_) return true;
    given_up_ = false;
    must_rebuild_ = true;
    fleet_wake_.notify_one();
    return false;
}

bool FleetRuntime::commit_group(Commits group, bool good) {
    if (group.empty()) return good;
    if (good) {
        {
            const std::lock_guard lock(mutex_);
            flight_ = std::move(group);
            writes_since_ = Steady::now();
        }
        good = store(flight_);
        const bool in_time = end_write();
        {
            const std::lock_guard lock(mutex_);
            group = std::exchange(flight_, {});
            if (good && !in_time) {
                for (const auto& commit : group) {
                    append_starts(too_late_, commit.batch.outputs.records.events);
                }
            }
        }
        if (good && !in_time) {
            // Its callers know nothing of it and nothing of it is sent, but it is stored: shown.
            for (auto& commit : group) {
                Commit shown;
                shown.batch.outputs.records = std::move(commit.batch.outputs.records);
                shown.reads = std::move(commit.reads);
                deliver(std::move(shown));
            }
            return false;
        }
    }
    if (good) {
        crash_point(CrashPoint::kBatchBeforeRelease);
        std::optional<fleet::SnapshotRow> snapshot;
        for (auto& commit : group) {
            if (commit.snapshot) snapshot = std::move(commit.snapshot);
            if (commit.releases_since) {
                ports_.metrics.release_stored(
                    std::chrono::duration<double>(Steady::now() - *commit.releases_since).count());
            }
            deliver(std::move(commit));
        }
        if (snapshot) try_snapshot(*snapshot);
        return true;
    }
    Commits behind;
    {
        const std::lock_guard lock(mutex_);
        must_rebuild_ = true;
        degraded_ = true;
        Commits kept;
        for (auto& commit : commits_) {
            (commit.job ? kept : behind).push_back(std::move(commit));
        }
        commits_ = std::move(kept);
    }
    // A disk that was full took nothing; one that failed may have.
    const auto fault = store_fault();
    const bool nothing =
        fault && (fault->cause == "disk_full" || fault->cause == "write_protected");
    give_up(std::move(group), nothing ? store_unavailable(fault) : outcome_unknown(fault));
    give_up(std::move(behind), store_unavailable(fault));
    fleet_wake_.notify_one();
    return false;
}

bool FleetRuntime::store(const Commits& group) {
    const auto start = Steady::now();
    try {
        fleet::Records merged;
        if (group.size() > 1) {
            for (const auto& commit : group) append(merged, commit.batch.outputs.records);
        }
        const auto& records = group.size() > 1 ? merged : group.front().batch.outputs.records;
        if (records.empty()) return true;
        ports_.store.commit(records);
    } catch (...) {
        note_fault(write_failure(std::current_exception()));
        ports_.metrics.commit_failed();
        return false;
    }
    ports_.metrics.commit(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
        group.size());
    return true;
}

void FleetRuntime::put_snapshot(const fleet::SnapshotRow& snapshot) {
    const auto start = std::chrono::steady_clock::now();
    fleet::SnapshotRow sealed = snapshot;
    sealed.bytes = fleet::journal::sealed(snapshot.bytes);
    ports_.store.put_snapshot(sealed);
    ports_.metrics.snapshot(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
        sealed.bytes.size());
}

/// Without it the journal behind the snapshot before goes on, and is only longer to replay.
void FleetRuntime::try_snapshot(const fleet::SnapshotRow& snapshot) {
    {
        const std::lock_guard lock(mutex_);
        writes_since_ = Steady::now();
    }
    try {
        put_snapshot(snapshot);
    } catch (const std::exception& e) {
        log::error("snapshot_failed", {{"what", e.what()}});
    }
    end_write();
}

void FleetRuntime::deliver(Commit commit) {
    auto shared = std::make_shared<Commit>(std::move(commit));
    ports_.deliver([this, shared] {
        crash_point(CrashPoint::kReleaseBeforeMessages);
        {
            const std::lock_guard lock(mutex_);
            std::erase_if(shared->batch.outputs.messages, [&](const auto& message) {
                const auto stopped = stopped_by_.find(message.vehicle);
                return stopped != stopped_by_.end() && shared->number < stopped->second &&
                       starts(message);
            });
        }
        guarded("publish", [&] { ports_.publish(std::move(shared->batch)); });
        crash_point(CrashPoint::kReleaseBeforeAnswers);
        for (const auto* tasks : {&shared->commands, &shared->stops, &shared->reads}) {
            for (const auto& task : *tasks) {
                if (!task.answer) continue;
                guarded("answer", [&] { task.answer(nullptr); });
                crash_point(CrashPoint::kReleaseBetweenAnswers);
            }
        }
        crash_point(CrashPoint::kReleaseDone);
    });
}

/// Of what is lost, what made vehicles stand has acted all the same: it is stored later.
void FleetRuntime::give_up(Commits lost, const Error& error) {
    for (auto& commit : lost) {
        for (auto& task : commit.commands) refuse(task, error);
        for (auto& task : commit.stops) {
            if (task.answer) ports_.deliver([answer = task.answer] { answer(nullptr); });
            task.answer = nullptr;
        }
        {
            const std::lock_guard lock(mutex_);
            for (auto& task : commit.stops) owed_.push_back(std::move(task));
        }
        // They read what is not stored: the fleet built from the store answers them.
        put_back(reads_, std::move(commit.reads));
    }
    fleet_wake_.notify_one();
}

}  // namespace pulseline::server
