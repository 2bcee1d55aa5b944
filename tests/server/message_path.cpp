#include "tests/server/message_path.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "api/http/orders/job_order_json.hpp"
#include "api/http/vehicles/vehicle_json.hpp"
#include "api/vda5050/instant_actions.hpp"
#include "api/vda5050/order.hpp"
#include "api/vda5050/state.hpp"
#include "server/vehicles/vehicle_frames.hpp"
#include "tests/api/vda5050/samples.hpp"

namespace pulseline::server::testing {
namespace {

using vda5050::Json;

const plant::VehicleId kVehicle("V1");

plant::Plant plant_of_one_camera() {
    auto plant = fleet::testing::small_plant();
    plant.vehicle_types.front().cameras.resize(1);
    plant.markers.front().pose.heading_rad = 0.3;  // nothing cancels out by chance
    return plant;
}

class NoImages : public api::CameraImages {
public:
    std::optional<Image> newest(const plant::VehicleId&, const std::string&) const override {
        return {};
    }
    std::optional<Time> taken(const plant::VehicleId&, const std::string&) const override {
        return {};
    }
};

bool all_finite(const Json& value) {
    if (value.is_number_float()) return std::isfinite(value.get<double>());
    if (!value.is_structured()) return true;
    for (const auto& item : value)
        if (!all_finite(item)) return false;
    return true;
}

void check(const Json& value, std::string& broken) {
    if (broken.empty() && !all_finite(value)) broken = value.dump();
}

void check(const fleet::VehicleMessage& message, std::string& broken) {
    const vda5050::Header header{1, "", "test", "V1"};
    try {
        if (message.order) (void)vda5050::encode_order(*message.order, header);
        if (message.instant_actions)
            (void)vda5050::encode_instant_actions(*message.instant_actions, header);
    } catch (const vda5050::NotFinite& error) {
        broken = std::string("a message to the vehicle: ") + error.what();
    }
}

void check(const plant::Plant& plant, const fleet::Outputs& out, std::string& broken) {
    for (const auto& order : out.records.orders) check(api::job_order_json(plant, order), broken);
    for (const auto& stop : out.records.stops) check(api::stop_record_json(stop), broken);
    for (const auto& event : out.records.events) check(api::event_json(event), broken);
    for (const auto& record : out.records.vehicles) {
        const Json pose{record.pose.x_m, record.pose.y_m, record.pose.heading_rad};
        check(pose, broken);
    }
    for (const auto& view : out.vehicles) check(api::vehicle_json(plant, NoImages(), view), broken);
    for (const auto& view : out.stations) check(api::station_state_json(view), broken);
    for (const auto& message : out.messages) check(message, broken);
}

bool waits_to_measure(const vda5050::StateMessage& state) {
    return !state.action_states.empty() && state.node_states.empty() && !state.driving &&
           state.action_states.back().status == vda5050::ActionStatus::kWaiting;
}

}  // namespace

MessagePath::MessagePath(Situation situation)
    : start_(plant_of_one_camera()), world_(plant_of_one_camera()) {
    prepare(situation);
    snapshot_ = start_.fleet->snapshot();
    reset();
}

void MessagePath::prepare(Situation situation) {
    if (situation == Situation::kLost) {
        start_.vehicle("V1").sees_codes = true;
        start_.fleet->vehicle_connected(kVehicle, start_.now);
        start_.settle();
        return;
    }
    start_.connect_all();
    start_.run(3);
    if (situation == Situation::kPlaced) return;
    if (!start_.order("V1", {2})) std::abort();
    start_.run(2);
    if (situation == Situation::kDriving) return;
    for (int i = 0; i < 1000 && !waits_to_measure(start_.vehicle("V1").state); ++i) start_.run(0.1);
    if (!start_.vehicle("V1").step()) std::abort();  // it has measured, and not said so yet
}

void MessagePath::reset() {
    auto fleet = fleet::Fleet::from_snapshot(start_.plant, snapshot_);
    if (!fleet) throw std::logic_error(fleet.error().what);
    world_.fleet = std::move(*fleet);
    world_.store = start_.store;
    world_.now = start_.now;
    world_.ticks = start_.ticks;
    world_.connected = start_.connected;
    world_.vehicles.clear();
    for (const auto& [id, vehicle] : start_.vehicles) world_.vehicles.emplace(id, vehicle);
}

std::string MessagePath::state_payload() const {
    auto state = vda5050::testing::state();
    const auto& now = start_.vehicles.at(kVehicle).state;
    auto sent = now;
    if (!sent.position_initialized) sent.pose.reset();
    sent.brackets = state.brackets;
    sent.wheels = state.wheels;
    sent.parking_feet = state.parking_feet;
    sent.load_kg = state.load_kg;
    sent.velocity_mps = state.velocity_mps;
    sent.turn_rate_radps = state.turn_rate_radps;
    sent.localization_score = state.localization_score;
    sent.deviation_range_m = state.deviation_range_m;
    sent.distance_since_last_node_m = state.distance_since_last_node_m;
    sent.errors = {{"noted", false, "something", {}}};
    return vda5050::encode_state(sent, {7, "2026-01-31T12:00:00.123Z", "test", "V1"});
}

void MessagePath::take(std::string& broken) {
    for (int round = 0; round < 10; ++round) {
        const auto out = world_.fleet->take_outputs(world_.now);
        check(world_.plant, out, broken);
        if (out.records.empty() && out.messages.empty()) return;
        world_.store.commit(out.records);
        for (const auto& message : out.messages)
            if (world_.connected[message.vehicle])
                world_.vehicles.at(message.vehicle).receive(message);
    }
}

MessagePath::Outcome MessagePath::give(std::string_view frame) {
    Outcome outcome;
    auto decoded = read_vehicle_frame(frame, *plant::find_vehicle(world_.plant, kVehicle));
    if (!decoded) {
        outcome.refused = decoded.error().field + " " + decoded.error().reason.code;
        world_.fleet->vehicle_message_refused(
            kVehicle, {"messageRefused", false, decoded.error().what, {}}, world_.now);
        take(outcome.broken);
        return outcome;
    }
    outcome.taken = true;
    world_.now += std::chrono::milliseconds(10);
    if (const auto* state = std::get_if<vda5050::StateMessage>(&decoded->message)) {
        world_.fleet->vehicle_state(kVehicle, *state, world_.now);
    } else if (const auto* sheet = std::get_if<vda5050::Factsheet>(&decoded->message)) {
        world_.fleet->vehicle_factsheet(kVehicle, *sheet, world_.now);
    } else if (const auto* seen = std::get_if<vda5050::VisualizationMessage>(&decoded->message)) {
        check(Json{seen->pose.x_m, seen->pose.y_m, seen->pose.heading_rad, seen->velocity_mps,
                   seen->turn_rate_radps},
              outcome.broken);
    }
    take(outcome.broken);
    world_.fleet->tick(world_.now);
    take(outcome.broken);
    return outcome;
}

std::string MessagePath::go_on() {
    std::string broken;
    fleet::NewOrder order;
    order.vehicle = kVehicle;
    order.actor = "tester";
    order.steps.push_back({2, plant::MotionMode::kAuto});
    (void)world_.fleet->create(order, world_.now);
    take(broken);
    for (int i = 0; i < 10; ++i) {
        world_.now += std::chrono::milliseconds(100);
        for (auto& [id, vehicle] : world_.vehicles) {
            if (i % 5 == 4) vehicle.step();
            if (!world_.connected[id]) continue;
            world_.fleet->vehicle_state(id, vehicle.state, world_.now);
            take(broken);
        }
        world_.fleet->tick(world_.now);
        take(broken);
    }
    for (const auto& view : world_.fleet->vehicles(world_.now))
        check(api::vehicle_json(world_.plant, NoImages(), view), broken);
    return broken;
}

}  // namespace pulseline::server::testing
