#include "db/database.hpp"

#include <fcntl.h>
#include <soci/sqlite3/soci-sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "migrations.hpp"

namespace pulseline::db {
namespace {

constexpr int kVersion = static_cast<int>(kMigrations.size());
// "puls" in ASCII: tells our files from other SQLite databases.
constexpr int kApplicationId = 0x70756c73;

constexpr const char* kRemedy =
    "Check that the folder exists, that this user may write there, and that the disk is not full.";

bool in_memory(const std::string& path) { return path == ":memory:"; }

void open(soci::session& sql, const std::string& path, const std::string& options) {
    if (path.empty() || path.find('"') != std::string::npos) {
        throw Error(Error::Kind::kUnusable,
                    path + ": this path cannot be used; name a file without double quotes.");
    }
    try {
        sql.open(soci::sqlite3, "dbname=\"" + path + "\" timeout=10" + options);
        // Nobody maps the file: the WAL bug of 3.40.1 and torn reads after truncation are not worth
        // it.
        sql << "PRAGMA mmap_size = 0";
        sql << "PRAGMA foreign_keys = ON";
        sql << "PRAGMA trusted_schema = OFF";
    } catch (const soci::soci_error& error) {
        throw Error(Error::Kind::kUnusable, path + ": " + error.what() + ". " + kRemedy);
    }
}

int pragma(soci::session& sql, const char* name) {
    int value = 0;
    sql << std::string("PRAGMA ") + name, soci::into(value);
    return value;
}

void refuse_foreign(soci::session& sql, const std::string& path) {
    const int application = pragma(sql, "application_id");
    const int version = pragma(sql, "user_version");
    int tables = 0;
    sql << "SELECT COUNT(*) FROM sqlite_schema", soci::into(tables);
    if (application == kApplicationId || (application == 0 && version == 0 && tables == 0)) return;
    throw Error(Error::Kind::kUnusable,
                path + ": this is a database of another program; name another file.");
}

/// Several statements: SOCI prepares only the first one of a text.
void run_script(soci::session& sql, const char* script) {
    auto* const connection = static_cast<soci::sqlite3_session_backend*>(sql.get_backend())->conn_;
    char* message = nullptr;
    if (sqlite_api::sqlite3_exec(connection, script, nullptr, nullptr, &message) != SQLITE_OK) {
        const std::string what = message == nullptr ? "unknown error" : message;
        sqlite_api::sqlite3_free(message);
        throw soci::soci_error(what);
    }
}

}  // namespace

WriteLock::WriteLock(const std::string& database_path) {
    const std::string path = database_path + ".lock";
    file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (file_ < 0) {
        throw Error(Error::Kind::kUnusable, path + ": " + std::strerror(errno) + ". " + kRemedy);
    }
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
        const int why = errno;
        ::close(file_);
        if (why == EWOULDBLOCK) {
            throw Error(Error::Kind::kLocked,
                        database_path +
                            ": another process is using this database; stop it, or use the "
                            "running server's API instead.");
        }
        throw Error(Error::Kind::kUnusable, path + ": " + std::strerror(why) + ". " + kRemedy);
    }
}

// The file stays: removing it would let two processes lock two files of one name.
WriteLock::~WriteLock() { ::close(file_); }

Database::Database(const std::string& path) : path_(path) {
    if (!in_memory(path)) lock_ = std::make_unique<WriteLock>(path);
    open(sql_, path, "");
    try {
        refuse_foreign(sql_, path_);
        if (!in_memory(path)) {
            std::string mode;
            sql_ << "PRAGMA journal_mode = WAL", soci::into(mode);
            if (mode != "wal") {
                throw Error(
                    Error::Kind::kUnusable,
                    path_ + ": this file system cannot keep a write-ahead log; use a local disk.");
            }
        }
        sql_ << "PRAGMA synchronous = FULL";
        migrate();
    } catch (const soci::soci_error& error) {
        throw Error(Error::Kind::kUnusable, path_ + ": " + error.what() + ". " + kRemedy);
    }
}

Database::~Database() = default;

int Database::version() { return pragma(sql_, "user_version"); }

void Database::migrate() {
    const int found = version();
    if (found > kVersion) {
        throw Error(Error::Kind::kTooNew, path_ + ": made by a newer program (version " +
                                              std::to_string(found) + ", this one knows " +
                                              std::to_string(kVersion) +
                                              "); install that program or restore a backup.");
    }
    for (int next = found; next < kVersion; ++next) {
        soci::transaction transaction(sql_);
        run_script(sql_, kMigrations[static_cast<std::size_t>(next)]);
        sql_ << "PRAGMA application_id = " + std::to_string(kApplicationId);
        sql_ << "PRAGMA user_version = " + std::to_string(next + 1);
        transaction.commit();
    }
}

void Database::transaction(const std::function<void()>& work) {
    try {
        soci::transaction transaction(sql_);
        work();
        transaction.commit();
    } catch (const soci::soci_error& error) {
        throw Error(Error::Kind::kFailed, path_ + ": nothing was stored: " + error.what() +
                                              ". Check the free space and the disk.");
    }
}

ReadOnly::ReadOnly(const std::string& path) : path_(path) { open(sql_, path, " readonly=true"); }

}  // namespace pulseline::db
