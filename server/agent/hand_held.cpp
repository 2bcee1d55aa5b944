#include "server/agent/hand_held.hpp"

#include <algorithm>

#include "api/json/object_reader.hpp"
#include "api/json/parse.hpp"

namespace pulseline::agent {
namespace {

using json::Json;

constexpr json::NumberLimits kSpeed{-10, 10};

Json refused(const Error& error) {
    return {{"ok", false}, {"reason", error.reason.code}, {"why", error.what}};
}

Json told(const Vehicle& vehicle) {
    Json told = {{"ok", true},
                 {"vehicle", vehicle.plant_vehicle().manufacturer + "/" +
                                 vehicle.plant_vehicle().serial_number},
                 {"operating_mode", vehicle.in_hand() ? "MANUAL" : "AUTOMATIC"},
                 {"standing", vehicle.standing()}};
    // Before anybody has said where it stands it does not know.
    if (!vehicle.knows_pose()) return told;
    const auto& pose = vehicle.believed_pose();
    told["pose"] = {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"heading_rad", pose.heading_rad}};
    return told;
}

Result<Vehicle*> vehicle_of(const std::vector<Vehicle*>& vehicles, const std::string& name) {
    if (name.empty() && vehicles.size() == 1) return vehicles.front();
    const auto found = std::ranges::find_if(vehicles, [&](const Vehicle* vehicle) {
        const auto& known = vehicle->plant_vehicle();
        return known.manufacturer + "/" + known.serial_number == name;
    });
    if (found != vehicles.end()) return *found;
    return fail(Errc::kNotFound, "unknown_vehicle",
                "Name one of this agent's vehicles in \"vehicle\", as MAKER/SERIAL.");
}

Result<Json> act(const std::vector<Vehicle*>& vehicles, const std::string& line) {
    const auto parsed = json::parse_json(line);
    if (!parsed) return fail(parsed.error());
    json::FieldErrors errors;
    json::ObjectReader in(*parsed, "", errors);
    const std::string what = in.text("do", {1, 16});
    const std::string name = in.text_or("vehicle", "", {0, 300});
    kinematics::Twist twist;
    if (what == "drive") {
        twist = {in.number_or("vx_mps", 0, kSpeed), in.number_or("vy_mps", 0, kSpeed),
                 in.number_or("turn_radps", 0, kSpeed)};
    }
    in.refuse_unknown();
    if (const Status status = errors.status(); !status) return fail(status.error());
    const auto vehicle = vehicle_of(vehicles, name);
    if (!vehicle) return fail(vehicle.error());
    Status done;
    if (what == "take") {
        (*vehicle)->take_by_hand();
    } else if (what == "drive") {
        done = (*vehicle)->drive_by_hand(twist);
    } else if (what == "give_back") {
        done = (*vehicle)->give_back();
    } else if (what != "where") {
        return fail(Errc::kInvalid, "not_one_of", "\"do\" must be take, drive, give_back or where.",
                    "/do");
    }
    if (!done) return fail(done.error());
    return told(**vehicle);
}

}  // namespace

std::string answer_hand_held(const std::vector<Vehicle*>& vehicles, const std::string& line) {
    const auto answer = act(vehicles, line);
    return (answer ? *answer : refused(answer.error())).dump() + "\n";
}

}  // namespace pulseline::agent
