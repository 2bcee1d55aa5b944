#include "tests/core/fleet/fleet_world.hpp"

#include <algorithm>
#include <utility>

#include "core/vda5050/actions.hpp"

namespace pulseline::fleet::testing {
namespace {

constexpr int kTicksPerStep = 5;   // a node takes half a second
constexpr double kLeap_mps = 100;  // and is a jump, which it has to say
constexpr double kCamera_m = 1.2;  // cameras ahead of and behind the centre

plant::VehicleType small_type() {
    plant::VehicleType type;
    type.id = plant::VehicleTypeId("small");
    type.name = "Small carrier";
    type.footprint = geometry::rectangle(3.0, 1.2);
    type.max_speed_mps = 1.0;
    type.max_accel_mps2 = 0.5;
    type.max_turn_rate_radps = 0.5;
    type.max_turn_accel_radps2 = 0.5;
    type.clearance_m = 0.3;
    type.motion_modes = {plant::MotionMode::kLinear, plant::MotionMode::kFixedAxisRotation,
                         plant::MotionMode::kSelfRotation};
    for (const auto& [name, x_m] : {std::pair{"front", kCamera_m}, std::pair{"back", -kCamera_m}}) {
        plant::Camera camera;
        camera.name = name;
        camera.body_from_camera = {x_m, 0, 0};
        type.cameras.push_back(camera);
    }
    type.max_load_kg = 500;
    return type;
}

}  // namespace

plant::Plant small_plant() {
    plant::Plant plant;
    plant.id = "small";
    plant.name = "Small hall";
    plant::Hall hall;
    hall.id = plant::HallId("h1");
    hall.name = "Hall 1";
    hall.outline = {{0, 0}, {60, 0}, {60, 40}, {0, 40}};
    plant.halls.push_back(hall);
    plant.vehicle_types.push_back(small_type());
    for (int number = 1; number <= 4; ++number) {
        plant::Station station;
        station.id = plant::StationId("s" + std::to_string(number));
        station.number = number;
        station.name = "Station " + std::to_string(number);
        station.hall = hall.id;
        station.pose = {12.0 * number, 20, 0};
        station.node = plant::NodeId("n" + std::to_string(number));
        for (const auto& [side, x_m] : {std::pair{"F", kCamera_m}, std::pair{"B", -kCamera_m}}) {
            plant::Marker marker;
            marker.payload = "ST0" + std::to_string(number) + "-" + side;
            marker.id = plant::MarkerId(marker.payload);
            marker.hall = hall.id;
            marker.pose = {station.pose.x_m + x_m, station.pose.y_m, 0};
            station.markers.push_back(marker.id);
            plant.markers.push_back(marker);
        }
        plant.nodes.push_back({station.node, hall.id, station.pose.position()});
        plant.stations.push_back(station);
    }
    for (int i = 1; i < 4; ++i) {
        for (const auto& [from, to] : {std::pair{i, i + 1}, std::pair{i + 1, i}}) {
            plant::RoadmapEdge edge;
            edge.from = plant::NodeId("n" + std::to_string(from));
            edge.to = plant::NodeId("n" + std::to_string(to));
            edge.id = plant::EdgeId(edge.from.str() + edge.to.str());
            plant.edges.push_back(edge);
        }
    }
    for (const auto& [name, home] : {std::pair{"V1", "s1"}, std::pair{"V2", "s4"}}) {
        plant::Vehicle vehicle;
        vehicle.id = plant::VehicleId(name);
        vehicle.type = plant::VehicleTypeId("small");
        vehicle.manufacturer = "test";
        vehicle.serial_number = name;
        vehicle.home = plant::StationId(home);
        plant.vehicles.push_back(vehicle);
    }
    return plant;
}

void MemoryStore::commit(const Records& records) {
    for (const auto& order : records.orders) orders[order.id] = order;
    for (const auto& vehicle : records.vehicles) vehicles[vehicle.id] = vehicle;
    for (const auto& load : records.loads) {
        const LoadRecord before = std::exchange(loads[load.id], load);
        const bool is_new = load.vehicle.empty() && load.station.empty() &&
                            std::ranges::any_of(records.load_sheets, [&](const LoadSheet& sheet) {
                                return sheet.load.id == load.id;
                            });
        if (is_new) continue;  // it has not moved
        load_moves.push_back({load.id,
                              {static_cast<std::int64_t>(load_moves.size() + 1),
                               {before.vehicle, before.station},
                               {load.vehicle, load.station},
                               load.at,
                               load.actor}});
    }
    for (const auto& sheet : records.load_sheets) load_sheets[sheet.load.id] = sheet;
    stops.insert(stops.end(), records.stops.begin(), records.stops.end());
    events.insert(events.end(), records.events.begin(), records.events.end());
    idempotency.insert(idempotency.end(), records.idempotency.begin(), records.idempotency.end());
    closures.insert(closures.end(), records.closures.begin(), records.closures.end());
    std::erase_if(closures, [&](const Closure& closure) {
        return std::count(records.reopened.begin(), records.reopened.end(), closure.id) > 0;
    });
    for (const auto& schedule : records.schedules) {
        if (schedule.deleted) {
            schedules.erase(schedule.id);
        } else {
            schedules[schedule.id] = schedule;
        }
    }
    for (const auto& one : records.templates) {
        if (one.deleted) {
            templates.erase(one.name);
        } else {
            templates[one.name] = one;
        }
    }
}

StoredFleet MemoryStore::load() const {
    StoredFleet stored;
    for (const auto& [id, order] : orders) {
        stored.orders.push_back(order);
        stored.last_order_number = std::max(stored.last_order_number, order.number);
    }
    for (const auto& [id, vehicle] : vehicles) stored.vehicles.push_back(vehicle);
    for (const auto& [id, load] : loads) stored.loads.push_back(load);
    for (const auto& [id, sheet] : load_sheets) stored.load_sheets.push_back(sheet);
    stored.idempotency = idempotency;
    stored.closures = closures;
    for (const auto& [id, schedule] : schedules) stored.schedules.push_back(schedule);
    for (const auto& [name, one] : templates) stored.templates.push_back(one);
    if (!events.empty()) {
        stored.last_event_seq = events.back().seq;
        stored.last_time = events.back().at;
    }
    return stored;
}

FakeVehicle::FakeVehicle(const plant::Plant& plant, plant::VehicleId id, Pose2 pose)
    : plant_(plant), id_(std::move(id)) {
    state.pose = pose;
    state.map_id = "h1";
    see_codes();
}

void FakeVehicle::see_codes() {
    state.cameras.clear();
    const auto* vehicle = plant::find_vehicle(plant_, id_);
    for (const auto& camera : plant::find_vehicle_type(plant_, vehicle->type)->cameras) {
        vda5050::CameraReading reading;
        reading.camera = camera.name;
        for (const auto& marker : plant_.markers) {
            const auto in_body = geometry::inverse(*state.pose) * marker.pose;
            if (geometry::distance(in_body.position(), camera.body_from_camera.position()) > 0.05) {
                continue;
            }
            reading.found = sees_codes;
            reading.payload = marker.payload;
            reading.code = in_body.position();
            reading.angle_rad = in_body.heading_rad;
            reading.sigma_m = 1e-5;
        }
        state.cameras.push_back(reading);
    }
}

void FakeVehicle::end_lifts(const std::string& why) {
    for (auto& action : state.action_states) {
        if (!vda5050::is_lift(action.type) || action.status != vda5050::ActionStatus::kRunning) {
            continue;
        }
        action.status =
            why.empty() ? vda5050::ActionStatus::kFinished : vda5050::ActionStatus::kFailed;
        action.result_description = why;
    }
}

void FakeVehicle::receive(const VehicleMessage& message) {
    if (message.instant_actions) {
        for (const auto& action : message.instant_actions->actions) {
            const bool known = std::any_of(state.action_states.begin(), state.action_states.end(),
                                           [&](const auto& a) { return a.id == action.id; });
            if (known) continue;  // a doubled message
            const bool runs = vda5050::is_lift(action.type) && !lifts_end;
            state.action_states.push_back(
                {action.id,
                 action.type,
                 runs ? vda5050::ActionStatus::kRunning : vda5050::ActionStatus::kFinished,
                 {},
                 {}});
            if (action.type == "startPause") end_lifts("vehicle_paused");
            if (action.type == "stopLifts") end_lifts("lifts_stopped");
            if (action.type == "startPause") state.paused = true;
            if (action.type == "stopPause") state.paused = false;
            if (action.type == "stopCharging") state.charging = false;
            if (action.type == "setTransmitters") transmitters = action.transmitters;
            if (action.type == "setReflectors") reflectors = action.reflectors;
            if (action.type == "initPosition") {
                state.pose = action.init_position->pose;
                state.position_initialized = true;
            }
            if (action.type == "cancelOrder" && order_) {
                order_.reset();
                state.node_states.clear();
                state.edge_states.clear();
                state.driving = false;
            }
        }
    }
    if (!message.order) return;
    ++orders_received;
    const vda5050::OrderMessage& order = *message.order;
    if (state.order_id == order.order_id && order.order_update_id <= state.order_update_id) return;
    if (order_ && state.order_id == order.order_id) {
        const auto& stitch = order.nodes.front();
        while (!order_->nodes.empty() && order_->nodes.back().sequence_id >= stitch.sequence_id) {
            order_->nodes.pop_back();
        }
        while (!order_->edges.empty() && order_->edges.back().sequence_id > stitch.sequence_id) {
            order_->edges.pop_back();
        }
        order_->nodes.insert(order_->nodes.end(), order.nodes.begin(), order.nodes.end());
        order_->edges.insert(order_->edges.end(), order.edges.begin(), order.edges.end());
    } else {
        order_ = order;
        at_ = 0;
        state.action_states.clear();
        state.last_node_id = order.nodes.front().node_id;
        state.last_node_sequence_id = 0;
    }
    state.order_id = order.order_id;
    state.order_update_id = order.order_update_id;
    tell_what_is_left();
    for (const auto& action : order_->nodes.back().actions) {
        const bool known = std::any_of(state.action_states.begin(), state.action_states.end(),
                                       [&](const auto& a) { return a.id == action.id; });
        if (!known)
            state.action_states.push_back(
                {action.id, action.type, vda5050::ActionStatus::kWaiting, {}, {}});
    }
}

void FakeVehicle::tell_what_is_left() {
    state.node_states.clear();
    state.edge_states.clear();
    for (std::size_t i = at_ + 1; i < order_->nodes.size(); ++i) {
        const auto& node = order_->nodes[i];
        const auto& edge = order_->edges[i - 1];
        state.node_states.push_back({node.node_id, node.sequence_id, node.released});
        state.edge_states.push_back({edge.edge_id, edge.sequence_id, edge.released});
    }
}

bool FakeVehicle::step() {
    state.velocity_mps = 0;
    if (!order_ || state.paused || stands) {
        see_codes();
        return false;
    }
    if (at_ + 1 < order_->nodes.size()) {
        const auto& next = order_->nodes[at_ + 1];
        if (!next.released) {
            state.driving = false;
            return false;
        }
        ++at_;
        ++node_steps;
        state.driving = at_ + 1 < order_->nodes.size() && order_->nodes[at_ + 1].released;
        state.pose = next.pose;
        state.velocity_mps = kLeap_mps;
        state.last_node_id = next.node_id;
        state.last_node_sequence_id = next.sequence_id;
        tell_what_is_left();
        see_codes();
        return true;
    }
    state.driving = false;
    for (auto& action : state.action_states) {
        if (action.status != vda5050::ActionStatus::kWaiting) continue;
        if (action.type == "measureStop" && measure_fails) {
            action.status = vda5050::ActionStatus::kFailed;
            action.result_description = *measure_fails;
            return true;
        }
        if (action.type == action_fails) {
            action.status = vda5050::ActionStatus::kFailed;
            action.result_description = "it jammed";
            return true;
        }
        action.status = vda5050::ActionStatus::kFinished;
        actions_done.push_back(action.type);
        if (on_action) on_action(action.type);
        if (action.type == "startCharging") state.charging = true;
        if (action.type == "measureStop") {
            const Pose2 station = order_->nodes.back().actions.back().stop_target->target;
            action.measurement = vda5050::StopMeasurement{};
            action.measurement->pose = {station.x_m + stop_error.x_m, station.y_m + stop_error.y_m,
                                        station.heading_rad + stop_error.heading_rad};
            action.measurement->method = "dual_camera";
            if (arrival_error) {
                action.measurement->arrived = {station.x_m + arrival_error->x_m,
                                               station.y_m + arrival_error->y_m,
                                               station.heading_rad + arrival_error->heading_rad};
            }
            if (pose_follows_stop) state.pose = action.measurement->pose;
        }
        return true;
    }
    order_.reset();
    return false;
}

void FakeVehicle::restart() {
    order_.reset();
    const Pose2 pose = *state.pose;
    state = {};
    state.pose = pose;
    state.map_id = "h1";
    see_codes();
}

World::World() : World(small_plant()) {}

World::World(plant::Plant p) : plant(std::move(p)) {
    fleet = std::make_unique<Fleet>(plant, store.load(), seed, now);
    for (const auto& vehicle : plant.vehicles) {
        const Pose2 home = plant::find_station(plant, vehicle.home)->pose;
        vehicles.emplace(vehicle.id, FakeVehicle(plant, vehicle.id, home));
        connected[vehicle.id] = false;
    }
}

void World::connect_all() {
    for (auto& [id, is_connected] : connected) {
        is_connected = true;
        fleet->vehicle_connected(id, now);
    }
    run(1);
}

void World::announce(std::vector<std::string> actions) {
    for (const auto& [id, vehicle] : vehicles) {
        vda5050::Factsheet factsheet;
        factsheet.actions = factsheet.node_actions = factsheet.instant_actions = actions;
        factsheet.actions.insert(factsheet.actions.end(), {"measureStop", "adjustToMarker"});
        fleet->vehicle_factsheet(id, factsheet, now);
    }
}

void World::settle() {
    for (int round = 0; round < 10; ++round) {
        Outputs out = fleet->take_outputs(now);
        for (const StationView& view : out.stations) told[view.id] = view;
        if (out.records.empty() && out.messages.empty() && out.plans_wanted.empty()) return;
        store.commit(out.records);
        for (auto& question : out.plans_wanted) {
            if (plans_at_once) {
                const auto answer = answerer.answer(question);
                fleet->leg_planned(question.vehicle, question.number, answer, now);
            } else {
                questions.push_back(std::move(question));
            }
        }
        for (const auto& message : out.messages) {
            if (connected[message.vehicle]) vehicles.at(message.vehicle).receive(message);
        }
    }
}

std::vector<int> World::stations_told_wrong() const {
    std::vector<int> wrong;
    for (const StationView& is : fleet->stations()) {
        const auto found = told.find(is.id);
        const StationView was = found == told.end() ? StationView{} : found->second;
        if (is.occupied_by != was.occupied_by || is.reserved_by != was.reserved_by) {
            wrong.push_back(is.number);
        }
    }
    return wrong;
}

void World::run(double duration_s) {
    const Time end = now + from_seconds(duration_s);
    while (now < end) {
        now += std::chrono::milliseconds(100);
        const bool step = vehicles_move && ++ticks % kTicksPerStep == 0;
        for (auto& [id, vehicle] : vehicles) {
            if (step) vehicle.step();
            if (!connected[id]) continue;
            fleet->vehicle_state(id, vehicle.state, now);
            settle();
        }
        fleet->tick(now);
        settle();
    }
}

void World::crash_server() {
    fleet = std::make_unique<Fleet>(plant, store.load(), ++seed, now);
    for (auto& [id, is_connected] : connected) {
        if (is_connected) fleet->vehicle_connected(id, now);
    }
    settle();
}

Result<Created> World::order(const std::string& vehicle, std::vector<int> stations,
                             plant::MotionMode mode) {
    NewOrder request;
    request.vehicle = plant::VehicleId(vehicle);
    for (const int station : stations) request.steps.push_back({station, mode});
    return order(std::move(request));
}

Result<Created> World::order(NewOrder request) {
    if (request.actor.empty()) request.actor = "tester";
    request.planned_beside = true;
    auto created = fleet->create(request, now);
    settle();
    return created;
}

JobOrder World::only_order() const { return store.orders.begin()->second; }

int World::count_events(const std::string& type) const {
    return static_cast<int>(std::count_if(store.events.begin(), store.events.end(),
                                          [&](const Event& e) { return e.type == type; }));
}

}  // namespace pulseline::fleet::testing
