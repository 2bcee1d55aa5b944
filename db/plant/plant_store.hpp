#pragma once

#include <optional>

#include "core/plant/plant.hpp"
#include "db/database.hpp"

namespace pulseline::db {

/// The plant as rows of its own tables, grids as blobs. `database` must outlive it.
/// Thread safety: none, as Database.
class PlantStore {
public:
    explicit PlantStore(Database& database) : database_(database) {}

    /// As it was imported, to the last bit; nothing when none was.
    std::optional<plant::Plant> load();
    /// Takes the stored plant's place in one transaction; gives the revision it got: the stored one
    /// + 1, or the plant's own when there was none. REQUIRES: validate() found no fault.
    std::int64_t import(const plant::Plant& plant);

private:
    void clear();

    Database& database_;
};

/// What PlantStore::load() gives, read beside a running server.
std::optional<plant::Plant> load_plant(ReadOnly& connection);

}  // namespace pulseline::db
