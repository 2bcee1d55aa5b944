#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "core/geometry/pose2.hpp"

namespace pulseline::agent {

/// Where a vehicle knows itself to be.
struct BelievedPose {
    geometry::Pose2 pose;
    double sigma_m = 0;  // the worse direction
    double sigma_rad = 0;
};

/// One line of the true movement of a vehicle, for comparison; never sent over the link.
struct TruthLine {
    std::string vehicle;
    geometry::Pose2 pose;
    bool moving = false;
    std::string order_id;
    std::int64_t last_node_seq = 0;
    std::int64_t base_end_seq = 0;
    BelievedPose believed{};
    std::optional<std::uint32_t> cycle = {};  // of set points, of a machine behind its controller
};

/// Appends JSON lines {t_ms, vehicle, x_m, y_m, heading_rad, believed {x_m, y_m, heading_rad,
/// sigma_m, sigma_rad}, moving, order_id, last_node_seq, base_end_seq} and cycle where there is
/// one, each flushed, so that a killed process leaves all it knew.
class TruthLog {
public:
    [[nodiscard]] static Result<TruthLog> open(const std::string& path);
    void write(const TruthLine& line, std::int64_t t_ms);

private:
    explicit TruthLog(std::ofstream file) : file_(std::move(file)) {}
    std::ofstream file_;
};

/// What a vehicle's program knows of itself.
struct BeliefLine {
    std::string vehicle;
    BelievedPose believed{};
    bool moving = false;
    std::string order_id;
    std::int64_t last_node_seq = 0;
    std::int64_t base_end_seq = 0;
    std::uint32_t cycle = 0;  // of its set points, the newest that was answered
};

/// The same without the truth, which the program of a vehicle does not know: JSON lines {t_ms,
/// vehicle, believed, moving, order_id, last_node_seq, base_end_seq, cycle}. By its cycle a line
/// finds the machine's own, whatever clocks and computers do.
class BeliefLog {
public:
    [[nodiscard]] static Result<BeliefLog> open(const std::string& path);
    void write(const BeliefLine& line, std::int64_t t_ms);

private:
    explicit BeliefLog(std::ofstream file) : file_(std::move(file)) {}
    std::ofstream file_;
};

/// Where the log last saw a vehicle: the machine stays where it was when its program ended.
std::optional<geometry::Pose2> last_true_pose(const std::string& path, const std::string& vehicle);

}  // namespace pulseline::agent
