#include "server/agent/truth_log.hpp"

#include <utility>

#include "api/json/object_reader.hpp"

namespace pulseline::agent {
namespace {

/// Empty: it cannot be written.
std::optional<std::ofstream> append_to(const std::string& path) {
    bool torn = false;  // the last line was cut off by a kill
    {
        std::ifstream old(path, std::ios::binary | std::ios::ate);
        if (old && old.tellg() > 0) {
            old.seekg(-1, std::ios::end);
            torn = old.get() != '\n';
        }
    }
    std::ofstream file(path, std::ios::app | std::ios::binary);
    if (!file) return std::nullopt;
    if (torn) file << '\n';
    return file;
}

json::Json encode(const BelievedPose& believed) {
    return {{"x_m", believed.pose.x_m},
            {"y_m", believed.pose.y_m},
            {"heading_rad", believed.pose.heading_rad},
            {"sigma_m", believed.sigma_m},
            {"sigma_rad", believed.sigma_rad}};
}

}  // namespace

Result<TruthLog> TruthLog::open(const std::string& path) {
    auto file = append_to(path);
    if (file) return TruthLog(std::move(*file));
    return fail(Errc::kUnavailable, "truth_log_unwritable",
                "cannot write the truth log " + path + "; check the folder and its rights");
}

Result<BeliefLog> BeliefLog::open(const std::string& path) {
    auto file = append_to(path);
    if (file) return BeliefLog(std::move(*file));
    return fail(Errc::kUnavailable, "belief_log_unwritable",
                "cannot write --belief-log " + path + "; check the folder and its rights");
}

void BeliefLog::write(const BeliefLine& line, std::int64_t t_ms) {
    const json::Json object{{"t_ms", t_ms},
                            {"vehicle", line.vehicle},
                            {"believed", encode(line.believed)},
                            {"moving", line.moving},
                            {"order_id", line.order_id},
                            {"last_node_seq", line.last_node_seq},
                            {"base_end_seq", line.base_end_seq},
                            {"cycle", line.cycle}};
    file_ << object.dump() + "\n" << std::flush;
}

void TruthLog::write(const TruthLine& line, std::int64_t t_ms) {
    json::Json object{{"t_ms", t_ms},
                      {"vehicle", line.vehicle},
                      {"x_m", line.pose.x_m},
                      {"y_m", line.pose.y_m},
                      {"heading_rad", line.pose.heading_rad},
                      {"believed", encode(line.believed)},
                      {"moving", line.moving},
                      {"order_id", line.order_id},
                      {"last_node_seq", line.last_node_seq},
                      {"base_end_seq", line.base_end_seq}};
    if (line.cycle) object["cycle"] = *line.cycle;
    file_ << object.dump() + "\n" << std::flush;
}

std::optional<geometry::Pose2> last_true_pose(const std::string& path, const std::string& vehicle) {
    std::ifstream file(path, std::ios::binary);
    const std::string mine = "\"vehicle\":" + json::Json(vehicle).dump();
    std::string last;
    for (std::string line; std::getline(file, line);) {
        if (!line.empty() && line.back() == '}' && line.find(mine) != std::string::npos) {
            last = std::move(line);
        }
    }
    if (last.empty()) return std::nullopt;
    const auto parsed = json::parse_json(last);
    if (!parsed) return std::nullopt;
    json::FieldErrors errors;
    json::ObjectReader in(*parsed, "", errors);
    const geometry::Pose2 pose{in.number("x_m"), in.number("y_m"), in.number("heading_rad")};
    if (!errors.empty()) return std::nullopt;
    return pose;
}

}  // namespace pulseline::agent
