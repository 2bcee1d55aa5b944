#include <algorithm>

#include "core/base/crash_point.hpp"
#include "server/base/log.hpp"
#include "server/base/runtime_limits.hpp"
#include "server/runtime/fleet_runtime.hpp"

// What FleetRuntime does while nothing can be stored, and how the fleet comes back.
namespace pulseline::server {
namespace {

constexpr auto kLongestLoad = std::chrono::seconds(60);   // of all that is stored
constexpr auto kLongestPause = std::chrono::seconds(60);  // before a fleet that throws is tried

}  // namespace

bool FleetRuntime::is_slow() const {
    return given_up_ || commits_.size() >= kMostCommits ||
           (writes_since_ && Steady::now() - *writes_since_ > kSlowAfter);
}

bool FleetRuntime::writable() const {
    if (degraded_) return false;
    const std::lock_guard lock(mutex_);
    return !is_slow();
}

std::optional<fleet::StoreFault> FleetRuntime::store_fault() const {
    const std::lock_guard lock(mutex_);
    if (!fault_ && is_slow()) return fleet::StoreFault{"disk_hangs", ports_.clock.now()};
    return fault_;
}

/// What people ask is answered from what was handled, stored or not; what made vehicles stand has
/// acted.
void FleetRuntime::answer_what_acts() {
    std::vector<Answer> answers;
    Tasks reads;
    {
        const std::lock_guard lock(mutex_);
        for (auto* commits : {&flight_, &commits_}) {
            for (auto& commit : *commits) {
                for (auto& task : commit.stops) {
                    if (task.answer) answers.push_back(std::exchange(task.answer, nullptr));
                }
                for (auto& task : std::exchange(commit.reads, {})) reads.push_back(std::move(task));
            }
        }
    }
    for (auto& answer : answers) {
        ports_.deliver([answer = std::move(answer)] { answer(nullptr); });
    }
    put_back(reads_, std::move(reads));
}

/// Nobody knows whether what is being written is kept; what waits behind it is not.
void FleetRuntime::give_up_on_commit() {
    note_fault({"disk_hangs", "a commit has not ended for 5 s"});
    Tasks unknown;
    Commits flight;
    Commits behind;
    {
        const std::lock_guard lock(mutex_);
        if (!writes_since_) return;  // it has ended just now
        given_up_ = true;
        degraded_ = true;
        for (auto& commit : flight_) {
            Commit& taken = flight.emplace_back();
            taken.stops = std::exchange(commit.stops, {});
            taken.reads = std::exchange(commit.reads, {});
            for (auto& task : commit.commands) unknown.push_back(std::move(task));
            commit.commands.clear();
        }
        Commits kept;
        for (auto& commit : commits_) {
            (commit.job ? kept : behind).push_back(std::move(commit));
        }
        commits_ = std::move(kept);
    }
    const Error error = outcome_unknown(store_fault());
    for (auto& task : unknown) refuse(task, error);
    give_up(std::move(flight), error);
    give_up(std::move(behind), store_unavailable(store_fault()));
    // It holds what may not be stored and is built anew in any case; until then it answers reads.
    if (fleet_) fleet_->store_failed(*store_fault(), ports_.clock.now());
    show_fault();
}

void FleetRuntime::rebuild() {
    ++ports_.metrics.fleet_rebuilds;
    degraded_ = true;
    const Time now = ports_.clock.now();
    retry_at_ = now + kRetryStore;
    {
        const std::lock_guard lock(mutex_);
        storing_.reset();
    }
    // One that throws again at once may be what the journal makes of it: then as after a restart.
    const bool journal_helps = faults_in_a_row_ < 2;
    if (!(journal_helps && build_from_journal(now)) && !build_from_tables(now)) {
        fleet_.reset();
        show_fault();
        return;
    }
    stop_what_came_too_late(now);
    do_what_is_owed(now);
    if (faults_in_a_row_ > 2) {
        const auto pause = std::chrono::seconds(1LL << std::min(faults_in_a_row_ - 2, 6));
        retry_at_ = now + std::min<Duration>(pause, kLongestPause);
        show_fault();
        return;
    }
    begin_store();
}

/// The fleet as it was at the last commit. False: the store cannot be read, or its journal is of
/// no use.
bool FleetRuntime::build_from_journal(Time now) {
    const auto stored = std::make_shared<fleet::StoredJournal>();
    if (const auto failure = write_and_wait(
            [this, stored] { *stored = ports_.store.load_journal(); }, kLongestLoad)) {
        note_fault(*failure);
        return false;
    }
    try {
        auto rebuilt = journal_.rebuild(ports_.plant, tables_, *stored);
        if (!rebuilt) {
            log::error("journal_unusable", {{"what", rebuilt.error().what}});
            return false;
        }
        fleet_ = std::move(*rebuilt);
    } catch (...) {
        log::error("journal_unusable", {{"what", what(std::current_exception())}});
        return false;
    }
    log::warn("fleet_replayed", {{"rows", std::to_string(stored->rows.size())}});
    unstored_snapshot_.reset();
    if (const auto fault = store_fault()) fleet_->store_failed(*fault, now);
    unstored_ = take_published(now);
    return true;
}

/// As after a restart: orders are interrupted.
bool FleetRuntime::build_from_tables(Time now) {
    const auto stored = std::make_shared<fleet::StoredFleet>();
    if (const auto failure =
            write_and_wait([this, stored] { *stored = ports_.store.load(); }, kLongestLoad)) {
        note_fault(*failure);
        return false;
    }
    try {
        begin_from_tables(std::move(*stored), now);
    } catch (...) {
        note_fault({"internal", what(std::current_exception())});
        return false;
    }
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

/// Who was told that nobody knows may have walked in since: what they set going stands.
void FleetRuntime::stop_what_came_too_late(Time now) {
    Acts late;
    {
        const std::lock_guard lock(mutex_);
        late = too_late_;
    }
    if (late.empty()) return;
    fleet_->commands_expired(late.vehicles, late.orders, now);
    append(unstored_, take_published(now));
}

/// What made vehicles stand while nothing could be stored.
void FleetRuntime::do_what_is_owed(Time now) {
    Tasks owed;
    {
        const std::lock_guard lock(mutex_);
        owed.swap(owed_);
    }
    Tasks done;
    for (auto& task : owed) {
        if (!run(task, now)) {
            const std::lock_guard lock(mutex_);
            must_rebuild_ = true;  // and without this one
            continue;
        }
        Published batch = take_published(now);
        send_stops(batch, ++batches_);
        append(unstored_, std::move(batch));
        done.push_back(std::move(task));
    }
    put_back(owed_, std::move(done));
}

/// Their messages go at once; what they changed is stored with what waits for the store.
void FleetRuntime::stop_while_read_only(Time now) {
    if (!fleet_) return refuse_all(stops_);
    while (auto task = next(stops_)) {
        const Answer answer = task->answer;
        if (!run(*task, now)) {
            const std::lock_guard lock(mutex_);
            must_rebuild_ = true;
            return;
        }
        task->answer = nullptr;
        Published batch = take_published(now);
        send_stops(batch, ++batches_);
        Tasks one;
        one.push_back(std::move(*task));
        bool lost = false;
        {
            const std::lock_guard lock(mutex_);
            owed_.push_back(std::move(one.front()));
            lost = given_up_ || must_rebuild_;
        }
        Commit shown;
        shown.batch.outputs.vehicles = batch.outputs.vehicles;
        deliver(std::move(shown));
        if (!lost) append(unstored_, std::move(batch));
        ports_.deliver([answer] { answer(nullptr); });
    }
}

/// What was decided before may not set those vehicles in motion any more, however late it leaves.
void FleetRuntime::send_stops(Published& batch, std::uint64_t number) {
    Commit first;
    first.number = number;
    first.batch.outputs.messages = take_stops(batch.outputs.messages);
    if (first.batch.outputs.messages.empty()) return;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& message : first.batch.outputs.messages) {
            stopped_by_[message.vehicle] = number;
        }
    }
    deliver(std::move(first));
}

/// Stores what the fleet built anew has put out. REQUIRES: fleet_, which answers reads until then.
void FleetRuntime::begin_store() {
    retry_at_ = ports_.clock.now() + kRetryStore;
    auto storing = std::make_shared<Storing>();
    storing->batch = std::exchange(unstored_, {});
    storing->snapshot = std::exchange(unstored_snapshot_, std::nullopt);
    Commit commit;
    commit.job = [this, storing] {
        try {
            ports_.store.commit(storing->batch.outputs.records);
            if (storing->snapshot) put_snapshot(*storing->snapshot);
        } catch (...) {
            storing->failure = write_failure(std::current_exception());
        }
        {
            const std::lock_guard lock(mutex_);
            storing->done = true;
        }
        fleet_wake_.notify_one();
    };
    {
        const std::lock_guard lock(mutex_);
        storing_ = std::move(storing);
        commits_.push_back(std::move(commit));
    }
    commit_wake_.notify_one();
}

void FleetRuntime::end_store() {
    std::shared_ptr<Storing> ended;
    {
        const std::lock_guard lock(mutex_);
        ended.swap(storing_);
    }
    if (ended->failure) {
        // One that was good for reads only has to say now why it takes no commands.
        const bool first = !store_fault();
        note_fault(*ended->failure);
        Published later = std::exchange(unstored_, std::move(ended->batch));
        append(unstored_, std::move(later));
        unstored_snapshot_ = std::move(ended->snapshot);
        show_fault();
        if (first) rebuild();  // at once: reads are answered all the time
        return;
    }
    const Time now = ports_.clock.now();
    fleet_->store_works_again(now);
    last_tick_ = tick_time(now);
    Tasks owed;
    {
        const std::lock_guard lock(mutex_);
        fault_.reset();
        owed.swap(owed_);
        too_late_ = {};
        degraded_ = false;
    }
    ports_.metrics.read_only = 0;
    log::warn("fleet_rebuilt");
    Commit commit;
    commit.number = ++batches_;
    commit.batch = std::move(ended->batch);
    commit.batch.fleet = fleet_->view(now);
    deliver(std::move(commit));
    ports_.deliver(ports_.rebuilt);
    // What was stopped while that was being stored, and that the store works again.
    Commit rest;
    rest.number = ++batches_;
    rest.batch = std::exchange(unstored_, {});
    append(rest.batch, take_published(now));
    if (rest.nothing()) return;
    rest.stops = std::move(owed);
    {
        const std::lock_guard lock(mutex_);
        commits_.push_back(std::move(rest));
    }
    commit_wake_.notify_one();
}

/// Something in the fleet or behind it is broken: nothing of it is kept that is not stored.
void FleetRuntime::fleet_threw(const std::exception_ptr& error) {
    const Time now = ports_.clock.now();
    if (now - last_fault_ > kForgetFaults) faults_in_a_row_ = 0;
    ++faults_in_a_row_;
    last_fault_ = now;
    ++ports_.metrics.fleet_faults;
    log::error("fleet_threw", {{"what", what(error)}});
    if (faults_in_a_row_ > 2) note_fault({"internal", what(error)});
    const std::lock_guard lock(mutex_);
    must_rebuild_ = true;
    degraded_ = true;
}

void FleetRuntime::note_fault(const WriteFailure& failure) {
    {
        const std::lock_guard lock(mutex_);
        if (fault_) return;  // one alarm until the store works again
        fault_ = fleet::StoreFault{failure.cause, ports_.clock.now()};
    }
    ports_.metrics.read_only = 1;
    log::error("read_only", {{"cause", failure.cause}, {"what", failure.what}});
}

/// Tells the dashboards at once; the event of it follows when it can be stored.
void FleetRuntime::show_fault() {
    Commit commit;
    commit.batch.fleet = fleet_ ? fleet_->view(ports_.clock.now()) : last_view_;
    commit.batch.fleet->store_fault = store_fault();
    deliver(std::move(commit));
}

}  // namespace pulseline::server
