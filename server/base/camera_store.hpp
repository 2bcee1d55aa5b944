#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "api/http/wire/contexts.hpp"

namespace pulseline::server {

/// Newest picture of each camera, in memory only. Thread safety: all functions.
class CameraStore : public api::CameraImages {
public:
    void put(const plant::VehicleId& vehicle, const std::string& camera, Image image) {
        const std::lock_guard lock(mutex_);
        images_[{vehicle, camera}] = std::move(image);
    }
    std::optional<Image> newest(const plant::VehicleId& vehicle,
                                const std::string& camera) const override {
        const std::lock_guard lock(mutex_);
        const auto found = images_.find({vehicle, camera});
        return found == images_.end() ? std::nullopt : std::optional(found->second);
    }
    std::optional<Time> taken(const plant::VehicleId& vehicle,
                              const std::string& camera) const override {
        const std::lock_guard lock(mutex_);
        const auto found = images_.find({vehicle, camera});
        return found == images_.end() ? std::nullopt : std::optional(found->second.taken);
    }

private:
    mutable std::mutex mutex_;
    std::map<std::pair<plant::VehicleId, std::string>, Image> images_;
};

}  // namespace pulseline::server
