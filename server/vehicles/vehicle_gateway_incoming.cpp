#include <algorithm>
#include <functional>
#include <mutex>
#include <utility>
#include <variant>

#include "api/vda5050/frame.hpp"
#include "core/fleet/vehicle/state_filter.hpp"
#include "server/vehicles/vehicle_frames.hpp"
#include "server/vehicles/vehicle_gateway.hpp"

/// What comes from vehicles: how much of it is taken, what of it the fleet is told, and what
/// becomes of what nobody can read.
namespace pulseline::server {
namespace {

constexpr auto kLogRefusedEvery = std::chrono::seconds(10);
constexpr std::size_t kMostFieldLogged = 128;

}  // namespace

VehicleGateway::Steady::time_point VehicleGateway::next_beat(const plant::VehicleId& id,
                                                             Steady::time_point now,
                                                             Duration every) {
    const auto since_start = std::chrono::duration_cast<Duration>(now.time_since_epoch());
    return now + fleet::to_next_beat(since_start, every, std::hash<std::string>{}(id.str()));
}

LinkBudget& VehicleGateway::budget(Row& row) {
    if (!row.budget) row.budget.emplace(ports_.limits);
    return *row.budget;
}

void VehicleGateway::take_withheld(const plant::VehicleId& id, const VehicleSocket* socket) {
    Row* row = current(id, socket);
    if (!row || !row->withheld) return;
    if (!budget(*row).again(row->withheld->size(), Steady::now())) return;
    const std::string frame = *std::exchange(row->withheld, std::nullopt);
    take_text(id, *row, frame);
}

void VehicleGateway::take_text(const plant::VehicleId& id, Row& at, std::string_view frame) {
    Row* const row = &at;
    auto decoded = read_vehicle_frame(frame, *plant::find_vehicle(ports_.plant, id));
    if (!decoded) {
        malformed(id, *row, decoded.error());
        return;
    }
    row->malformed_in_a_row = 0;
    if (!decoded->retained.empty()) row->retained[decoded->topic] = decoded->retained;
    if (auto* state = std::get_if<vda5050::StateMessage>(&decoded->message)) {
        if (state->pose) {
            ports_.poses.put(id, *state->pose, state->velocity_mps, ports_.clock.now());
        }
        pass_state(id, *row, std::move(*state));
    } else if (const auto* seen = std::get_if<vda5050::VisualizationMessage>(&decoded->message)) {
        if (seen->position_initialized) {
            ports_.poses.put(id, seen->pose, seen->velocity_mps, ports_.clock.now());
        }
    } else if (auto* factsheet = std::get_if<vda5050::Factsheet>(&decoded->message)) {
        row->factsheet = std::move(*factsheet);
        hand_over_factsheet(id, *row);
    } else if (const auto* hand = std::get_if<vda5050::HandAnswerFrame>(&decoded->message)) {
        pass_hand_answer(id, *hand);
    } else if (const auto* link = std::get_if<vda5050::ConnectionState>(&decoded->message)) {
        row->said_offline = *link == vda5050::ConnectionState::kOffline;
    }
}

void VehicleGateway::pass_state(const plant::VehicleId& id, Row& row, vda5050::StateMessage state) {
    if (row.refused && Steady::now() - row.refused_at < kShowRefused) {
        state.errors.push_back(*row.refused);
    }
    const auto now = Steady::now();
    if (row.passed && now < row.pass_at && !fleet::may_change_decision(*row.passed, state)) return;
    row.passed = state;
    row.pass_at = next_beat(id, now, fleet::seen_every(state));
    // A state says all there is to say: one that waits is overtaken by the next.
    bool waits = false;
    {
        const std::lock_guard lock(row.state->mutex);
        waits = row.state->waiting.has_value();
        row.state->waiting = std::move(state);
    }
    if (!waits) hand_over_state(id, row);
}

void VehicleGateway::hand_over_factsheet(const plant::VehicleId& id, const Row& row) {
    ports_.runtime.input(id, [id, sheet = *row.factsheet](fleet::Fleet& fleet, Time at) {
        fleet.vehicle_factsheet(id, sheet, at);
    });
}

void VehicleGateway::hand_over_state(const plant::VehicleId& id, const Row& row) {
    ports_.runtime.input(id, [id, slot = row.state](fleet::Fleet& fleet, Time at) {
        std::optional<vda5050::StateMessage> newest;
        {
            const std::lock_guard inner(slot->mutex);
            newest = std::exchange(slot->waiting, std::nullopt);
        }
        if (newest) fleet.vehicle_state(id, *newest, at);
    });
}

/// Told once: in the vehicle's errors for a minute, and as an event.
void VehicleGateway::too_many(const plant::VehicleId& id, Row& row) {
    log::warn("vehicle_says_too_much", {{"vehicle", id.str()}});
    row.refused = vda5050::VehicleError{
        "messageRefused",
        false,
        "The vehicle sends more messages than one link may; only the newest are taken.",
        {{"field", ""}, {"code", "too_many_messages"}}};
    row.refused_at = Steady::now();
    ports_.runtime.input(id, [id, refused = *row.refused](fleet::Fleet& fleet, Time at) {
        fleet.vehicle_message_refused(id, refused, at);
    });
}

void VehicleGateway::malformed(const plant::VehicleId& id, Row& row, const Error& error) {
    ++ports_.metrics.vehicle_messages_malformed;
    ++row.malformed_in_a_row;
    const auto now = Steady::now();
    if (now - row.logged >= kLogRefusedEvery) {
        row.logged = now;
        log::warn("vehicle_message_refused",
                  {{"vehicle", id.str()},
                   {"field", error.field.substr(0, kMostFieldLogged)},
                   {"code", error.reason.code},
                   {"what", error.what},
                   {"not_logged", std::to_string(std::exchange(row.not_logged, 0))}});
    } else {
        ++row.not_logged;
    }
    const bool fresh = !row.refused || row.refused->description != error.what ||
                       Steady::now() - row.refused_at >= kShowRefused;
    row.refused = vda5050::VehicleError{
        "messageRefused", false, error.what, {{"field", error.field}, {"code", error.reason.code}}};
    row.refused_at = Steady::now();
    const bool bearable = budget(row).malformed(now);
    if (!bearable || row.malformed_in_a_row >= ports_.limits.vehicle_malformed_in_a_row) {
        row.socket->close(1008, "too many malformed messages");
    } else if (fresh) {
        ports_.runtime.input(id, [id, refused = *row.refused](fleet::Fleet& fleet, Time at) {
            fleet.vehicle_message_refused(id, refused, at);
        });
    }
}

void VehicleGateway::binary(const plant::VehicleId& id, const VehicleSocket* socket,
                            std::string_view frame) {
    Row* row = current(id, socket);
    if (!row) return;
    ++ports_.metrics.vehicle_messages_in;
    heard(id, socket);
    if (!budget(*row).picture(Steady::now())) {
        ++ports_.metrics.vehicle_messages_withheld;  // the next one is newer
        return;
    }
    const auto picture = vda5050::decode_camera_frame(frame);
    if (!picture) {
        malformed(id, *row, picture.error());
        return;
    }
    const auto* vehicle = plant::find_vehicle(ports_.plant, id);
    const auto* type = plant::find_vehicle_type(ports_.plant, vehicle->type);
    // Only cameras of the plant are kept, else a vehicle could fill the memory with names.
    const bool known = type && std::ranges::any_of(type->cameras, [&](const auto& camera) {
                           return camera.name == picture->camera;
                       });
    if (!known) {
        malformed(id, *row,
                  Error{Errc::kInvalid,
                        {"unknown_camera", {}},
                        "The vehicle's type has no camera of that name; add it to the plant.",
                        "/camera"});
        return;
    }
    row->malformed_in_a_row = 0;
    ports_.images.put(id, picture->camera,
                      {picture->mime, std::string(picture->bytes), ports_.clock.now()});
}

}  // namespace pulseline::server
