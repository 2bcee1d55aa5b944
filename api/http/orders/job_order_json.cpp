#include "api/http/orders/job_order_json.hpp"

#include "api/http/orders/order_body.hpp"

namespace pulseline::api {
namespace {

template <class AnyId>
void put_id(Json& json, const char* name, const AnyId& id) {
    if (!id.empty()) json[name] = id.str();
}

Json step_json(const plant::Plant& plant, const fleet::Step& step) {
    const plant::Station* station = plant::find_station(plant, step.station);
    Json json = {{"station", step.station.str()},
                 {"number", station != nullptr ? station->number : 0},
                 {"motion_mode", plant::to_string(step.mode)},
                 {"state", fleet::to_string(step.state)}};
    if (!step.before.empty()) json["before"] = actions_json(step.before);
    if (!step.after.empty()) json["after"] = actions_json(step.after);
    if (!step.before.empty() || !step.after.empty()) {
        json["phase"] = fleet::to_string(step.phase);
        json["actions_done"] = step.actions_done;
    }
    put_id(json, "leg", step.leg);
    put_id(json, "stop", step.stop);
    return json;
}

Json dependency_json(const fleet::Dependency& dependency) {
    Json json = {{"order", dependency.order.str()},
                 {"name", "JO-" + std::to_string(dependency.number)}};
    if (dependency.outcome) json["outcome"] = fleet::to_string(*dependency.outcome);
    return json;
}

/// What only some orders have.
void put_fields(Json& json, const fleet::JobOrder& order) {
    if (!order.wanted_type.empty()) json["vehicle_type"] = order.wanted_type.str();
    if (order.earliest_start) json["earliest_start"] = rfc3339(*order.earliest_start);
    if (order.due) json["due"] = rfc3339(*order.due);
    if (!order.after.empty()) json["after"] = list_json(order.after, dependency_json);
    if (!order.sequence.empty()) json["sequence"] = order.sequence;
    if (!order.sequence_vehicle.empty()) json["sequence_vehicle"] = order.sequence_vehicle.str();
    if (!order.from_template.empty()) json["template"] = order.from_template;
    put_id(json, "schedule", order.from_schedule);
}

}  // namespace

Json job_order_json(const plant::Plant& plant, const fleet::JobOrder& order) {
    Json json = {
        {"id", order.id.str()},
        {"number", order.number},
        {"name", "JO-" + std::to_string(order.number)},
        {"state", fleet::to_string(order.state)},
        {"priority", order.priority},
        {"wanted_vehicle", order.wanted_vehicle.str()},
        {"vehicle", order.assigned_vehicle.str()},
        {"steps",
         list_json(order.steps, [&](const fleet::Step& step) { return step_json(plant, step); })},
        {"current_step", order.current_step},
        {"cancel_requested", order.cancel_requested},
        {"stop_requested", order.stop_requested},
        {"pause_requested", order.pause_requested},
        {"removed", order.removed},
        {"created_by", order.created_by},
        {"created_at", rfc3339(order.created)},
        {"revision", order.revision}};
    if (!order.client_order_id.empty()) json["client_order_id"] = order.client_order_id;
    if (!order.reason.code.empty()) json["reason"] = reason_json(order.reason);
    if (order.started != Time{}) json["started_at"] = rfc3339(order.started);
    if (order.ended != Time{}) json["ended_at"] = rfc3339(order.ended);
    if (order.expected) json["expected_at"] = rfc3339(*order.expected);
    put_fields(json, order);
    return json;
}

namespace {

Json arrival_json(const fleet::Arrival& arrival) {
    Json json = {
        {"dx_m", arrival.dx_m}, {"dy_m", arrival.dy_m}, {"dheading_rad", arrival.dheading_rad}};
    if (arrival.expected_m > 0) {
        json["expected_m"] = arrival.expected_m;
        json["expected_rad"] = arrival.expected_rad;
    }
    return json;
}

}  // namespace

Json stop_record_json(const fleet::StopRecord& stop) {
    Json json = {{"id", stop.id.str()},
                 {"order", stop.order.str()},
                 {"leg", stop.leg.str()},
                 {"step", stop.step},
                 {"vehicle", stop.vehicle.str()},
                 {"station", stop.station.str()},
                 {"number", stop.station_number},
                 {"mode", plant::to_string(stop.mode)},
                 {"theoretical", pose_json(stop.theoretical)},
                 {"measured", pose_json(stop.measured)},
                 {"dx_m", stop.dx_m},
                 {"dy_m", stop.dy_m},
                 {"dheading_rad", stop.dheading_rad},
                 {"along_m", stop.along_m},
                 {"left_m", stop.left_m},
                 {"sigma_xy_m", stop.sigma_xy_m},
                 {"sigma_heading_rad", stop.sigma_heading_rad},
                 {"tolerance", tolerance_json(stop.tolerance)},
                 {"inside", stop.inside},
                 {"attempt", stop.attempt},
                 {"method", stop.method},
                 {"markers", stop.markers},
                 {"load_kg", stop.load_kg},
                 {"at", rfc3339(stop.at)}};
    if (!stop.load.empty()) json["load"] = stop.load.str();
    if (stop.arrival) json["arrival"] = arrival_json(*stop.arrival);
    return json;
}

Json event_json(const fleet::Event& event) {
    Json json = {{"seq", event.seq},
                 {"at", rfc3339(event.at)},
                 {"type", event.type},
                 {"params", params_json(event.params)}};
    put_id(json, "order", event.order);
    put_id(json, "leg", event.leg);
    put_id(json, "vehicle", event.vehicle);
    if (!event.actor.empty()) json["actor"] = event.actor;
    return json;
}

}  // namespace pulseline::api
