#include "server/cli/storage.hpp"

#include "db/access/access_store.hpp"
#include "db/database.hpp"
#include "db/fleet/fleet_store.hpp"
#include "db/fleet/history.hpp"
#include "db/plant/plant_store.hpp"

namespace pulseline::server::cli {
namespace {

class DatabaseStorage : public Storage {
public:
    explicit DatabaseStorage(const std::string& path) : database_(path), reader_(path) {}

    fleet::Store& fleet() override { return fleet_; }
    fleet::History& history() override { return history_; }
    void keep_events(std::int64_t newest, Duration age) override {
        fleet_.keep_events({newest, age});
    }
    access::Store& access() override { return access_; }
    std::optional<plant::Plant> plant() override { return db::PlantStore(database_).load(); }
    std::int64_t import_plant(const plant::Plant& plant) override {
        return db::PlantStore(database_).import(plant);
    }

private:
    db::Database database_;
    db::ReadOnly reader_;  // the history's own connection
    db::FleetStore fleet_{database_};
    db::History history_{reader_};
    db::AccessStore access_{database_};
};

}  // namespace

Result<std::unique_ptr<Storage>> open_storage(const std::string& path) {
    try {
        return std::make_unique<DatabaseStorage>(path);
    } catch (const db::Error& e) {
        return fail(Errc::kUnavailable, "database_unusable", e.what());
    }
}

}  // namespace pulseline::server::cli
