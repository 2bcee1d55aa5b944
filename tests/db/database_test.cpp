#include "db/database.hpp"

#include <gtest/gtest.h>
#include <soci/sqlite3/soci-sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "tests/db/temp_folder.hpp"

namespace pulseline::db {
namespace {

template <class Act>
Error::Kind kind_of(Act act, std::string* what = nullptr) {
    try {
        act();
    } catch (const Error& error) {
        if (what != nullptr) *what = error.what();
        return error.kind();
    }
    ADD_FAILURE() << "no db::Error";
    return Error::Kind::kFailed;
}

int pragma(soci::session& sql, const std::string& name) {
    int value = -1;
    sql << "PRAGMA " + name, soci::into(value);
    return value;
}

int mode_of(const std::string& path) {
    struct stat found {};
    return ::stat(path.c_str(), &found) == 0 ? static_cast<int>(found.st_mode & 0777U) : -1;
}

TEST(Database, IsReadByNobodyElse) {
    const TempFolder folder;
    const std::string path = folder.file("fleet.db");
    Database database(path);

    for (const char* ending : {"", "-wal", "-shm", ".lock"}) {
        EXPECT_EQ(mode_of(path + ending), 0600) << ending;
    }
}

TEST(Database, ClosesAFileThatAnOlderProgramLeftOpenToAllButKeepsAGroup) {
    const TempFolder folder;
    const std::string open = folder.file("open.db");
    const std::string group = folder.file("group.db");
    for (const auto& path : {open, group}) Database database(path);
    ::chmod(open.c_str(), 0644);
    ::chmod(group.c_str(), 0640);

    for (const auto& path : {open, group}) Database database(path);

    EXPECT_EQ(mode_of(open), 0600);
    EXPECT_EQ(mode_of(group), 0640);
}

TEST(Database, MigratesAnEmptyFileAndOpensItAgain) {
    const TempFolder folder;
    const std::string path = folder.file("fleet.db");
    {
        Database database(path);
        EXPECT_GE(database.version(), 1);
        database.sql() << "INSERT INTO users VALUES ('ann', 'admin', 'x', 0, 1)";
    }
    Database again(path);
    int users = 0;
    again.sql() << "SELECT COUNT(*) FROM users", soci::into(users);

    EXPECT_EQ(users, 1);
}

TEST(Database, KeepsItsPromisesToTheDisk) {
    const TempFolder folder;
    Database database(folder.file("fleet.db"));
    std::string mode;
    database.sql() << "PRAGMA journal_mode", soci::into(mode);

    EXPECT_EQ(mode, "wal");
    EXPECT_EQ(pragma(database.sql(), "synchronous"), 2);
    EXPECT_EQ(pragma(database.sql(), "foreign_keys"), 1);
    EXPECT_EQ(pragma(database.sql(), "mmap_size"), 0);
}

TEST(Database, EveryTableIsStrict) {
    Database database(":memory:");
    int loose = -1;
    database.sql()
        << "SELECT COUNT(*) FROM pragma_table_list WHERE schema = 'main' AND type = 'table' "
           "AND name NOT LIKE 'sqlite_%' AND strict = 0",
        soci::into(loose);

    EXPECT_EQ(loose, 0);
}

TEST(Database, ForeignKeysAreEnforced) {
    Database database(":memory:");

    EXPECT_EQ(kind_of([&] {
                  database.transaction([&] {
                      database.sql() << "INSERT INTO sessions VALUES ('t', 'c', 'nobody', 1, 2)";
                  });
              }),
              Error::Kind::kFailed);
}

TEST(Database, SecondWriterIsRefusedUntilTheFirstIsGone) {
    const TempFolder folder;
    const std::string path = folder.file("fleet.db");
    std::string what;
    {
        Database first(path);
        EXPECT_EQ(kind_of([&] { Database second(path); }, &what), Error::Kind::kLocked);
        EXPECT_NE(what.find(path), std::string::npos);
        EXPECT_NE(what.find("stop it"), std::string::npos);
    }
    EXPECT_NO_THROW(Database second(path));
}

TEST(Database, NewerDatabaseIsRefused) {
    const TempFolder folder;
    const std::string path = folder.file("fleet.db");
    {
        Database database(path);
        database.sql() << "PRAGMA user_version = 9999";
    }
    std::string what;

    EXPECT_EQ(kind_of([&] { Database again(path); }, &what), Error::Kind::kTooNew);
    EXPECT_NE(what.find("9999"), std::string::npos);
    EXPECT_EQ(kind_of([&] { ReadOnly reading(path); }, &what), Error::Kind::kTooNew);
}

TEST(Database, WhoeverOnlyReadsIsToldOfAFileOfAnOlderProgram) {
    const TempFolder folder;
    const std::string path = folder.file("old.db");
    {
        Database database(path);
        EXPECT_NO_THROW(ReadOnly reading(path));
        database.sql() << "PRAGMA user_version = 3";
    }
    std::string what;
    EXPECT_EQ(kind_of([&] { ReadOnly reading(path); }, &what), Error::Kind::kUnusable);
    EXPECT_NE(what.find("version 3"), std::string::npos) << what;
    EXPECT_NE(what.find("pulseline serve"), std::string::npos) << what;
}

TEST(Database, ForeignAndDamagedFilesAreRefused) {
    const TempFolder folder;
    {
        soci::session other(soci::sqlite3, "dbname=" + folder.file("other.db"));
        other << "CREATE TABLE t (a)";
    }
    std::ofstream(folder.file("text.db")) << std::string(5000, 'x');
    std::string what;

    EXPECT_EQ(kind_of([&] { Database database(folder.file("other.db")); }, &what),
              Error::Kind::kUnusable);
    EXPECT_NE(what.find("another program"), std::string::npos);
    EXPECT_EQ(kind_of([&] { Database database(folder.file("text.db")); }), Error::Kind::kUnusable);
}

TEST(Database, MissingFolderIsNamedWithARemedy) {
    const TempFolder folder;
    const std::string path = folder.file("gone/fleet.db");
    std::string what;

    EXPECT_EQ(kind_of([&] { Database database(path); }, &what), Error::Kind::kUnusable);
    EXPECT_NE(what.find(path), std::string::npos);
    EXPECT_NE(what.find("Check that the folder exists"), std::string::npos);
}

TEST(Database, UnwritableFolderIsNamed) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
    const TempFolder folder;
    std::filesystem::permissions(
        folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);

    EXPECT_EQ(kind_of([&] { Database database(folder.file("fleet.db")); }), Error::Kind::kUnusable);
}

TEST(Database, FullDiskAtStartIsAnUnusableDatabase) {
    const TempFolder folder;
    const std::string path = folder.file("fleet.db");
    std::filesystem::create_symlink("/dev/full", path);
    std::string what;

    EXPECT_EQ(kind_of([&] { Database database(path); }, &what), Error::Kind::kUnusable);
    EXPECT_NE(what.find("disk"), std::string::npos);
}

TEST(Database, FailedTransactionStoresNothing) {
    Database database(":memory:");
    kind_of([&] {
        database.transaction([&] {
            database.sql() << "INSERT INTO users VALUES ('ann', 'admin', 'x', 0, 1)";
            database.sql() << "INSERT INTO users VALUES ('bob', 'king', 'x', 0, 1)";
        });
    });
    int users = -1;
    database.sql() << "SELECT COUNT(*) FROM users", soci::into(users);

    EXPECT_EQ(users, 0);
}

TEST(ReadOnly, SeesWhatIsCommittedAndCannotWrite) {
    const TempFolder folder;
    const std::string path = folder.file("fleet.db");
    Database database(path);
    ReadOnly reader(path);
    database.sql() << "INSERT INTO users VALUES ('ann', 'admin', 'x', 0, 1)";
    int users = 0;
    reader.sql() << "SELECT COUNT(*) FROM users", soci::into(users);

    EXPECT_EQ(users, 1);
    EXPECT_THROW(reader.sql() << "DELETE FROM users", soci::soci_error);
}

TEST(ReadOnly, MissingFileIsAnError) {
    const TempFolder folder;

    EXPECT_EQ(kind_of([&] { ReadOnly reader(folder.file("none.db")); }), Error::Kind::kUnusable);
    EXPECT_FALSE(std::filesystem::exists(folder.file("none.db")));
}

}  // namespace
}  // namespace pulseline::db
