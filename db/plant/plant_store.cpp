#include "db/plant/plant_store.hpp"

#include "db/json_text.hpp"
#include "db/plant/plant_rows.hpp"
#include "db/sql_text.hpp"
#include "db/statement.hpp"

namespace pulseline::db {
namespace {

constexpr const char* kRevision = "SELECT COALESCE(MAX(revision), 0) FROM plant";
constexpr const char* kReadGrid = "SELECT grid FROM halls WHERE position = :position";
// Later tables refer to earlier ones.
constexpr const char* kTables[] = {"plant",         "halls",    "nodes",        "edges",
                                   "vehicle_types", "markers",  "transmitters", "reflectors",
                                   "areas",         "stations", "vehicles",     "loads"};

template <class Row, class T>
void write_all(soci::session& sql, const std::vector<T>& elements) {
    Row row;
    Statement insert(sql, insert_into(Row::kTable, Row::kColumns), row.fields());
    for (const T& element : elements) {
        row.set(element);
        insert.run();
        ++row.position;
    }
}

void write_halls(soci::session& sql, const std::vector<plant::Hall>& halls) {
    HallRow row;
    soci::blob cells(sql);
    const std::string columns = std::string(HallRow::kColumns) + ", grid";
    Statement insert(sql, insert_into(HallRow::kTable, columns),
                     std::tuple_cat(row.fields(), std::tie(cells)));
    for (const plant::Hall& hall : halls) {
        row.set(hall);
        cells.trim(0);
        if (!hall.grid.occupied.empty()) {
            cells.append(reinterpret_cast<const char*>(hall.grid.occupied.data()),
                         hall.grid.occupied.size());
        }
        insert.run();
        ++row.position;
    }
}

template <class Row, class T>
void read_all(soci::session& sql, std::vector<T>& elements) {
    Row row;
    Statement select(
        sql, std::string("SELECT ") + Row::kColumns + " FROM " + Row::kTable + " ORDER BY position",
        std::tuple<>(), row.fields());
    for (select.start(); select.fetch();) elements.push_back(row.get());
}

void read_grids(soci::session& sql, std::vector<plant::Hall>& halls) {
    std::int64_t position = 0;
    soci::blob cells(sql);
    Statement select(sql, kReadGrid, std::tie(position), std::tie(cells));
    for (plant::Hall& hall : halls) {
        select.run();
        auto& occupied = hall.grid.occupied;
        occupied.resize(cells.get_len());
        if (!occupied.empty()) {
            cells.read(0, reinterpret_cast<char*>(occupied.data()), occupied.size());
        }
        if (occupied.size() != static_cast<std::size_t>(hall.grid.width) *
                                   static_cast<std::size_t>(hall.grid.height)) {
            throw Error(Error::Kind::kBadValue,
                        "The database holds a damaged grid; import the plant again.");
        }
        ++position;
    }
}

std::optional<plant::Plant> read_plant(soci::session& sql) {
    PlantRow row;
    Statement head(sql, std::string("SELECT ") + PlantRow::kColumns + " FROM plant", std::tuple<>(),
                   row.fields());
    if (!head.run()) return std::nullopt;
    plant::Plant plant;
    plant.id = row.id;
    plant.name = row.name;
    plant.names = names_from_json(row.names);
    plant.revision = row.revision;
    plant.routing = row.routing;
    read_all<HallRow>(sql, plant.halls);
    read_grids(sql, plant.halls);
    read_all<NodeRow>(sql, plant.nodes);
    read_all<EdgeRow>(sql, plant.edges);
    read_all<VehicleTypeRow>(sql, plant.vehicle_types);
    read_all<MarkerRow>(sql, plant.markers);
    read_all<TransmitterRow>(sql, plant.transmitters);
    read_all<ReflectorRow>(sql, plant.reflectors);
    read_all<AreaRow>(sql, plant.areas);
    read_all<StationRow>(sql, plant.stations);
    read_all<PlantVehicleRow>(sql, plant.vehicles);
    read_all<LoadRow>(sql, plant.loads);
    return plant;
}

}  // namespace

std::optional<plant::Plant> PlantStore::load() {
    return reading(database_.path(), [&] { return read_plant(database_.sql()); });
}

std::optional<plant::Plant> load_plant(ReadOnly& connection) {
    return reading(connection.path(), [&] {
        soci::transaction snapshot(connection.sql());  // one state, though the server may import
        return read_plant(connection.sql());
    });
}

void PlantStore::clear() {
    for (auto table = std::rbegin(kTables); table != std::rend(kTables); ++table) {
        database_.sql() << std::string("DELETE FROM ") + *table;
    }
}

std::int64_t PlantStore::import(const plant::Plant& plant) {
    std::int64_t revision = 0;
    database_.transaction([&] {
        soci::session& sql = database_.sql();
        sql << kRevision, soci::into(revision);
        revision = revision == 0 ? plant.revision : revision + 1;
        clear();
        PlantRow row;
        row.id = plant.id;
        row.name = plant.name;
        row.names = names_to_json(plant.names);
        row.revision = revision;
        row.routing = plant.routing;
        Statement(sql, insert_into(PlantRow::kTable, PlantRow::kColumns), row.fields()).run();
        write_halls(sql, plant.halls);
        write_all<NodeRow>(sql, plant.nodes);
        write_all<EdgeRow>(sql, plant.edges);
        write_all<VehicleTypeRow>(sql, plant.vehicle_types);
        write_all<MarkerRow>(sql, plant.markers);
        write_all<TransmitterRow>(sql, plant.transmitters);
        write_all<ReflectorRow>(sql, plant.reflectors);
        write_all<AreaRow>(sql, plant.areas);
        write_all<StationRow>(sql, plant.stations);
        write_all<PlantVehicleRow>(sql, plant.vehicles);
        write_all<LoadRow>(sql, plant.loads);
    });
    return revision;
}

}  // namespace pulseline::db
