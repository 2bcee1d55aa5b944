#include "tests/experiments/stop_runs.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "api/plant/plant_file.hpp"
#include "core/kinematics/motion.hpp"
#include "core/onboard/executor.hpp"
#include "core/onboard/pose/light_watch.hpp"
#include "core/onboard/pose/marker_watch.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "core/simulation/world/receivers.hpp"
#include "core/vda5050/actions.hpp"
#include "server/agent/camera_sensing.hpp"
#include "server/agent/hall_truth.hpp"
#include "server/agent/stop_senses.hpp"

namespace pulseline::experiments {
namespace {

using geometry::Pose2;

constexpr double kTick_s = 0.02;
constexpr double kPatience_s = 600;  // of the vehicle's own time, for one stop
/// Counts looks and keeps where the vehicle stood at the first.
class Watched : public onboard::StopSensing {
public:
    Watched(onboard::StopSensing& eyes, const simulation::SimulatedDrive& drive, double spoil_m)
        : eyes_(eyes), drive_(drive), spoil_m_(spoil_m) {}
    void forget() { looks_ = 0; }
    int looks() const { return looks_; }
    const Pose2& first() const { return first_; }
    const vda5050::StopMeasurement& last() const { return last_; }
    Result<vda5050::StopMeasurement> measure(const vda5050::StopTarget& target) override {
        if (looks_++ == 0) first_ = drive_.true_pose();
        auto made = eyes_.measure(target);
        if (!made) return made;
        made->pose.x_m += spoil_m_;
        last_ = *made;
        return made;
    }

private:
    onboard::StopSensing& eyes_;
    const simulation::SimulatedDrive& drive_;
    double spoil_m_;
    int looks_ = 0;
    Pose2 first_;
    vda5050::StopMeasurement last_;
};

vda5050::OrderMessage order_to(const std::string& id, const std::string& map,
                               const std::vector<kinematics::Segment>& segments,
                               const vda5050::StopTarget& target) {
    vda5050::OrderMessage order;
    order.order_id = id;
    const auto add_node = [&](const Pose2& pose) {
        vda5050::OrderNode node;
        node.node_id = id + "-" + std::to_string(order.nodes.size());
        node.sequence_id = 2 * static_cast<std::int64_t>(order.nodes.size());
        node.released = true;
        node.pose = pose;
        node.map_id = map;
        order.nodes.push_back(node);
    };
    add_node(segments.front().start);
    for (const auto& segment : segments) {
        vda5050::OrderEdge edge;
        edge.edge_id = id + "-e" + std::to_string(order.edges.size());
        edge.sequence_id = 2 * static_cast<std::int64_t>(order.edges.size()) + 1;
        edge.released = true;
        edge.segment = segment;
        order.edges.push_back(edge);
        add_node(segment.end);
    }
    for (const char* type : {"adjustToMarker", "measureStop"}) {
        vda5050::Action action;
        action.type = type;
        action.id = id + "-" + type;
        action.stop_target = target;
        order.nodes.back().actions.push_back(action);
    }
    return order;
}

/// One vehicle with its machine, eyes and executor.
class Vehicle {
public:
    Vehicle(const StopFamily& family, const simulation::World& world, std::uint64_t seed,
            const StopRuns& runs)
        : family_(family),
          plant_(world.plant),
          vehicle_(*plant::find_vehicle(plant_, plant::VehicleId(family.vehicle))),
          hall_(plant::find_station(plant_, vehicle_.home)->hall),
          drive_(*plant::find_vehicle_type(plant_, vehicle_.type),
                 simulation::placed_pose(world, vehicle_, seed).value(), seed, runs.time_factor,
                 agent::first_load_kg(world.plant, vehicle_), world.errors),
          cameras_(world, hall_, drive_, true, seed,
                   plant::first_load(world.plant, vehicle_.id) != nullptr),
          receivers_(world, hall_, drive_.type(), drive_.true_pose(), seed),
          senses_(cameras_),
          eyes_(senses_, drive_, runs.spoil_m),
          executor_(drive_, eyes_, hall_.str()),
          estimate_(Pose2{}, localisation::odometry_noise(world.errors.drive, drive_.type())),
          watch_(cameras_, drive_, estimate_),
          light_(receivers_, drive_, estimate_, watch_.trail(), world.errors.receiver) {
        if (family.igps) {
            senses_.use(light_);
            for (const auto& dark : family.dark) receivers_.cover(plant::TransmitterId(dark));
            vda5050::Action transmitters;
            transmitters.type = vda5050::kSetTransmitters;
            transmitters.id = "transmitters";
            transmitters.transmitters = plant_.transmitters;
            executor_.handle(vda5050::InstantActionsMessage{{transmitters}});
        }
        vda5050::Action here;
        here.type = "initPosition";
        here.id = "init";
        here.init_position = vda5050::InitPosition{
            plant::find_station(plant_, vehicle_.home)->pose, hall_.str(), {}};
        executor_.handle(vda5050::InstantActionsMessage{{here}});
        estimate_.start_at(drive_.believed_pose());
    }

    Stop drive_to(int number) {
        const auto& station = *plant::find_station(plant_, number);
        Stop stop;
        stop.station = number;
        const auto plan = kinematics::plan_motion(drive_.type(), drive_.believed_pose(),
                                                  station.pose, plant::MotionMode::kLinear);
        if (!plan) throw std::runtime_error(plan.error().what);
        eyes_.forget();
        const std::string id = "leg-" + std::to_string(++legs_);
        executor_.handle(order_to(id, hall_.str(), plan->segments,
                                  target_at(plant_, station, family_.tolerance_m)));
        double left_s = kPatience_s / drive_.time_factor();
        while (stop.why_not.empty() && !done(id, stop)) {
            step();
            left_s -= kTick_s;
            if (eyes_.looks() > 0) stop.time_s += kTick_s * drive_.time_factor();
            if (left_s < 0) stop.why_not = "not there in time";
        }
        stop.arrived = inverse(station.pose) * eyes_.first();
        stop.off = inverse(station.pose) * drive_.true_pose();
        stop.measured = inverse(station.pose) * eyes_.last().pose;
        stop.sigma_xy_m = eyes_.last().sigma_xy_m;
        stop.sigma_heading_rad = eyes_.last().sigma_heading_rad;
        stop.looks = eyes_.looks();
        return stop;
    }

private:
    /// As server/agent/vehicle.cpp does; the cameras of the others see codes at stops only.
    void step() {
        const double parts = std::ceil(
            family_.igps ? kTick_s * drive_.time_factor() / onboard::LightWatch::kFineStep_s : 1);
        for (int i = 0; i < static_cast<int>(parts); ++i) {
            executor_.step(kTick_s / parts);
            const auto fix = senses_.take_fix();
            if (!family_.igps) continue;
            fix ? estimate_.take(*fix) : estimate_.drive_to(drive_.believed_pose());
            static const std::deque<vda5050::OrderEdge> kNone;
            watch_.step(kTick_s / parts,
                        executor_.acting() ? kNone : executor_.way_ahead().edges());
            light_.step(kTick_s / parts, executor_.transmitters(), true);
        }
    }

    bool done(const std::string& id, Stop& stop) {
        vda5050::StateMessage state;
        executor_.write_state(state);
        for (const auto& error : state.errors) stop.why_not = error.type + ": " + error.description;
        bool finished = false;
        for (const auto& action : state.action_states) {
            if (action.id.rfind(id, 0) != 0) continue;
            if (action.status == vda5050::ActionStatus::kFailed)
                stop.why_not = action.result_description;
            finished |=
                action.type == "measureStop" && action.status == vda5050::ActionStatus::kFinished;
        }
        return finished;
    }

    const StopFamily& family_;
    const plant::Plant& plant_;
    const plant::Vehicle& vehicle_;
    plant::HallId hall_;
    simulation::ServoDrive drive_;
    agent::CameraSensing cameras_;
    simulation::SimulatedReceivers receivers_;
    agent::StopSenses senses_;
    Watched eyes_;
    onboard::Executor executor_;
    onboard::PoseEstimate estimate_;
    onboard::MarkerWatch watch_;
    onboard::LightWatch light_;
    int legs_ = 0;
};

}  // namespace

vda5050::StopTarget target_at(const plant::Plant& plant, const plant::Station& station,
                              double tolerance_m) {
    vda5050::StopTarget target;
    target.station_id = station.id.str();
    target.station_number = station.number;
    target.target = station.pose;
    target.tolerance_x_m = tolerance_m;
    target.tolerance_y_m = tolerance_m;
    target.tolerance_heading_rad = station.tolerance.dheading_rad;
    for (const auto& id : station.markers) {
        const auto& marker = *plant::find_marker(plant, id);
        target.markers.push_back({marker.payload, plant::to_string(marker.kind), marker.size_m,
                                  marker.pose, marker.sigma_xy_m, marker.sigma_heading_rad});
    }
    return target;
}

std::vector<StopFamily> stop_families() {
    StopFamily platform{"platform, QR", "TP-01", {2, 3, 1}};
    platform.demand.words = "Tang: +-10 mm, +-0.15 deg always, mean < 1 mm";
    platform.demand.most_axis_mm = 10;
    platform.demand.most_deg = 0.15;
    platform.demand.mean_mm = 0.85;  // 0.66 measured; with half a millimetre unseen 0.9
    StopFamily mecanum{"Mecanum, iGPS", "OM-01", {2, 3, 6, 4}, true, 0.0004};
    mecanum.plant = "igps-cell";
    mecanum.demand.words = "Wang: +-0.5 mm always";
    mecanum.demand.most_axis_mm = 0.5;
    StopFamily differential{"differential, landmark", "DL-01", {31, 35, 32, 34}, false, 0.002};
    differential.demand.words = "Li 2020: ten times better than 7.58 mm, 2.39 deg";
    differential.demand.mean_mm = 0.758;
    differential.demand.mean_deg = 0.239;
    return {platform, mecanum, differential};
}

std::vector<Stop> run_stops(const StopFamily& family, const std::string& plants,
                            const StopRuns& runs) {
    const auto plant = api::plant_file::load_plant_file(plants + "/" + family.plant + ".json");
    if (!plant) throw std::runtime_error(plant.error().what);
    std::vector<Stop> stops;
    for (int v = 0; v < runs.vehicles; ++v) {
        const std::uint64_t seed = runs.seed + static_cast<std::uint64_t>(v);
        const auto world = simulation::make_world(*plant, seed, runs.errors);
        Vehicle vehicle(family, world, seed, runs);
        for (int i = 0; i < runs.stops; ++i) {
            const auto next = static_cast<std::size_t>(i) % family.stations.size();
            stops.push_back(vehicle.drive_to(family.stations[next]));
            if (!stops.back().why_not.empty()) break;  // a person would look after this one
        }
    }
    return stops;
}

}  // namespace pulseline::experiments
