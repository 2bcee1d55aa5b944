#include "db/database.hpp"

#include <fcntl.h>
#include <soci/sqlite3/soci-sqlite3.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/crash_point.hpp"
#include "migrations.hpp"

namespace pulseline::db {
namespace {

constexpr int kVersion = static_cast<int>(kMigrations.size());
// "puls" in ASCII: tells our files from other SQLite databases.
constexpr int kApplicationId = 0x70756c73;

constexpr const char* kRemedy =
    "Check that the folder exists, that this user may write there, and that the disk is not full.";

bool in_memory(const std::string& path) { return path == ":memory:"; }

/// Each connection is used by one thread at a time, so SQLite need not lock it at every step: a
/// sixth of the time of a start with 100,000 orders. Without effect when SQLite runs already (tests
/// with a file system of their own).
void leave_locking_to_us() {
    static const int once = sqlite_api::sqlite3_config(SQLITE_CONFIG_MULTITHREAD);
    static_cast<void>(once);
}

void open(soci::session& sql, const std::string& path, const std::string& options) {
    leave_locking_to_us();
    if (path.empty() || path.find('"') != std::string::npos) {
        throw Error(Error::Kind::kUnusable,
                    path + ": this path cannot be used; name a file without double quotes.");
    }
    try {
        sql.open(soci::sqlite3, "dbname=\"" + path + "\" timeout=1" + options);
        // Nobody maps the file: the WAL bug of 3.40.1 and torn reads after truncation are not worth
        // it.
        sql << "PRAGMA mmap_size = 0";
        sql << "PRAGMA foreign_keys = ON";
        sql << "PRAGMA trusted_schema = OFF";
    } catch (const soci::soci_error& error) {
        throw Error(Error::Kind::kUnusable, path + ": " + error.what() + ". " + kRemedy);
    }
}

/// The file holds password hashes: made for its owner alone, and SQLite gives the files beside it
/// the same mode. One that everybody may read was made by an older program; a group's right was
/// given by a person and stays.
void make_private(const std::string& path) {
    if (path.find('"') != std::string::npos) return;  // will be refused
    const int made = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (made >= 0) ::close(made);  // what cannot be opened is told by SQLite's own attempt
    for (const char* ending : {"", "-wal", "-shm"}) {
        const std::string file = path + ending;
        struct stat found {};
        if (::stat(file.c_str(), &found) == 0 && (found.st_mode & S_IRWXO) != 0) {
            ::chmod(file.c_str(), S_IRUSR | S_IWUSR);
        }
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

void refuse_newer(int found, const std::string& path) {
    if (found <= kVersion) return;
    throw Error(Error::Kind::kTooNew, path + ": made by a newer program (version " +
                                          std::to_string(found) + ", this one knows " +
                                          std::to_string(kVersion) +
                                          "); install that program or restore a backup.");
}

sqlite_api::sqlite3* handle(soci::session& sql) {
    return static_cast<soci::sqlite3_session_backend*>(sql.get_backend())->conn_;
}

/// Several statements: SOCI prepares only the first one of a text.
void run_script(soci::session& sql, const char* script) {
    char* message = nullptr;
    if (sqlite_api::sqlite3_exec(handle(sql), script, nullptr, nullptr, &message) != SQLITE_OK) {
        const std::string what = message == nullptr ? "unknown error" : message;
        sqlite_api::sqlite3_free(message);
        throw soci::soci_error(what);
    }
}

constexpr int kCheckpointPages = 1000;  // SQLite's own default

/// Does what SQLite does by itself, so that tests can die right before and after it. A checkpoint
/// that fails loses nothing: the log keeps what was committed.
int write_back(void*, sqlite_api::sqlite3* connection, const char* schema, int pages) {
    if (pages < kCheckpointPages) return SQLITE_OK;
    crash_point(CrashPoint::kCheckpointBefore);
    sqlite_api::sqlite3_wal_checkpoint_v2(connection, schema, SQLITE_CHECKPOINT_PASSIVE, nullptr,
                                          nullptr);
    crash_point(CrashPoint::kCheckpointAfter);
    return SQLITE_OK;
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
    if (!in_memory(path)) {
        lock_ = std::make_unique<WriteLock>(path);
        make_private(path);
    }
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
        sqlite_api::sqlite3_wal_hook(handle(sql_), write_back, nullptr);
        crash_point(CrashPoint::kStartBeforeMigration);
        migrate();
        crash_point(CrashPoint::kStartAfterMigration);
    } catch (const soci::soci_error& error) {
        throw Error(Error::Kind::kUnusable, path_ + ": " + error.what() + ". " + kRemedy);
    }
}

Database::~Database() { crash_point(CrashPoint::kStopBeforeClose); }

int Database::version() { return pragma(sql_, "user_version"); }

void Database::migrate() {
    const int found = version();
    refuse_newer(found, path_);
    for (int next = found; next < kVersion; ++next) {
        soci::transaction transaction(sql_);
        run_script(sql_, kMigrations[static_cast<std::size_t>(next)]);
        crash_point(CrashPoint::kStartInMigration);
        sql_ << "PRAGMA application_id = " + std::to_string(kApplicationId);
        sql_ << "PRAGMA user_version = " + std::to_string(next + 1);
        transaction.commit();
    }
}

void Database::transaction(const std::function<void()>& work) {
    try {
        crash_point(CrashPoint::kCommitBeforeBegin);
        soci::transaction transaction(sql_);
        crash_point(CrashPoint::kCommitAfterBegin);
        work();
        crash_point(CrashPoint::kCommitBeforeCommit);
        transaction.commit();
    } catch (const soci::soci_error& error) {
        throw failure(path_ + ": nothing was stored", error);
    }
    crash_point(CrashPoint::kCommitAfterCommit);
}

Error failure(const std::string& path, const soci::soci_error& error) {
    const auto* sqlite = dynamic_cast<const soci::sqlite3_soci_error*>(&error);
    // The lower byte is the kind; what is above tells where it happened.
    const int code = sqlite ? sqlite->result() & 0xff : SQLITE_ERROR;
    // Without the statement and its values: they are orders and names, and the log is no place for
    // them.
    const std::string what = path + ": " + error.get_error_message() + ". ";
    if (code == SQLITE_FULL) return {Error::Kind::kFull, what + "Free space on its disk."};
    if (code == SQLITE_READONLY || code == SQLITE_PERM || code == SQLITE_CANTOPEN) {
        return {Error::Kind::kReadOnly, what + "Make the file and its folder writable again."};
    }
    return {Error::Kind::kFailed, what + "Check the free space and the disk."};
}

ReadOnly::ReadOnly(const std::string& path) : path_(path) {
    open(sql_, path, " readonly=true");
    try {
        refuse_foreign(sql_, path_);
        const int found = pragma(sql_, "user_version");
        refuse_newer(found, path_);
        if (found == kVersion) return;
        throw Error(Error::Kind::kUnusable,
                    path_ + ": made by an older program (version " + std::to_string(found) +
                        ", this one knows " + std::to_string(kVersion) +
                        "); read it with that program, or let `pulseline serve` bring it to the "
                        "newest version.");
    } catch (const soci::soci_error& error) {
        throw Error(Error::Kind::kUnusable, path_ + ": " + error.what() + ". " + kRemedy);
    }
}

}  // namespace pulseline::db
