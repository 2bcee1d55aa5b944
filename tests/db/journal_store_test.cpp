#include "db/journal/journal_store.hpp"

#include <gtest/gtest.h>

#include "db/fleet/fleet_store.hpp"
#include "db/journal/journal_rows.hpp"

namespace pulseline::db {
namespace {

constexpr std::int64_t kHour_ns = 3'600'000'000'000;

fleet::JournalRow row(std::int64_t seq) {
    return {seq, time_from_ns(seq * kHour_ns), 10 * seq, 3,
            std::string("a\0\xff", 3) + std::to_string(seq)};
}
fleet::Records rows(std::int64_t from, std::int64_t to) {
    fleet::Records records;
    for (std::int64_t seq = from; seq <= to; ++seq) records.journal.push_back(row(seq));
    return records;
}
fleet::SnapshotRow snapshot(std::int64_t seq, std::string bytes = "state") {
    return {seq, 1, 7, std::move(bytes)};
}

std::string large() {
    std::string bytes;
    while (bytes.size() < 100'000) bytes.append("\0x\xff", 3);
    return bytes;
}

std::int64_t number(Database& database, const char* query) {
    std::int64_t value = 0;
    database.sql() << query, soci::into(value);
    return value;
}

TEST(JournalStore, GivesBackTheNewestSnapshotAndTheRowsBehindItToTheLastByte) {
    Database database(":memory:");
    FleetStore store(database);
    store.commit(rows(1, 3));
    store.put_snapshot(snapshot(3, large()));
    store.commit(rows(4, 5));

    const auto stored = store.load_journal();

    ASSERT_TRUE(stored.snapshot);
    EXPECT_EQ(stored.snapshot->journal_seq, 3);
    EXPECT_EQ(stored.snapshot->format, 1);
    EXPECT_EQ(stored.snapshot->plant_revision, 7);
    EXPECT_EQ(stored.snapshot->bytes, large());
    ASSERT_EQ(stored.rows.size(), 2u);
    EXPECT_EQ(stored.rows[1].seq, 5);
    EXPECT_EQ(stored.rows[1].at, row(5).at);
    EXPECT_EQ(stored.rows[1].event_seq, 50);
    EXPECT_EQ(stored.rows[1].inputs, 3);
    EXPECT_EQ(stored.rows[1].bytes, row(5).bytes);
}

TEST(JournalStore, KeepsTwoSnapshotsAndDropsOlderRowsLittleByLittle) {
    Database database(":memory:");
    FleetStore store(database);
    store.commit(rows(1, 100));
    store.put_snapshot(snapshot(10));
    store.put_snapshot(snapshot(50));
    store.put_snapshot(snapshot(100));

    EXPECT_EQ(number(database, "SELECT COUNT(*) FROM snapshots"), 2);
    EXPECT_EQ(number(database, "SELECT MIN(seq) FROM journal"), 1);
    store.commit(rows(101, 101));
    EXPECT_EQ(number(database, "SELECT MIN(seq) FROM journal"), 17);
    for (std::int64_t seq = 102; seq <= 110; ++seq) store.commit(rows(seq, seq));

    EXPECT_EQ(number(database, "SELECT MIN(seq) FROM journal"), 51);
    EXPECT_EQ(number(database, "SELECT COUNT(*) FROM journal"), 60);
}

TEST(JournalStore, RefusesARowThatDoesNotFollow) {
    Database database(":memory:");
    FleetStore store(database);
    store.commit(rows(1, 2));

    EXPECT_THROW(store.commit(rows(4, 4)), Error);
    EXPECT_THROW(store.commit(rows(2, 2)), Error);

    EXPECT_EQ(number(database, "SELECT MAX(seq) FROM journal"), 2);
    store.commit(rows(3, 3));
    EXPECT_EQ(number(database, "SELECT MAX(seq) FROM journal"), 3);
}

TEST(JournalStore, TheNextServerGoesOnBehindItAndInTimeToo) {
    Database database(":memory:");
    {
        FleetStore store(database);
        store.commit(rows(1, 40));
        store.put_snapshot(snapshot(20));
        store.put_snapshot(snapshot(40));
    }
    FleetStore store(database);

    const auto stored = store.load();
    EXPECT_EQ(stored.last_journal_seq, 40);
    EXPECT_EQ(stored.last_time, row(40).at);
    store.commit(rows(41, 41));
    EXPECT_EQ(number(database, "SELECT MIN(seq) FROM journal"), 17);
}

TEST(JournalStore, WithoutASnapshotThereIsNothingToReplay) {
    Database database(":memory:");
    FleetStore store(database);
    store.commit(rows(1, 3));

    const auto stored = store.load_journal();

    EXPECT_FALSE(stored.snapshot);
    EXPECT_TRUE(stored.rows.empty());
}

}  // namespace
}  // namespace pulseline::db
