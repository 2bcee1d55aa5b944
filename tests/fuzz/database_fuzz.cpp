// The bytes damage a sound database, all that a starting server reads of it is read, and the fleet
// goes on with it: nothing but that or db::Error may come of it. Twelve bytes an edit: what is
// done, where (three bytes), eight bytes of a value. Edits of columns come before those of the
// file. A database file written out (it begins as SQLite's do) is taken as it is.
#include <sqlite3.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/plant/validate.hpp"
#include "db/access/access_store.hpp"
#include "db/fleet/fleet_store.hpp"
#include "db/fleet/history.hpp"
#include "db/plant/plant_store.hpp"
#include "tests/core/fleet/fleet_world.hpp"
#include "tests/db/fleet_samples.hpp"

namespace {

using namespace pulseline;
using Connection = std::unique_ptr<sqlite3, decltype(&sqlite3_close)>;
using Column = std::pair<std::string, std::string>;  // of which table, its name

constexpr std::size_t kEdit = 12;

/// In memory where the machine offers it; goes away with the process.
class Folder {
public:
    Folder() : path_(std::filesystem::exists("/dev/shm") ? "/dev/shm" : "/tmp") {
        path_ /= "pulseline-fuzz-" + std::to_string(::getpid());
        std::filesystem::create_directory(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    std::string database() const { return path_ / "fleet.db"; }
    void empty() const {
        for (const char* ending : {"", "-wal", "-shm", "-journal"})
            std::filesystem::remove(database() + ending);
    }

private:
    std::filesystem::path path_;
};

Connection connect(const std::string& path) {
    sqlite3* opened = nullptr;
    sqlite3_open(path.c_str(), &opened);
    return {opened, sqlite3_close};
}

/// A fleet in the middle of its work, with every kind of row.
void fill(const std::string& path) {
    auto plant = fleet::testing::small_plant();
    for (auto& station : plant.stations) station.resting_place = true;  // or it is not sound
    fleet::testing::World world(plant);
    world.connect_all();
    if (!world.order("V1", {2, 3}) || !world.order("", {4})) std::abort();
    world.run(4);
    world.settle();
    db::Samples samples(1);
    fleet::Records records;
    for (const auto& [id, order] : world.store.orders) records.orders.push_back(order);
    records.orders.push_back(samples.order(90, 1000));
    for (const auto& [id, vehicle] : world.store.vehicles) records.vehicles.push_back(vehicle);
    records.stops.push_back(samples.stop(2, 0));
    records.events = world.store.events;
    records.idempotency.push_back({"mes", "key", "sha", records.orders.front().id, world.now});
    const plant::Polygon outline{{1, 1}, {2, 1}, {2, 2}};
    records.closures.push_back({fleet::ClosureId(Uuid{{1}}),
                                "wet",
                                plant::HallId("h1"),
                                outline,
                                {plant::EdgeId("n1n2")},
                                "op",
                                world.now});
    records.schedules.push_back(samples.schedule("night", 0));
    records.templates.push_back({"to station", "", "[]", "{}", "op", world.now, false});
    records.journal.push_back({1, world.now, 1, 1, "row"});

    db::Database database(path);
    db::PlantStore(database).import(world.plant);
    db::FleetStore store(database);
    store.put_snapshot({0, 1, 1, "snapshot"});
    store.commit(records);
    db::AccessStore access(database);
    access.put(access::User{"op", access::Role::kOperator, "hash", false, world.now});
    access.put(access::Session{"sha", "csrf", "op", world.now, world.now + kForEver, world.now});
    access::Token token;
    token.id = "t1";
    token.role = access::Role::kViewer;
    access.put(token);
}

struct Sound {
    std::string bytes;
    std::vector<Column> columns;
};

Sound make_sound(const Folder& folder) {
    fill(folder.database());
    Sound sound;
    const auto connection = connect(folder.database());
    sqlite3_exec(connection.get(), "PRAGMA journal_mode = DELETE; VACUUM", nullptr, nullptr,
                 nullptr);
    const auto note = [](void* columns, int, char** values, char**) {
        static_cast<std::vector<Column>*>(columns)->emplace_back(values[0], values[1]);
        return 0;
    };
    sqlite3_exec(connection.get(),
                 "SELECT m.name, c.name FROM sqlite_schema m, pragma_table_info(m.name) c WHERE "
                 "m.type = 'table'",
                 note, &sound.columns, nullptr);
    std::stringstream bytes;
    bytes << std::ifstream(folder.database(), std::ios::binary).rdbuf();
    sound.bytes = bytes.str();
    if (sound.columns.empty() || sound.bytes.empty()) std::abort();
    return sound;
}

/// All rows of a column that take it; what breaks a rule of the schema stays.
void edit_column(sqlite3* connection, const Column& column, const unsigned char* edit) {
    std::int64_t integer = 0;
    double number = 0;
    std::memcpy(&integer, edit + 4, sizeof integer);
    std::memcpy(&number, edit + 4, sizeof number);
    const std::string head = "UPDATE OR IGNORE " + column.first + " SET " + column.second + " = ";
    // A few characters of a text are put in the place of others.
    const std::string splice = "substr(" + column.second + ", 1, length(" + column.second +
                               ") * ?1 / 256) || ?2 || substr(" + column.second + ", length(" +
                               column.second + ") * ?1 / 256 + 1 + ?3)";
    const bool text = edit[0] % 5 == 2;
    sqlite3_stmt* made = nullptr;
    sqlite3_prepare_v2(connection, (head + (text ? splice : "?1")).c_str(), -1, &made, nullptr);
    const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement(made,
                                                                               sqlite3_finalize);
    if (text) {
        const auto* put = reinterpret_cast<const char*>(edit + 5);
        sqlite3_bind_int(made, 1, edit[3]);
        sqlite3_bind_text(made, 2, put, static_cast<int>(::strnlen(put, 7)), SQLITE_STATIC);
        sqlite3_bind_int(made, 3, edit[4]);
    } else if (edit[0] % 5 == 0) {
        sqlite3_bind_int64(made, 1, integer);
    } else {
        sqlite3_bind_double(made, 1, number);
    }
    sqlite3_step(made);
}

void write_damaged(const Folder& folder, const Sound& sound, const unsigned char* data,
                   std::size_t size) {
    std::ofstream(folder.database(), std::ios::binary) << sound.bytes;
    const auto edits = size / kEdit;
    {
        const auto connection = connect(folder.database());
        sqlite3_exec(connection.get(),
                     "PRAGMA ignore_check_constraints = ON; PRAGMA journal_mode = MEMORY; "
                     "PRAGMA synchronous = OFF; BEGIN",
                     nullptr, nullptr, nullptr);
        for (std::size_t i = 0; i < edits; ++i) {
            const unsigned char* edit = data + i * kEdit;
            const std::size_t which = edit[1] + 256U * edit[2];
            if (edit[0] % 5 < 3)
                edit_column(connection.get(), sound.columns[which % sound.columns.size()], edit);
        }
        sqlite3_exec(connection.get(), "COMMIT", nullptr, nullptr, nullptr);
    }
    for (std::size_t i = 0; i < edits; ++i) {
        const unsigned char* edit = data + i * kEdit;
        const std::size_t at =
            (edit[1] + 256U * edit[2] + 65536U * edit[3]) % (sound.bytes.size() + 1);
        if (edit[0] % 5 == 3) {
            std::fstream file(folder.database(), std::ios::binary | std::ios::in | std::ios::out);
            file.seekp(static_cast<std::streamoff>(at));
            file.write(reinterpret_cast<const char*>(edit + 5), 1 + edit[4] % 7);
        } else if (edit[0] % 5 == 4) {
            std::filesystem::resize_file(folder.database(), at);
        }
    }
}

/// A person lets the vehicles go on, and they drive for two seconds.
void go_on(const plant::Plant& plant, const fleet::StoredFleet& stored) {
    fleet::testing::World world(plant);
    for (const auto& order : stored.orders) world.store.orders[order.id] = order;
    for (const auto& vehicle : stored.vehicles) world.store.vehicles[vehicle.id] = vehicle;
    for (const auto& one : stored.schedules) world.store.schedules[one.id] = one;
    world.store.closures = stored.closures;
    world.crash_server();
    world.connect_all();
    std::vector<plant::VehicleId> all;
    for (const auto& vehicle : plant.vehicles) all.push_back(vehicle.id);
    (void)world.fleet->resume_fleet(all, "op", world.now);
    world.run(2);
}

/// True when there was all that a fleet needs to go on.
bool read_everything(const std::string& path) {
    db::Database database(path);
    db::ReadOnly reader(path);
    db::AccessStore access(database);
    (void)access.users();
    (void)access.sessions();
    (void)access.tokens();
    const auto plant = db::PlantStore(database).load();
    db::FleetStore store(database);
    const auto stored = store.load();
    (void)store.load_journal();
    db::History history(reader);
    (void)history.stops({});
    (void)history.orders({});
    (void)history.events_after(0, 500);
    (void)history.statistics({plant::VehicleId("TP-01")}, plant::MotionMode::kLinear, 10);
    if (!plant || !plant::validate(*plant).empty()) return false;
    go_on(*plant, stored);
    return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    static const Folder folder;
    static const Sound sound = make_sound(folder);
    folder.empty();
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (bytes.starts_with("SQLite format 3")) {
        std::ofstream(folder.database(), std::ios::binary) << bytes;
    } else {
        write_damaged(folder, sound, data, size);
    }
    bool went_on = false;
    try {
        went_on = read_everything(folder.database());
    } catch (const db::Error&) {
        // An answer.
    }
    if (size < kEdit && !went_on) std::abort();  // nothing would be tried here
    return 0;
}
