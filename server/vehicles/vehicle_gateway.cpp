#include "server/vehicles/vehicle_gateway.hpp"

#include <algorithm>
#include <functional>

#include "api/http/wire/problem.hpp"
#include "api/vda5050/connection.hpp"
#include "api/vda5050/frame.hpp"
#include "api/vda5050/instant_actions.hpp"
#include "api/vda5050/order.hpp"
#include "core/base/crash_point.hpp"
#include "core/fleet/vehicle/state_filter.hpp"
#include "server/runtime/await.hpp"
#include "server/vehicles/vehicle_frames.hpp"

namespace pulseline::server {
namespace {

constexpr const char* kSubprotocol = "vda5050.v2.json";
constexpr auto kTakeoverWindow = std::chrono::seconds(60);
constexpr std::size_t kMostTakeovers = 3;
// Silence is counted in seconds, so the fleet need not hear of every frame.
constexpr auto kTellHeard = std::chrono::milliseconds(500);

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
        if (request.identity.kind == api::access::Identity::Kind::kAnonymous) {
            co_return refuse(request, 401, Errc::kUnauthenticated, "not_signed_in",
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
    tell_not_connected(id);
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
    const vda5050::VehicleError error{
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
        vda5050::encode_connection(vda5050::ConnectionState::kConnectionBroken,
                                   next_header(id, row, vda5050::Topic::kConnection));
}

std::string VehicleGateway::retained(const plant::VehicleId& id, vda5050::Topic topic) const {
    const auto row = rows_.find(id);
    if (row == rows_.end()) return {};
    const auto found = row->second.retained.find(topic);
    return found == row->second.retained.end() ? std::string() : found->second;
}

}  // namespace pulseline::server
