#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/access/access.hpp"
#include "core/base/result.hpp"
#include "core/fleet/state/ports.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::server::cli {

/// An open, locked database with its stores. Throws db::Error when it breaks under way.
class Storage {
public:
    virtual ~Storage() = default;
    virtual fleet::Store& fleet() = 0;
    virtual fleet::History& history() = 0;
    /// The newest so many events, and none older than that.
    virtual void keep_events(std::int64_t newest, Duration age) = 0;
    virtual access::Store& access() = 0;
    virtual std::optional<plant::Plant> plant() = 0;  // nothing: none was imported
    /// Gives the revision the plant got. REQUIRES: validate() found no fault.
    virtual std::int64_t import_plant(const plant::Plant& plant) = 0;
};

/// Fails when another process holds the file, when it cannot be written or is no database of ours.
Result<std::unique_ptr<Storage>> open_storage(const std::string& path);

}  // namespace pulseline::server::cli
