#include "api/http/loads/load_handlers.hpp"

#include <limits>
#include <utility>

#include "api/http/wire/body.hpp"
#include "api/http/wire/common_json.hpp"
#include "api/http/wire/etag.hpp"
#include "api/http/wire/page.hpp"
#include "api/http/wire/problem.hpp"
#include "api/http/wire/query.hpp"
#include "api/plant/plant_codec.hpp"
#include "core/plant/carrying.hpp"

namespace pulseline::api {
namespace {

using json::Json;
using json::ObjectReader;

constexpr json::TextLimits kVehicleName{1, 64};
constexpr json::IntegerLimits kStationNumber{0, 1'000'000};

Json carriers_json(const plant::Plant& plant, const plant::Load& load) {
    Json carriers = Json::array();
    for (const auto& type : plant.vehicle_types) {
        if (!plant::cannot_carry(type, load)) carriers.push_back(type.id.str());
    }
    return carriers;
}

Json load_json(const plant::Plant& plant, const fleet::KnownLoad& known) {
    const auto& [sheet, place] = known;
    Json json = plant_file::encode_load_sheet(sheet.load);
    json["id"] = sheet.load.id.str();
    json["centre"] = {{"x_m", sheet.load.centre.x_m}, {"y_m", sheet.load.centre.y_m}};
    json["carriers"] = carriers_json(plant, sheet.load);
    json["since"] = rfc3339(place.at);
    if (!sheet.actor.empty()) {
        json["registered_at"] = rfc3339(sheet.at);
        json["registered_by"] = sheet.actor;
    }
    if (!place.vehicle.empty()) json["vehicle"] = place.vehicle.str();
    if (const auto* station = plant::find_station(plant, place.station)) {
        json["station"] = station->number;
    }
    if (!place.actor.empty()) json["by"] = place.actor;
    return json;
}

Response load_response(int status, const plant::Plant& plant, const fleet::KnownLoad& known) {
    Response response = json_response(status, load_json(plant, known));
    response.headers.emplace_back("ETag", etag_of_content(response.body));
    return response;
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

/// The id stands in the path and must be one that plants could have, too.
Result<plant::Load> read_sheet(const Request& request) {
    json::FieldErrors errors;
    const Json path = {{"id", request.param("id")}};
    const std::string id = ObjectReader(path, "", errors).text("id", kName);
    if (const Status ok = errors.status(); !ok) return fail(ok.error());
    // Whoever writes addresses takes these for folders, and the load would never be found again.
    if (id == "." || id == ".." || id.find('/') != std::string::npos) {
        return fail(Errc::kInvalid, "bad_id",
                    "An id stands in addresses: it has no slash and is more than dots.", "/id");
    }
    return read_object<plant::Load>(request, [&](ObjectReader& in) {
        plant::Load load;
        load.id = plant::LoadId(id);
        plant_file::decode_load_sheet(in, load);
        return load;
    });
}

/// Why what is there is not what the client means to write over; nothing: it is.
std::optional<Response> stale_load(const Request& request, const plant::Plant& plant,
                                   const plant::Load& wanted,
                                   const std::optional<fleet::KnownLoad>& present) {
    const std::string etag =
        present ? etag_of_content(json_response(200, load_json(plant, *present)).body) : "";
    const std::string& id = wanted.id.str();
    // Whoever heard no answer says the same once more.
    const bool repeats = present && plant_file::encode_load_sheet(present->sheet.load) ==
                                        plant_file::encode_load_sheet(wanted);
    if (repeats) return std::nullopt;
    if (present && if_none_match_has(request, etag)) {
        return problem({Errc::kStale,
                        {"load_known", {{"load", id}}},
                        "There is a load of that id already. Choose another id, or change what is "
                        "known of that one.",
                        "If-None-Match"},
                       request);
    }
    if (if_match_allows(request, etag) && (present || !request.headers.contains("if-match"))) {
        return std::nullopt;
    }
    return problem({Errc::kStale,
                    {"stale_load", {{"load", id}}},
                    "The load has changed meanwhile; read it again, then decide.",
                    "If-Match"},
                   request);
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
    const auto to_json = [&](const fleet::KnownLoad& known) {
        return load_json(context.plant, known);
    };
    return {json_response(200, {{"items", list_json(context.fleet.loads(), to_json)}})};
}

FleetAnswer get_load(FleetContext& context, const Request& request) {
    const auto known = context.fleet.load(plant::LoadId(request.param("id")));
    if (!known) return {unknown_load(request)};
    return {load_response(200, context.plant, *known)};
}

FleetAnswer put_load(FleetContext& context, const Request& request) {
    const auto sheet = read_sheet(request);
    if (!sheet) return {problem(400, sheet.error(), request)};
    const auto present = context.fleet.load(sheet->id);
    if (auto stale = stale_load(request, context.plant, *sheet, present))
        return {std::move(*stale)};
    const auto stored = context.fleet.put_load(*sheet, request.identity.name, context.now);
    if (!stored) {
        const bool wrong = stored.error().code == Errc::kInvalid;
        return {wrong ? problem(400, stored.error(), request) : problem(stored.error(), request)};
    }
    Response response = load_response(present ? 200 : 201, context.plant, *stored);
    if (!present) response.headers.emplace_back("Location", request.path);
    return {std::move(response)};
}

FleetAnswer retire_load(FleetContext& context, const Request& request) {
    const auto retired = context.fleet.retire_load(plant::LoadId(request.param("id")),
                                                   request.identity.name, context.now);
    if (!retired) return {problem(retired.error(), request)};
    return {Response{204, "", {}, ""}};
}

Response list_load_moves(const HistoryContext& context, const Request& request) {
    auto query = read_move_query(request);
    if (!query) return problem(400, query.error(), request);
    if (plant::find_load(context.plant, query->load) == nullptr &&
        !context.history.has_load_sheet(query->load)) {
        return unknown_load(request);
    }
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
