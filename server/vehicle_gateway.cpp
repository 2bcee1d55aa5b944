#include "server/vehicle_gateway.hpp"

#include <algorithm>
#include <functional>

#include "api/http/problem.hpp"
#include "api/vehicle/connection.hpp"
#include "api/vehicle/frame.hpp"
#include "api/vehicle/instant_actions.hpp"
#include "api/vehicle/order.hpp"
#include "core/base/crash_point.hpp"
#include "core/fleet/vehicle/state_filter.hpp"
#include "server/await.hpp"
#include "server/vehicle_frames.hpp"

namespace pulseline::server {
namespace {

constexpr const char* kSubprotocol = "vda5050.v2.json";
constexpr auto kTakeoverWindow = std::chrono::seconds(60);
constexpr std::size_t kMostTakeovers = 3;
// Silence is counted in seconds, so the fleet need not hear of every frame.
constexpr auto kTellHeard = std::chrono::milliseconds(500);
constexpr auto kShowRefused = std::chrono::seconds(60);
constexpr auto kLogRefusedEvery = std::chrono::seconds(10);
constexpr std::size_t kMostFieldLogged = 128;

bool offers_subprotocol(const std::string& header) {
    std::size_t at = 0;
    while (at <= header.size()) {
        const auto comma = std::min(header.find(',', at), header.size());
        auto part = header.substr(at, comma - at);
        part.erase(0, part.find_first_not_of(' '));
        part.erase(part.find_last_not_of(' ') + 1);
        if (part == kSubprotocol) return true;
        at = comma + 1;
    }
    return false;
}

std::chrono::steady_clock::time_point next_beat(const plant::VehicleId& id,
                                                std::chrono::steady_clock::time_point now,
                                                Duration every) {
    const auto since_start = std::chrono::duration_cast<Duration>(now.time_since_epoch());
    return now + fleet::to_next_beat(since_start, every, std::hash<std::string>{}(id.str()));
}

struct Path {
    std::string manufacturer;
    std::string serial;
};
std::optional<Path> parse_path(const std::string& path) {
    const std::string_view rest =
        std::string_view(path).substr(std::string_view("/vehicles/").size());
    const auto slash = rest.find('/');
    if (slash == std::string_view::npos || rest.find('/', slash + 1) != std::string_view::npos) {
        return std::nullopt;
    }
    const auto manufacturer = api::percent_decoded(rest.substr(0, slash), false);
    const auto serial = api::percent_decoded(rest.substr(slash + 1), false);
    if (!manufacturer || !serial || manufacturer->empty() || serial->empty()) return std::nullopt;
    return Path{*manufacturer, *serial};
}

tl::unexpected<api::Response> refuse(const api::Request& request, int status, Errc code,
                                     const char* reason, std::string what) {
    return tl::unexpected<api::Response>(
        api::problem(status, Error{code, {reason, {}}, std::move(what), {}}, request));
}

}  // namespace

net::awaitable<tl::expected<plant::VehicleId, api::Response>> VehicleGateway::admit(
    api::Request& request, bool upgrade) {
    const auto path = parse_path(request.path);
    if (!path) {
        co_return refuse(request, 404, Errc::kNotFound, "not_found",
                         "Vehicles connect to /vehicles/{manufacturer}/{serialNumber}.");
    }
    request.identity = ports_.access.identify(request.headers, ports_.clock.now());
    const auto identity = ports_.access.vehicle_for_token(request.header("authorization"),
                                                          path->manufacturer, path->serial);
    if (!identity) {
        if (request.identity.kind == access::Identity::Kind::kAnonymous) {
            co_return refuse(request, 401, Errc::kForbidden, "not_signed_in",
                             "Send the vehicle's token as Authorization: Bearer; `pulseline token "
                             "create --vehicle MAKER/SERIAL` makes one.");
        }
        co_return refuse(request, 403, Errc::kForbidden, "not_this_vehicle",
                         "This token belongs to somebody else; use the token of " +
                             path->manufacturer + "/" + path->serial + ".");
    }
    request.identity = *identity;
    const auto* vehicle = plant::find_vehicle(ports_.plant, path->manufacturer, path->serial);
    if (!vehicle) {
        co_return refuse(request, 404, Errc::kNotFound, "unknown_vehicle",
                         "The plant has no vehicle " + path->manufacturer + "/" + path->serial +
                             "; add it to the plant model.");
    }
    if (!upgrade) {
        co_return refuse(request, 426, Errc::kInvalid, "upgrade_required",
                         "This address speaks WebSocket only.");
    }
    if (!offers_subprotocol(request.header("sec-websocket-protocol"))) {
        co_return refuse(request, 400, Errc::kInvalid, "subprotocol_missing",
                         "Offer the WebSocket subprotocol vda5050.v2.json.");
    }
    const auto id = vehicle->id;
    const std::function<void(Done<bool>)> begin = [this, id](Done<bool> done) {
        ports_.runtime.read(
            [id](fleet::Fleet& fleet, Time) { return fleet.connection_refused(id); },
            std::move(done));
    };
    const auto refused = co_await callback<bool>(begin);
    if (!refused) co_return tl::unexpected<api::Response>(api::unavailable(request));
    if (*refused) {
        co_return refuse(request, 409, Errc::kConflict, "identity_conflict",
                         "Two programs claim to be " + id.str() +
                             ". Stop one of them, then let a person resume the vehicle.");
    }
    co_return id;
}

void VehicleGateway::opened(const plant::VehicleId& id,
                            const std::shared_ptr<VehicleSocket>& socket) {
    Row& row = rows_[id];
    const auto now = Steady::now();
    if (row.socket) {
        ++ports_.metrics.vehicle_takeovers;
        row.takeovers.push_back(now);
        while (now - row.takeovers.front() > kTakeoverWindow) row.takeovers.pop_front();
        row.socket->close(4409, "replaced by a newer connection");
        log::warn("vehicle_taken_over", {{"vehicle", id.str()}});
        if (row.takeovers.size() >= kMostTakeovers) {
            row.takeovers.clear();
            row.socket = nullptr;
            --ports_.metrics.vehicle_sockets;
            socket->close(4409, "identity conflict");
            log::error("vehicle_identity_conflict", {{"vehicle", id.str()}});
            ports_.runtime.input(id, [id](fleet::Fleet& fleet, Time at) {
                fleet.vehicle_identity_conflict(id, at);
                fleet.vehicle_disconnected(id, at);
            });
            return;
        }
    } else {
        ++ports_.metrics.vehicle_sockets;
    }
    row.socket = socket;
    row.malformed_in_a_row = 0;
    row.said_offline = false;
    row.tell_heard_at = next_beat(id, now, kTellHeard);
    row.passed.reset();
    log::info("vehicle_connected", {{"vehicle", id.str()}});
    ports_.runtime.input(id,
                         [id](fleet::Fleet& fleet, Time at) { fleet.vehicle_connected(id, at); });
}

VehicleGateway::Row* VehicleGateway::current(const plant::VehicleId& id,
                                             const VehicleSocket* socket) {
    const auto found = rows_.find(id);
    return found != rows_.end() && found->second.socket.get() == socket ? &found->second : nullptr;
}

void VehicleGateway::closed(const plant::VehicleId& id, const VehicleSocket* socket) {
    Row* row = current(id, socket);
    if (!row) return;  // a newer one took its place
    row->socket = nullptr;
    --ports_.metrics.vehicle_sockets;
    if (!row->said_offline) play_last_will(id, *row);
    log::info("vehicle_disconnected", {{"vehicle", id.str()}});
    ports_.runtime.input(
        id, [id](fleet::Fleet& fleet, Time at) { fleet.vehicle_disconnected(id, at); });
}

void VehicleGateway::heard(const plant::VehicleId& id, const VehicleSocket* socket) {
    Row* row = current(id, socket);
    const auto now = Steady::now();
    if (!row || now < row->tell_heard_at) return;
    row->tell_heard_at = next_beat(id, now, kTellHeard);
    ports_.runtime.input(id, [id](fleet::Fleet& fleet, Time at) { fleet.vehicle_heard(id, at); });
}

void VehicleGateway::text(const plant::VehicleId& id, const VehicleSocket* socket,
                          std::string_view frame) {
    Row* row = current(id, socket);
    if (!row) return;
    ++ports_.metrics.vehicle_messages_in;
    heard(id, socket);
    switch (budget(*row).message(frame.size(), Steady::now())) {
        case LinkBudget::Verdict::kTake:
            row->withheld.reset();  // a newer one has come
            return take_text(id, *row, frame);
        case LinkBudget::Verdict::kWithhold:
            ++ports_.metrics.vehicle_messages_withheld;
            row->withheld = std::string(frame);
            if (row->budget->excess_begins()) too_many(id, *row);
            return;
        case LinkBudget::Verdict::kClose:
            row->withheld.reset();
            row->socket->close(1008, "too many messages");
    }
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
    if (auto* state = std::get_if<fleet::StateMessage>(&decoded->message)) {
        if (state->pose) {
            ports_.poses.put(id, *state->pose, state->velocity_mps, ports_.clock.now());
        }
        pass_state(id, *row, std::move(*state));
    } else if (const auto* seen = std::get_if<fleet::VisualizationMessage>(&decoded->message)) {
        if (seen->position_initialized) {
            ports_.poses.put(id, seen->pose, seen->velocity_mps, ports_.clock.now());
        }
    } else if (auto* factsheet = std::get_if<fleet::Factsheet>(&decoded->message)) {
        row->factsheet = std::move(*factsheet);
        hand_over_factsheet(id, *row);
    } else if (const auto* link = std::get_if<fleet::ConnectionState>(&decoded->message)) {
        row->said_offline = *link == fleet::ConnectionState::kOffline;
    }
}

void VehicleGateway::pass_state(const plant::VehicleId& id, Row& row, fleet::StateMessage state) {
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
        std::optional<fleet::StateMessage> newest;
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
    row.refused = fleet::VehicleError{
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
    row.refused = fleet::VehicleError{
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

void VehicleGateway::send(const std::vector<fleet::VehicleMessage>& messages) {
    for (const auto& message : messages) {
        const auto found = rows_.find(message.vehicle);
        if (found == rows_.end() || !found->second.socket) continue;
        Row& row = found->second;
        const auto socket = row.socket;  // close() inside send() must not end it under us
        using vda5050::Topic;
        const auto put = [&](Topic topic, const std::string& payload) {
            ++ports_.metrics.vehicle_messages_out;
            socket->send(vda5050::encode_frame(topic, false, payload));
        };
        // One that cannot be written down is not sent; the fleet asks again, and the rest goes.
        const auto guarded_send = [&](auto write) {
            guarded("send", [&] {
                try {
                    write();
                } catch (const vda5050::NotFinite& broken) {
                    not_sent(message.vehicle, row, broken.what());
                }
            });
        };
        guarded_send([&] {
            if (!message.order) return;
            const auto header = next_header(message.vehicle, row, Topic::kOrder);
            put(Topic::kOrder, vda5050::encode_order(*message.order, header));
        });
        guarded_send([&] {
            if (!message.instant_actions) return;
            const auto header = next_header(message.vehicle, row, Topic::kInstantActions);
            put(Topic::kInstantActions,
                vda5050::encode_instant_actions(*message.instant_actions, header));
        });
        crash_point(CrashPoint::kReleaseBetweenMessages);
    }
}

void VehicleGateway::not_sent(const plant::VehicleId& id, Row& row, const char* why) {
    log::error("vehicle_message_not_sent", {{"vehicle", id.str()}, {"what", why}});
    // The fleet sends again until the vehicle has taken it: people need not hear of each time.
    if (row.told_not_sent && Steady::now() - *row.told_not_sent < kShowRefused) return;
    row.told_not_sent = Steady::now();
    const fleet::VehicleError error{
        "messageNotSent", false, std::string("A message to the vehicle was left out: ") + why, {}};
    ports_.runtime.input(id, [id, error](fleet::Fleet& fleet, Time at) {
        fleet.vehicle_message_refused(id, error, at);
    });
}

vda5050::Header VehicleGateway::next_header(const plant::VehicleId& id, Row& row,
                                            vda5050::Topic topic) {
    if (!row.headers) {
        const auto* vehicle = plant::find_vehicle(ports_.plant, id);
        row.headers.emplace(vehicle->manufacturer, vehicle->serial_number);
    }
    return row.headers->next(topic, ports_.clock.now());
}

void VehicleGateway::introduce_all() {
    for (auto& [id, row] : rows_) {
        row.passed.reset();
        if (!row.socket) {
            ports_.runtime.input(id, [id = id](fleet::Fleet& fleet, Time at) {
                fleet.vehicle_disconnected(id, at);
            });
            continue;
        }
        ports_.runtime.input(
            id, [id = id](fleet::Fleet& fleet, Time at) { fleet.vehicle_connected(id, at); });
        if (row.factsheet) hand_over_factsheet(id, row);
        // One that was refused with the old fleet still waits, and would keep all later ones back.
        hand_over_state(id, row);
    }
}

void VehicleGateway::play_last_will(const plant::VehicleId& id, Row& row) {
    row.retained[vda5050::Topic::kConnection] =
        vda5050::encode_connection(fleet::ConnectionState::kConnectionBroken,
                                   next_header(id, row, vda5050::Topic::kConnection));
}

std::string VehicleGateway::retained(const plant::VehicleId& id, vda5050::Topic topic) const {
    const auto row = rows_.find(id);
    if (row == rows_.end()) return {};
    const auto found = row->second.retained.find(topic);
    return found == row->second.retained.end() ? std::string() : found->second;
}

}  // namespace pulseline::server
