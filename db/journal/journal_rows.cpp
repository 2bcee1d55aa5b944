#include "db/journal/journal_rows.hpp"

namespace pulseline::db {
namespace {

void put(soci::blob& blob, const std::string& bytes) {
    blob.trim(0);
    blob.write(0, bytes.data(), bytes.size());
}

std::string bytes_of(soci::blob& blob) {
    std::string bytes(blob.get_len(), '\0');
    if (!bytes.empty()) blob.read(0, bytes.data(), bytes.size());
    return bytes;
}

}  // namespace

void JournalRow::set(const fleet::JournalRow& row) {
    seq = row.seq;
    at_ns = to_ns(row.at);
    event_seq = row.event_seq;
    inputs = row.inputs;
    put(bytes, row.bytes);
}

fleet::JournalRow JournalRow::get() {
    return {seq, time_from_ns(at_ns), event_seq, inputs, bytes_of(bytes)};
}

void SnapshotRow::set(const fleet::SnapshotRow& row) {
    journal_seq = row.journal_seq;
    format = row.format;
    plant_revision = row.plant_revision;
    put(bytes, row.bytes);
}

fleet::SnapshotRow SnapshotRow::get() {
    return {journal_seq, format, plant_revision, bytes_of(bytes)};
}

std::vector<fleet::SnapshotRow> load_snapshots(soci::session& sql) {
    std::vector<fleet::SnapshotRow> snapshots;
    SnapshotRow row(sql);
    Statement list(
        sql,
        std::string("SELECT ") + SnapshotRow::kColumns + " FROM snapshots ORDER BY journal_seq",
        std::tuple<>(), row.fields());
    for (list.start(); list.fetch();) snapshots.push_back(row.get());
    return snapshots;
}

std::vector<fleet::JournalRow> load_journal_rows(soci::session& sql, std::int64_t after,
                                                 std::int64_t limit) {
    std::vector<fleet::JournalRow> rows;
    JournalRow row(sql);
    Statement list(sql,
                   std::string("SELECT ") + JournalRow::kColumns +
                       " FROM journal WHERE seq > :after ORDER BY seq LIMIT :limit",
                   std::tie(after, limit), row.fields());
    for (list.start(); list.fetch();) rows.push_back(row.get());
    return rows;
}

}  // namespace pulseline::db
