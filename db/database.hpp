#pragma once

#include <soci/soci.h>

#include <functional>
#include <string>

#include "db/error.hpp"

namespace pulseline::db {

/// Held as long as this process may write the database; FILE.lock beside it. Another process is
/// refused.
class WriteLock {
public:
    explicit WriteLock(const std::string& database_path);
    ~WriteLock();
    WriteLock(const WriteLock&) = delete;
    WriteLock& operator=(const WriteLock&) = delete;

private:
    int file_ = -1;
};

/// The ONE writing connection: opens or creates the file, locks it, brings it to the newest
/// version. Debian's SQLite 3.40.1 can lose data when two connections checkpoint a WAL, so
/// everybody else is ReadOnly. Throws db::Error (locked, unusable, made by a newer program), naming
/// the path and the remedy. Thread safety: none, one thread uses it.
class Database {
public:
    /// ":memory:" for tests: no file, no lock.
    explicit Database(const std::string& path);
    ~Database();
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;

    soci::session& sql() { return sql_; }
    const std::string& path() const { return path_; }
    int version();
    /// Runs the work as one transaction; throws db::Error and stores nothing when it fails.
    void transaction(const std::function<void()>& work);

private:
    void migrate();

    std::string path_;
    std::unique_ptr<WriteLock> lock_;
    soci::session sql_;
};

/// A connection that cannot write (SQLITE_OPEN_READONLY), nor bring the file to the newest version:
/// that must exist and be of it. Throws db::Error (unusable, made by a newer program).
/// Thread safety: none; give each thread its own.
class ReadOnly {
public:
    explicit ReadOnly(const std::string& path);

    soci::session& sql() { return sql_; }
    const std::string& path() const { return path_; }

private:
    std::string path_;
    soci::session sql_;
};

/// What SQLite refused as db::Error: full disk and write protection are kinds of their own.
Error failure(const std::string& path, const soci::soci_error& error);

/// Runs work that only reads; SOCI's exceptions become db::Error.
template <class Work>
auto reading(const std::string& path, Work work) {
    try {
        return work();
    } catch (const soci::soci_error& error) {
        throw failure(path, error);
    }
}

}  // namespace pulseline::db
