#include "server/agent/hand_held.hpp"

#include <algorithm>

#include "api/json/object_reader.hpp"
#include "api/json/parse.hpp"

namespace pulseline::agent {
namespace {

using json::Json;

/// The one control beside the vehicles of this agent; nobody there has a name.
const onboard::HandControl kBeside{"beside", ""};

std::string name_of(const Vehicle& vehicle) {
    const auto& known = vehicle.plant_vehicle();
    return known.manufacturer + "/" + known.serial_number;
}

Result<Vehicle*> vehicle_of(const std::vector<Vehicle*>& vehicles, const std::string& name) {
    if (name.empty() && vehicles.size() == 1) return vehicles.front();
    const auto found =
        std::ranges::find(vehicles, name, [](const Vehicle* v) { return name_of(*v); });
    if (found != vehicles.end()) return *found;
    return fail(Errc::kNotFound, "unknown_vehicle",
                "Name one of this agent's vehicles in \"vehicle\", as MAKER/SERIAL.");
}

Result<Json> act(const std::vector<Vehicle*>& vehicles, const std::string& line,
                 Vehicle::Steady::time_point now) {
    const auto parsed = json::parse_json(line);
    if (!parsed) return fail(parsed.error());
    json::FieldErrors errors;
    json::ObjectReader in(*parsed, "", errors);
    const std::string name = in.text_or("vehicle", "", {0, 300});
    const auto command = vda5050::read_hand_command(in);
    in.refuse_unknown();
    if (const Status status = errors.status(); !status) return fail(status.error());
    const auto vehicle = vehicle_of(vehicles, name);
    if (!vehicle) return fail(vehicle.error());
    Json answer = vda5050::hand_answer_json((*vehicle)->hand_held(kBeside, command, now));
    answer["vehicle"] = name_of(**vehicle);
    return answer;
}

}  // namespace

std::string answer_hand_held(const std::vector<Vehicle*>& vehicles, const std::string& line,
                             Vehicle::Steady::time_point now) {
    auto answer = act(vehicles, line, now);
    if (!answer) {
        vda5050::HandAnswer refused;
        refused.refused = answer.error();
        answer = vda5050::hand_answer_json(refused);
    }
    return answer->dump() + "\n";
}

}  // namespace pulseline::agent
