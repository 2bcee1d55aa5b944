#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "api/events/frames.hpp"

namespace pulseline::server {

/// The newest pose of each vehicle; what came before it is forgotten.
/// Thread safety: none, the network thread owns it.
class PoseTable {
public:
    void put(const plant::VehicleId& vehicle, const geometry::Pose2& pose, double speed_mps,
             Time heard) {
        poses_[vehicle] = {pose, speed_mps, heard, ++version_};
    }
    /// Grows with every pose.
    std::uint64_t version() const { return version_; }

    /// Poses put after the table had `version`, with their age at `now`.
    std::vector<events::PoseSample> since(std::uint64_t version, Time now) const {
        std::vector<events::PoseSample> samples;
        for (const auto& [vehicle, row] : poses_) {
            if (row.version > version) {
                samples.push_back({vehicle, row.pose, row.speed_mps, seconds(now - row.heard)});
            }
        }
        return samples;
    }

private:
    struct Row {
        geometry::Pose2 pose;
        double speed_mps = 0;
        Time heard;
        std::uint64_t version = 0;
    };
    std::map<plant::VehicleId, Row> poses_;
    std::uint64_t version_ = 0;
};

}  // namespace pulseline::server
