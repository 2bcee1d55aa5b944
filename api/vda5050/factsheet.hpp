#pragma once

#include <string>
#include <vector>

#include "api/vda5050/header.hpp"
#include "core/plant/plant.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::vda5050 {

/// What a vehicle of ours says about itself.
struct FactsheetSource {
    const plant::VehicleType* type = nullptr;
    bool has_map = false;    // of its hall, for its laser scanners
    double time_factor = 1;  // speeds times it, accelerations times its square
    std::vector<std::string> node_actions;
    std::vector<std::string> edge_actions;
    std::vector<std::string> instant_actions;
    double min_state_interval_s = 0.05;
    double state_interval_s = 1;
    double visualization_interval_s = 0.1;
};

std::string encode_factsheet(const FactsheetSource& source, const Header& header);
/// `json` of the result is the payload as it is kept.
[[nodiscard]] Result<Factsheet> decode_factsheet(const Json& payload);

}  // namespace pulseline::vda5050
