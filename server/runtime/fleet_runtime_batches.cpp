#include <algorithm>
#include <iterator>

#include "core/base/crash_point.hpp"
#include "core/fleet/journal/snapshot.hpp"
#include "server/base/log.hpp"
#include "server/base/refusals.hpp"
#include "server/base/runtime_limits.hpp"
#include "server/runtime/fleet_runtime.hpp"

// What FleetRuntime does in one turn of the fleet thread.
namespace pulseline::server {
namespace {

constexpr auto kBudget = std::chrono::milliseconds(20);  // of commands in a batch, of reads again
constexpr int kTries = 2;  // of a task whose batch was lost to an exception

}  // namespace

FleetRuntime::Commit& FleetRuntime::begin(Commits& made) {
    Commit& commit = made.emplace_back();
    commit.number = ++batches_;
    return commit;
}

void FleetRuntime::handle(const Turn& turn) {
    // One time for all of a batch: the tick that is due comes first, and core time never goes back.
    const Time now = ports_.clock.now();
    const auto begun = Steady::now();
    Commits made;
    bool broken = false;
    const bool read_only = degraded_;
    try {
        if (read_only) {
            stop_while_read_only(now);
            if (store_fault()) refuse_all(commands_);
            if (!fleet_) refuse_all(reads_);
        } else if (turn.slow) {
            run_stops(made, now, broken, true);
        } else {
            run_batch(made, now, broken);
        }
        // Reads come last, so that they see exactly what their batch commits.
        if (fleet_ && !broken) run_reads(made, now);
    } catch (...) {
        redo(std::move(made));
        throw;
    }
    const bool idle =
        std::ranges::all_of(made, [](const Commit& commit) { return commit.nothing(); });
    if (!idle) ports_.metrics.fleet_batch(seconds_since(begun));
    if (broken) {
        const std::lock_guard lock(mutex_);
        must_rebuild_ = true;
        degraded_ = true;
    }
    if (broken) return redo(std::move(made));
    std::erase_if(made, [](const Commit& commit) { return commit.nothing(); });
    if (made.empty()) return;
    // What people ask now is answered from what was handled, stored or not.
    Commits seen;
    if (read_only || turn.slow) {
        for (auto& commit : made) seen.emplace_back().reads = std::exchange(commit.reads, {});
        std::erase_if(made, [](const Commit& commit) { return commit.nothing(); });
    }
    bool lost = false;
    {
        const std::lock_guard lock(mutex_);
        // What a fleet that is to be built anew has shown is as lost as what it has decided.
        lost = must_rebuild_ || (given_up_ && !read_only);
        if (!lost) std::ranges::move(made, std::back_inserter(commits_));
    }
    if (lost) {
        give_up(std::move(made), store_unavailable(store_fault()));
        give_up(std::move(seen), store_unavailable(store_fault()));
        return;
    }
    for (auto& commit : seen) deliver(std::move(commit));
    commit_wake_.notify_one();
}

void FleetRuntime::run_batch(Commits& made, Time now, bool& broken) {
    keep_time(made, now);
    end_quarantines(now);
    run_stops(made, now, broken, false);
    if (!broken) run_commands(made, now, broken);
    if (!broken && journal_.snapshot_is_due()) take_snapshot(begin(made), now);
}

/// The tick that is due. None while nobody reads the sockets: after such a time, or one in which
/// this thread stood still, what waits comes first and silence counts from now on.
void FleetRuntime::keep_time(Commits& made, Time now) {
    const auto listened = listened_.load();
    if (listened == Steady::time_point{}) {
        last_tick_ = tick_time(now);  // nobody was listened to yet
    } else if (Steady::now() - listened > kStoodStill) {
        return;
    } else if (now - last_tick_ > kStoodStill) {
        Commit& commit = begin(made);
        fleet_->server_stood_still(last_tick_, now);
        log::warn("stood_still", {{"for_s", std::to_string(seconds(now - last_tick_))}});
        last_tick_ = tick_time(now);
        ticked_ = Steady::now();
        commit.batch = take_published(now);
    } else if (tick_time(now) > last_tick_) {
        tick(begin(made), tick_time(now));
    }
}

void FleetRuntime::tick(Commit& commit, Time now) {
    const auto begin = Steady::now();
    last_tick_ = now;
    fleet_->tick(now);
    journal_.count_tick();
    commit.batch = take_published(now);
    ticked_ = Steady::now();
    if (faults_in_a_row_ > 0 && now - last_fault_ > kForgetFaults) faults_in_a_row_ = 0;
    note_releases(commit, begin);
}

/// Who asks a vehicle to stand waits for nothing that was asked before. `at_once`: nor for the
/// store, which takes it when it can.
void FleetRuntime::run_stops(Commits& made, Time now, bool& broken, bool at_once) {
    while (auto task = next(stops_)) {
        Commit& commit = begin(made);
        if (!run(*task, now)) {
            broken = true;
            return;
        }
        const Answer answer = task->answer;
        if (at_once) task->answer = nullptr;
        commit.stops.push_back(std::move(*task));
        commit.batch = take_published(now);
        send_stops(commit.batch, commit.number);
        if (at_once) ports_.deliver([answer] { answer(nullptr); });
    }
}

void FleetRuntime::run_commands(Commits& made, Time now, bool& broken) {
    Commit& commit = begin(made);
    const auto until = Steady::now() + kBudget;
    while (auto task = next(commands_)) {
        if (task->answer && Steady::now() - task->asked > kGiveUpAfter) {
            refuse(*task, expired());
            continue;
        }
        if (put_aside(*task, now)) continue;
        if (!run(*task, now)) {
            broken = true;
            return;
        }
        commit.commands.push_back(std::move(*task));
        if (Steady::now() >= until) break;
    }
    if (commit.commands.empty()) return;
    commit.batch = take_published(now);
    note_releases(commit, commit.commands.front().asked);
    crash_point(CrashPoint::kBatchHandled);
}

/// A read that throws changed nothing.
void FleetRuntime::run_reads(Commits& made, Time now) {
    Commit& commit = begin(made);
    const auto until = Steady::now() + kBudget;
    while (auto task = next(reads_)) {
        if (run(*task, now)) commit.reads.push_back(std::move(*task));
        if (Steady::now() >= until) break;
    }
}

/// Others' tasks of a batch lost to an exception are done by the fleet built anew; twice at most,
/// for what they all gave may be what it throws at.
void FleetRuntime::redo(Commits made) {
    for (auto commit = made.rbegin(); commit != made.rend(); ++commit) {
        for (auto [tasks, queue] :
             {std::pair(&commit->reads, &reads_), std::pair(&commit->commands, &commands_),
              std::pair(&commit->stops, &stops_)}) {
            for (auto& task : *tasks) {
                if (++task.tries >= kTries) refuse(task, internal());
            }
            std::erase_if(*tasks, [](const Task& task) { return task.tries >= kTries; });
            put_back(*queue, std::move(*tasks));
        }
    }
}

void FleetRuntime::take_snapshot(Commit& commit, Time now) {
    const auto start = Steady::now();
    journal_.add_rest(*fleet_, commit.batch.outputs.records, now);
    commit.snapshot = journal_.snapshot(*fleet_, ports_.plant);
    ports_.metrics.snapshot_taken(seconds_since(start));
}

Published FleetRuntime::take_published(Time at) {
    Published batch;
    batch.outputs = fleet_->take_outputs(at);
    journal_.add_row(*fleet_, batch.outputs, at);
    if (batch.outputs.fleet_changed) batch.fleet = last_view_ = fleet_->view(at);
    return batch;
}

void FleetRuntime::note_releases(Commit& commit, Steady::time_point since) {
    const auto& messages = commit.batch.outputs.messages;
    const bool releases = std::ranges::any_of(
        messages, [](const fleet::VehicleMessage& message) { return message.order.has_value(); });
    if (!releases) return;
    commit.releases_since = since;
    ports_.metrics.release_decided(seconds_since(since));
}

}  // namespace pulseline::server
