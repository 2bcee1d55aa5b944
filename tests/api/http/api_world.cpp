#include "tests/api/http/api_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "api/http/wire/problem.hpp"

namespace pulseline::api::testing {
namespace {

constexpr access::HashCost kCheap{1, 8192};

void check_against_spec(const Route& route, const Response& response) {
    const Json* spec = operation(route.operation);
    ASSERT_NE(spec, nullptr) << route.operation;
    const std::string status = std::to_string(response.status);
    ASSERT_TRUE((*spec)["responses"].contains(status))
        << route.operation << " answers " << status << ": " << response.body;
    const Json& described = resolved((*spec)["responses"][status]);
    if (!described.contains("content")) {
        EXPECT_EQ(response.body, "") << route.operation;
        return;
    }
    const std::string media_type = response.content_type.substr(0, response.content_type.find(';'));
    ASSERT_TRUE(described["content"].contains(media_type)) << route.operation << media_type;
    const Json& content = described["content"][media_type];
    if (!content.contains("schema")) return;
    const Json body = Json::parse(response.body, nullptr, false);
    ASSERT_FALSE(body.is_discarded()) << response.body;
    EXPECT_EQ(breach(content["schema"], body), "") << route.operation << " " << status;
}

template <class Row, class Keep>
std::vector<Row> newest_first(const std::vector<Row>& rows, int limit, Keep keep) {
    std::vector<Row> kept;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(kept), keep);
    std::sort(kept.begin(), kept.end(), [](const Row& a, const Row& b) { return b.id < a.id; });
    if (kept.size() > static_cast<std::size_t>(limit)) kept.resize(static_cast<std::size_t>(limit));
    return kept;
}

}  // namespace

std::optional<CameraImages::Image> OneImage::newest(const plant::VehicleId& vehicle,
                                                    const std::string& camera) const {
    if (vehicle.str() != "V1" || camera != "front") return std::nullopt;
    return Image{"image/jpeg", bytes, time_from_ns(1'795'233'036'000'000'000)};
}

std::optional<Time> OneImage::taken(const plant::VehicleId& vehicle,
                                    const std::string& camera) const {
    const auto image = newest(vehicle, camera);
    return image ? std::optional<Time>(image->taken) : std::nullopt;
}

std::vector<fleet::StopRecord> WorldHistory::stops(const fleet::StopQuery& query) {
    return newest_first(store_.stops, query.limit, [&](const fleet::StopRecord& stop) {
        return (query.vehicle.empty() || stop.vehicle == query.vehicle) &&
               (!query.station_number || stop.station_number == *query.station_number) &&
               (query.order.empty() || stop.order == query.order) &&
               (query.before.empty() || stop.id < query.before);
    });
}

std::optional<fleet::StopRecord> WorldHistory::stop(fleet::StopRecordId id) {
    for (const auto& stop : store_.stops) {
        if (stop.id == id) return stop;
    }
    return std::nullopt;
}

std::vector<fleet::JobOrder> WorldHistory::orders(const fleet::OrderQuery& query) {
    std::vector<fleet::JobOrder> all;
    for (const auto& [id, order] : store_.orders) all.push_back(order);
    return newest_first(all, query.limit, [&](const fleet::JobOrder& order) {
        const bool state =
            query.states.empty() ||
            std::find(query.states.begin(), query.states.end(), order.state) != query.states.end();
        return state && order.removed == query.removed &&
               (query.vehicle.empty() || order.assigned_vehicle == query.vehicle) &&
               (query.before.empty() || order.id < query.before);
    });
}

std::optional<fleet::JobOrder> WorldHistory::order(fleet::JobOrderId id) {
    const auto it = store_.orders.find(id);
    return it == store_.orders.end() ? std::nullopt : std::optional(it->second);
}

std::vector<fleet::Event> WorldHistory::unmeasured_stops(const fleet::UnmeasuredQuery& query) {
    std::vector<fleet::Event> events;
    for (auto it = store_.events.rbegin(); it != store_.events.rend(); ++it) {
        if (it->type != "stop.not_measured" || (query.before && it->seq >= *query.before)) continue;
        if (!query.vehicle.empty() && it->vehicle != query.vehicle) continue;
        if (events.size() < static_cast<std::size_t>(query.limit)) events.push_back(*it);
    }
    return events;
}

std::vector<fleet::LoadMove> WorldHistory::load_moves(const fleet::LoadMoveQuery& query) {
    std::vector<fleet::LoadMove> moves;
    for (auto it = store_.load_moves.rbegin(); it != store_.load_moves.rend(); ++it) {
        const auto& [load, move] = *it;
        if (load != query.load || (query.before && move.seq >= *query.before)) continue;
        if (moves.size() < static_cast<std::size_t>(query.limit)) moves.push_back(move);
    }
    return moves;
}

std::vector<fleet::Event> WorldHistory::events_after(std::int64_t seq, int limit) {
    std::vector<fleet::Event> events;
    for (const auto& event : store_.events) {
        if (event.seq > seq && events.size() < static_cast<std::size_t>(limit)) {
            events.push_back(event);
        }
    }
    return events;
}

fleet::StopStatistics WorldHistory::statistics(const std::vector<plant::VehicleId>& vehicles,
                                               plant::MotionMode mode, int) {
    fleet::StopStatistics sum;
    for (const auto& stop : store_.stops) {
        if (stop.mode != mode ||
            std::find(vehicles.begin(), vehicles.end(), stop.vehicle) == vehicles.end()) {
            continue;
        }
        ++sum.stops;
        sum.max_m = std::max(sum.max_m, std::hypot(stop.dx_m, stop.dy_m));
    }
    return sum;
}

std::string Answer::header(const std::string& name) const {
    for (const auto& [key, value] : headers) {
        if (key == name) return value;
    }
    return {};
}

ApiWorld::ApiWorld(plant::Plant plant)
    : world(std::move(plant)),
      access(
          access_store,
          [this](const access::Change& change) { access::apply(access_store, change); }, world.now,
          Time{}, access::Limits{}, kCheap),
      history(world.store),
      documents(make_documents(world.plant)) {
    identity.kind = access::Identity::Kind::kToken;
    identity.name = "token:test";
    identity.role = access::Role::kOperator;
    world.connect_all();
    world.run(1.0);
}

Answer ApiWorld::call(const std::string& method, const std::string& target, const std::string& body,
                      const Headers& headers) {
    Request request;
    request.method = method;
    request.body = body;
    request.headers = headers;
    if (!body.empty()) request.headers.emplace("content-type", "application/json");
    request.request_id = "r-1";
    request.peer = peer;
    request.secure = secure;
    if (!parse_target(target, request)) {
        return {bad_request(request, "bad_target", "The request target cannot be read.")};
    }
    const bool proves = headers.count("cookie") + headers.count("authorization") > 0;
    request.identity = proves ? access.identify(headers, world.now) : identity;
    const Admission admitted = admit(request, policy);
    if (admitted.route == nullptr) return {*admitted.refusal};
    const Response response = admitted.refusal ? *admitted.refusal : run(*admitted.route, request);
    check_against_spec(*admitted.route, response);
    return {response};
}

Response ApiWorld::run(const Route& route, const Request& request) {
    const HistoryContext for_history{history, world.plant};
    if (const auto* on_fleet = std::get_if<FleetHandler>(&route.handler)) {
        FleetContext context{*world.fleet, world.plant, images, world.now};
        FleetAnswer answer = (*on_fleet)(context, request);
        world.settle();
        if (answer.plan) answer = answer.plan({motions, orders});
        if (answer.again) {
            answer = answer.again(context);
            world.settle();
        }
        if (answer.encode) return answer.encode({world.plant, images});
        return answer.then ? answer.then(for_history) : answer.response;
    }
    if (const auto* on_history = std::get_if<HistoryHandler>(&route.handler)) {
        return (*on_history)(for_history, request);
    }
    if (const auto* on_worker = std::get_if<WorkerHandler>(&route.handler)) {
        return (*on_worker)({access, world.now}, request);
    }
    const auto* in_place = std::get_if<InlineHandler>(&route.handler);
    EXPECT_NE(in_place, nullptr) << route.operation << " keeps its socket: not for this test";
    return (*in_place)({world.plant, documents, images, service, world.now}, request);
}

}  // namespace pulseline::api::testing
