#include <chrono>
#include <future>

#include "core/base/crash_point.hpp"
#include "core/fleet/journal/snapshot.hpp"
#include "server/fleet_runtime.hpp"
#include "server/log.hpp"

// The commit thread of FleetRuntime: what leaves the fleet's thread is stored here, and only then
// answered, sent and shown.
namespace pulseline::server {
namespace {

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
    append(to.closures, from.closures);
    append(to.reopened, from.reopened);
    append(to.journal, from.journal);
    append(to.schedules, from.schedules);
    append(to.templates, from.templates);
}

}  // namespace

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
        std::optional<fleet::SnapshotRow> snapshot;
        for (auto& commit : group) {
            if (commit.snapshot) snapshot = std::move(commit.snapshot);
            if (commit.releases_since) {
                ports_.metrics.release_stored(
                    std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                                  *commit.releases_since)
                        .count());
            }
            deliver(std::move(commit));
        }
        if (snapshot) try_snapshot(*snapshot);
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
    try {
        put_snapshot(snapshot);
    } catch (const std::exception& e) {
        log::error("snapshot_failed", {{"what", e.what()}});
    }
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
