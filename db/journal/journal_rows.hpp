#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/fleet/state/ports.hpp"
#include "db/statement.hpp"

namespace pulseline::db {

struct JournalRow {
    static constexpr const char* kColumns = "seq, at_ns, event_seq, inputs, bytes";
    explicit JournalRow(soci::session& sql) : bytes(sql) {}
    std::int64_t seq = 0;
    std::int64_t at_ns = 0;
    std::int64_t event_seq = 0;
    std::int64_t inputs = 0;
    soci::blob bytes;

    auto fields() { return std::tie(seq, at_ns, event_seq, inputs, bytes); }
    void set(const fleet::JournalRow& row);
    fleet::JournalRow get();
};

struct SnapshotRow {
    static constexpr const char* kColumns = "journal_seq, format, plant_revision, bytes";
    explicit SnapshotRow(soci::session& sql) : bytes(sql) {}
    std::int64_t journal_seq = 0;
    std::int64_t format = 0;
    std::int64_t plant_revision = 0;
    soci::blob bytes;

    auto fields() { return std::tie(journal_seq, format, plant_revision, bytes); }
    void set(const fleet::SnapshotRow& row);
    fleet::SnapshotRow get();
};

/// Oldest first.
std::vector<fleet::SnapshotRow> load_snapshots(soci::session& sql);
/// At most `limit` rows behind `after`, in order.
std::vector<fleet::JournalRow> load_journal_rows(soci::session& sql, std::int64_t after,
                                                 std::int64_t limit);

}  // namespace pulseline::db
