#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "server/cli/journal_verify.hpp"
#include "tests/db/fault_vfs.hpp"
#include "tests/db/temp_folder.hpp"
#include "tests/server/stored_fleet.hpp"

namespace pulseline::server::testing {
namespace {

using db::testing::FaultVfs;
using Kind = FaultVfs::Kind;

constexpr int kSteps = 200;
constexpr int kStepsOfALife = 10;
constexpr std::int64_t kReplayEvery = 8;
constexpr Time kStart = time_from_ns(1'800'000'000'000'000'000);

std::int64_t number(soci::session& sql, const std::string& query) {
    std::int64_t value = 0;
    sql << query, soci::into(value);
    return value;
}

/// What a clean file system finds in the file, held against what was answered.
void expect_kept(const std::string& path, const Ledger& ledger) {
    db::Database database(path);
    auto& sql = database.sql();
    std::string integrity;
    sql << "PRAGMA integrity_check", soci::into(integrity);
    EXPECT_EQ(integrity, "ok");
    EXPECT_EQ(number(sql, "SELECT COUNT(*) FROM events"),
              number(sql, "SELECT MAX(seq) FROM events"));
    EXPECT_GE(number(sql, "SELECT MAX(seq) FROM events"), ledger.last_event);
    EXPECT_EQ(ledger.gaps, 0);
    std::map<std::string, std::int64_t> revisions;
    for (const auto& order : db::FleetStore(database).load().orders) {
        revisions[order.id.str()] = order.revision;
    }
    std::size_t accepted = 0;
    for (const auto& [key, asked] : ledger.orders) {
        if (!asked.accepted) continue;
        ++accepted;
        const auto found = revisions.find(asked.order.str());
        ASSERT_NE(found, revisions.end()) << "false acknowledgement: " << key << " is not stored";
        EXPECT_GE(found->second, asked.revision) << "false acknowledgement of a change of " << key;
    }
    EXPECT_EQ(revisions.size(), accepted) << "an order that was refused is stored";
}

/// Its journal replays to what is stored: a fleet that was brought back after a failed commit was
/// the one it had been, else what followed would not fit.
cli::JournalReport expect_replays(const std::string& path) {
    db::ReadOnly database(path);
    auto report = cli::verify_journal(database, fleet::testing::small_plant());
    EXPECT_FALSE(report.difference)
        << "journal row " << report.difference->journal_seq << ": " << report.difference->what;
    return report;
}

/// The scenario's server starts anew every ten steps, so that a run need not begin at the first.
struct Begin {
    std::string file;
    Ledger ledger;
    Time now;
    StoredFleet::Vehicles vehicles;
};

struct Run {
    std::vector<FaultVfs::Call> calls;
    bool hit = false;
    Begin end;
};

/// One life of the server with one fault in it; ends some steps after it works again.
Run run(const Begin& begin, int first_step, const FaultVfs::Plan& plan) {
    const db::TempFolder folder;
    const std::string path = folder.file("p.db");
    if (!begin.file.empty()) std::filesystem::copy_file(begin.file, path);
    Ledger ledger = begin.ledger;
    Run run;
    FaultVfs::begin(plan);
    std::unique_ptr<StoredFleet> server;
    try {
        server = std::make_unique<StoredFleet>(path, ledger, begin.now, begin.vehicles);
    } catch (const db::Error&) {
        // It says so and does not start; the person tries again.
        EXPECT_GT(FaultVfs::faults(), 0);
        FaultVfs::heal();
        server = std::make_unique<StoredFleet>(path, ledger, begin.now, begin.vehicles);
    }
    for (int step = 0, left = kStepsOfALife; left > 0; ++step, --left) {
        server->step(first_step + step);
        if (!run.hit && FaultVfs::faults() > 0) {
            run.hit = true;
            FaultVfs::heal();
            EXPECT_TRUE(server->works_again());
            left = std::min(left, 4);
        }
    }
    run.end.now = server->now();
    run.end.vehicles = server->vehicles();
    server.reset();  // what fails while it closes is part of it
    run.calls = FaultVfs::calls();
    run.hit = run.hit || FaultVfs::faults() > 0;
    FaultVfs::heal();
    expect_kept(path, ledger);
    if (plan.at % kReplayEvery == 0) expect_replays(path);
    run.end.ledger = ledger;
    if (plan.at == 0) {
        run.end.file = ::testing::TempDir() + "pulseline-faults-" + std::to_string(::getpid()) +
                       "-" + std::to_string(first_step);
        std::filesystem::copy_file(path, run.end.file);
    }
    return run;
}

/// Every how many-th call fails, by PULSELINE_FAULT_EVERY; every one without it (nightly). Take a
/// number that neither 2 nor 3 divides: in steps of 2 or 3, plans_for would only ever get to some
/// of its kinds.
std::int64_t stride() {
    const char* every = std::getenv("PULSELINE_FAULT_EVERY");
    return every ? std::max(1, std::atoi(every)) : 1;
}

/// The kinds take turns from call to call; PULSELINE_FAULT_KINDS=all fails every call in each way.
std::vector<FaultVfs::Plan> plans_for(std::int64_t at, FaultVfs::Call call) {
    if (call != FaultVfs::Call::kWrite) return {{at, at % 2 == 0 ? 1 : 12, Kind::kIo}};
    if (std::getenv("PULSELINE_FAULT_KINDS")) {
        return {{at, 1, Kind::kIo}, {at, 12, Kind::kFull}, {at, 1, Kind::kShortWrite}};
    }
    const Kind kind = at % 3 == 0 ? Kind::kIo : at % 3 == 1 ? Kind::kFull : Kind::kShortWrite;
    return {{at, at % 2 == 0 ? 1 : 12, kind}};
}

TEST(StoreFaults, EveryCallOfTwoHundredStepsMayFailAndNothingIsFalselyAcknowledged) {
    FaultVfs::install();
    Begin begin;
    begin.now = kStart;
    std::size_t calls = 0;
    std::size_t runs = 0;
    std::size_t hits = 0;
    for (int first = 1; first <= kSteps; first += kStepsOfALife) {
        const auto clean = run(begin, first, {});
        ASSERT_FALSE(::testing::Test::HasFailure());
        calls += clean.calls.size();
        const auto last = static_cast<std::int64_t>(clean.calls.size());
        for (std::int64_t at = 1; at <= last; at += stride()) {
            for (const auto& plan : plans_for(at, clean.calls[static_cast<std::size_t>(at - 1)])) {
                SCOPED_TRACE("step " + std::to_string(first) + ", call " + std::to_string(at) +
                             ", " + std::to_string(plan.calls) + " calls, kind " +
                             std::to_string(static_cast<int>(plan.kind)));
                ++runs;
                if (run(begin, first, plan).hit) ++hits;
                ASSERT_FALSE(::testing::Test::HasFailure());
            }
        }
        if (!begin.file.empty()) std::filesystem::remove(begin.file);
        begin = clean.end;
    }
    std::filesystem::remove(begin.file);
    std::cout << calls << " calls, " << runs << " runs, " << hits << " with a fault\n";
    ASSERT_GT(calls, 1000u) << "the scenario commits in most steps";
    // Which commits share a batch is up to the threads, so a number may be another call's.
    EXPECT_GE(hits, runs * 9 / 10);
}

TEST(StoreFaults, AfterAFailedCommitOrdersGoOnFromWhereTheyWere) {
    FaultVfs::install();
    const db::TempFolder folder;
    const std::string path = folder.file("p.db");
    Ledger ledger;
    FaultVfs::begin({});
    auto server = std::make_unique<StoredFleet>(path, ledger, kStart);
    ASSERT_TRUE(server->works_again());  // an order is under way

    FaultVfs::begin({1, 1'000'000, Kind::kFull});
    for (int step = 1; step <= 10; ++step) server->step(step);
    EXPECT_GT(FaultVfs::faults(), 0);
    FaultVfs::heal();
    ASSERT_TRUE(server->works_again());
    server.reset();

    const auto report = expect_replays(path);
    EXPECT_GT(report.inputs, 10);
    EXPECT_GT(report.events, 5);
    db::ReadOnly database(path);
    const auto count = [&](const std::string& where) {
        return number(database.sql(), "SELECT COUNT(*) FROM events WHERE " + where);
    };
    EXPECT_EQ(count("type = 'store.failed'"), 1);
    EXPECT_EQ(count("type = 'store.recovered'"), 1);
    EXPECT_EQ(count("type = 'vehicle.needs_resume'"), 0);
    EXPECT_EQ(count("params LIKE '%server_restarted%'"), 0);
    EXPECT_EQ(count("params LIKE '%Interrupted%'"), 0);
}

TEST(StoreFaults, AChangedRowOfTheJournalIsFoundWithItsNumber) {
    FaultVfs::install();
    const db::TempFolder folder;
    const std::string path = folder.file("p.db");
    Ledger ledger;
    FaultVfs::begin({});
    {
        StoredFleet server(path, ledger, kStart);
        for (int step = 1; step <= 20; ++step) server.step(step);
    }
    std::int64_t seq = 0;
    {
        db::Database database(path);
        seq = number(database.sql(), "SELECT MAX(seq) - 2 FROM journal");
        database.sql() << "UPDATE journal SET bytes = CAST(bytes || x'00' AS BLOB) WHERE seq = " +
                              std::to_string(seq);
    }
    db::ReadOnly broken(path);
    const auto row = cli::verify_journal(broken, fleet::testing::small_plant()).difference;
    ASSERT_TRUE(row);
    EXPECT_EQ(row->journal_seq, seq);
    EXPECT_NE(row->what.find("checksum"), std::string::npos) << row->what;

    auto other = fleet::testing::small_plant();
    ++other.revision;
    const auto changed_plant = cli::verify_journal(broken, other);
    EXPECT_EQ(changed_plant.snapshots, 0);
    ASSERT_FALSE(changed_plant.passed_over.empty());
    EXPECT_NE(changed_plant.passed_over.front().find("the plant was changed"), std::string::npos);
}

TEST(StoreFaults, AnEventThatTheReplayDoesNotGiveIsFound) {
    FaultVfs::install();
    const db::TempFolder folder;
    const std::string path = folder.file("p.db");
    Ledger ledger;
    FaultVfs::begin({});
    {
        StoredFleet server(path, ledger, kStart);
        ASSERT_TRUE(server.works_again());
    }
    {
        db::Database database(path);
        database.sql() << "UPDATE events SET actor = 'somebody' WHERE type = 'job_order.created'";
    }
    db::ReadOnly changed(path);

    const auto found = cli::verify_journal(changed, fleet::testing::small_plant()).difference;

    ASSERT_TRUE(found);
    EXPECT_NE(found->what.find("job_order.created"), std::string::npos) << found->what;
}

}  // namespace
}  // namespace pulseline::server::testing
