#include "api/http/loads/load_handlers.hpp"

#include <limits>
#include <utility>

#include "api/http/wire/body.hpp"
#include "api/http/wire/common_json.hpp"
#include "api/http/wire/etag.hpp"
#include "api/http/wire/page.hpp"
#include "api/http/wire/problem.hpp"
#include "api/http/wire/query.hpp"

namespace pulseline::api {
namespace {

using json::Json;
using json::ObjectReader;

constexpr json::TextLimits kVehicleName{1, 64};
constexpr json::IntegerLimits kStationNumber{0, 1'000'000};

Json load_json(const plant::Plant& plant, const fleet::LoadRecord& record) {
    const auto* load = plant::find_load(plant, record.id);
    Json json = {{"id", record.id.str()}, {"since", rfc3339(record.at)}};
    if (load != nullptr) {
        json["name"] = load->name;
        json["kind"] = plant::to_string(load->kind);
        json["mass_kg"] = load->mass_kg;
        if (!load->model.empty()) json["model"] = load->model;
    }
    if (!record.vehicle.empty()) json["vehicle"] = record.vehicle.str();
    if (const auto* station = plant::find_station(plant, record.station)) {
        json["station"] = station->number;
    }
    if (!record.actor.empty()) json["by"] = record.actor;
    return json;
}

/// Neither: outside the plant.
Json place_json(const plant::Plant& plant, const fleet::LoadPlace& place) {
    Json json = Json::object();
    if (!place.vehicle.empty()) json["vehicle"] = place.vehicle.str();
    if (place.station.empty()) return json;
    if (const auto* station = plant::find_station(plant, place.station)) {
        json["station"] = station->number;
    } else {
        json["former_station"] = place.station.str();
    }
    return json;
}

Json move_json(const plant::Plant& plant, const fleet::LoadMove& move) {
    Json json = {{"seq", move.seq},
                 {"from", place_json(plant, move.from)},
                 {"to", place_json(plant, move.to)},
                 {"at", rfc3339(move.at)}};
    if (!move.actor.empty()) json["by"] = move.actor;
    return json;
}

Response unknown_load(const Request& request) {
    return problem({Errc::kNotFound,
                    {"unknown_load", {{"load", request.param("id").substr(0, 64)}}},
                    "There is no load of that id; GET /api/v1/loads lists them.",
                    {}},
                   request);
}

Result<fleet::LoadMoveQuery> read_move_query(const Request& request) {
    fleet::LoadMoveQuery query{plant::LoadId(request.param("id"))};
    const auto limit = read_limit(request);
    if (!limit) return fail(limit.error());
    query.limit = *limit;
    if (const auto text = request.query_value("cursor")) {
        query.before = parse_integer(*text, 0, std::numeric_limits<std::int64_t>::max());
        if (!query.before) return bad_cursor();
    }
    return query;
}

struct PlaceBody {
    std::string vehicle;
    std::optional<std::int64_t> station;
};

Result<PlaceBody> read_place(const Request& request) {
    auto body = read_object<PlaceBody>(request, [](ObjectReader& in) {
        PlaceBody place;
        if (in.has("vehicle")) place.vehicle = in.text("vehicle", kVehicleName);
        if (in.has("station")) place.station = in.integer("station", kStationNumber);
        return place;
    });
    if (body && !body->vehicle.empty() && body->station) {
        return fail(Errc::kInvalid, "two_places",
                    "A load is on a vehicle or at a station. Say one of them, or neither when it "
                    "has left the plant.",
                    "/station");
    }
    return body;
}

}  // namespace

FleetAnswer list_loads(FleetContext& context, const Request&) {
    const auto to_json = [&](const fleet::LoadRecord& record) {
        return load_json(context.plant, record);
    };
    return {json_response(200, {{"items", list_json(context.fleet.loads(), to_json)}})};
}

FleetAnswer get_load(FleetContext& context, const Request& request) {
    const auto record = context.fleet.load(plant::LoadId(request.param("id")));
    if (!record) return {unknown_load(request)};
    Response response = json_response(200, load_json(context.plant, *record));
    response.headers.emplace_back("ETag", etag_of_content(response.body));
    return {std::move(response)};
}

Response list_load_moves(const HistoryContext& context, const Request& request) {
    auto query = read_move_query(request);
    if (!query) return problem(400, query.error(), request);
    if (plant::find_load(context.plant, query->load) == nullptr) return unknown_load(request);
    const auto limit = static_cast<std::size_t>(query->limit);
    ++query->limit;
    auto moves = context.history.load_moves(*query);
    Json page = Json::object();
    if (moves.size() > limit) {
        moves.resize(limit);
        page["next_cursor"] = std::to_string(moves.back().seq);
    }
    page["items"] = list_json(
        moves, [&](const fleet::LoadMove& move) { return move_json(context.plant, move); });
    return json_response(200, page);
}

FleetAnswer place_load(FleetContext& context, const Request& request) {
    const auto body = read_place(request);
    if (!body) return {problem(400, body.error(), request)};
    fleet::LoadPlace place{plant::VehicleId(body->vehicle), {}};
    if (body->station) {
        const auto* station = plant::find_station(context.plant, static_cast<int>(*body->station));
        if (station == nullptr) {
            return {problem({Errc::kUnreachable,
                             {"unknown_station", {{"station", *body->station}}},
                             "There is no station of that number; GET /api/v1/stations lists them.",
                             "/station"},
                            request)};
        }
        place.station = station->id;
    }
    const auto placed = context.fleet.place_load(plant::LoadId(request.param("id")), place,
                                                 request.identity.name, context.now);
    if (!placed) return {problem(placed.error(), request)};
    return {json_response(202, load_json(context.plant, *placed))};
}

}  // namespace pulseline::api
