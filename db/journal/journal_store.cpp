#include "db/journal/journal_store.hpp"

#include <algorithm>
#include <limits>

#include "core/base/crash_point.hpp"
#include "db/journal/journal_rows.hpp"
#include "db/sql_text.hpp"

namespace pulseline::db {
namespace {

// With every commit, which adds a row or a few: the rest is gone long before the next snapshot,
// and no commit is held up.
constexpr std::int64_t kDropped = 16;

constexpr const char* kDropRows = "DELETE FROM journal WHERE seq < :upto";
constexpr const char* kDropSnapshots =
    "DELETE FROM snapshots WHERE journal_seq < (SELECT MIN(journal_seq) FROM (SELECT journal_seq "
    "FROM snapshots ORDER BY journal_seq DESC LIMIT 2))";

std::int64_t scalar(soci::session& sql, const std::string& query) {
    std::int64_t value = 0;
    sql << query, soci::into(value);
    return value;
}

}  // namespace

struct JournalStore::Statements {
    explicit Statements(soci::session& sql)
        : row(sql),
          snapshot(sql),
          put_row(sql, insert_into("journal", JournalRow::kColumns), row.fields()),
          drop_rows(sql, kDropRows, std::tie(upto)),
          put_snapshot(sql, upsert_into("snapshots", SnapshotRow::kColumns, "journal_seq"),
                       snapshot.fields()),
          drop_snapshots(sql, kDropSnapshots) {}

    JournalRow row;
    SnapshotRow snapshot;
    std::int64_t upto = 0;
    Statement put_row, drop_rows, put_snapshot, drop_snapshots;
};

JournalStore::JournalStore(Database& database) : database_(database) {
    reading(database.path(), [&] {
        statements_ = std::make_unique<Statements>(database.sql());
        last_seq_ = scalar(database.sql(), "SELECT COALESCE(MAX(seq), 0) FROM journal");
        last_seq_ = std::max(last_seq_, scalar(database.sql(),
                                               "SELECT COALESCE(MAX(journal_seq), 0) FROM "
                                               "snapshots"));
        read_bounds();
        return 0;
    });
}

JournalStore::~JournalStore() = default;

void JournalStore::read_bounds() {
    oldest_seq_ = scalar(database_.sql(), "SELECT COALESCE(MIN(seq), 0) FROM journal");
    needless_seq_ = scalar(database_.sql(),
                           "SELECT COALESCE((SELECT journal_seq FROM snapshots ORDER BY "
                           "journal_seq DESC LIMIT 1 OFFSET 1), 0)");
}

fleet::StoredJournal JournalStore::load() {
    return reading(database_.path(), [&] {
        fleet::StoredJournal stored;
        auto snapshots = load_snapshots(database_.sql());
        if (snapshots.empty()) return stored;
        stored.snapshot = std::move(snapshots.back());
        stored.rows = load_journal_rows(database_.sql(), stored.snapshot->journal_seq,
                                        std::numeric_limits<std::int64_t>::max());
        return stored;
    });
}

void JournalStore::put(const std::vector<fleet::JournalRow>& rows) {
    Statements& s = *statements_;
    next_last_seq_ = last_seq_;
    next_oldest_seq_ = oldest_seq_;
    for (const auto& row : rows) {
        if (row.seq != next_last_seq_ + 1) {
            throw Error(Error::Kind::kBadValue,
                        "Nothing was stored: journal row " + std::to_string(row.seq) +
                            " does not follow row " + std::to_string(next_last_seq_) + ".");
        }
        next_last_seq_ = row.seq;
        s.row.set(row);
        s.put_row.run();
        crash_point(CrashPoint::kCommitAfterJournal);
    }
    if (rows.empty() || oldest_seq_ > needless_seq_) return;
    s.upto = std::min(oldest_seq_ + kDropped, needless_seq_ + 1);
    s.drop_rows.run();
    next_oldest_seq_ = s.upto;
}

void JournalStore::committed() {
    last_seq_ = next_last_seq_;
    oldest_seq_ = next_oldest_seq_;
}

void JournalStore::put(const fleet::SnapshotRow& snapshot) {
    Statements& s = *statements_;
    crash_point(CrashPoint::kSnapshotBefore);
    database_.transaction([&] {
        s.snapshot.set(snapshot);
        s.put_snapshot.run();
        crash_point(CrashPoint::kSnapshotAfterRow);
        s.drop_snapshots.run();
        crash_point(CrashPoint::kSnapshotAfterDrop);
    });
    s.snapshot.bytes.trim(0);
    crash_point(CrashPoint::kSnapshotAfterCommit);
    reading(database_.path(), [&] {
        read_bounds();
        return 0;
    });
}

}  // namespace pulseline::db
