#pragma once

#include <random>

#include "core/fleet/state/ports.hpp"

/// Records with every field set to something that a lossy column would change.
namespace pulseline::db {

using geometry::Pose2;

class Samples {
public:
    explicit Samples(std::uint64_t seed) : ids_(seed), random_(seed) {}

    Time at(std::int64_t ms) const { return time_from_ns(kStart_ns + ms * 1'000'000 + 123'457); }
    double number() { return std::uniform_real_distribution<double>(-100, 100)(random_) / 3.0; }
    Pose2 pose() { return {number(), number(), number() / 40}; }

    fleet::JobOrder order(std::int64_t number_of_order, std::int64_t ms) {
        fleet::JobOrder o;
        o.id = fleet::JobOrderId(ids_.next(at(ms)));
        o.number = number_of_order;
        o.client_order_id = "mes-" + std::to_string(number_of_order);
        o.wanted_vehicle = plant::VehicleId("TP-01");
        o.assigned_vehicle = plant::VehicleId("TP-01");
        o.priority = -7;
        for (const char* station : {"st02", "st03"}) {
            fleet::Step step;
            step.station = plant::StationId(station);
            step.mode = plant::MotionMode::kFixedAxisRotation;
            o.steps.push_back(step);
        }
        o.steps[0].state = fleet::StepState::kDone;
        o.steps[0].leg = fleet::LegId(ids_.next(at(ms)));
        o.steps[0].stop = fleet::StopRecordId(ids_.next(at(ms)));
        o.steps[0].attempts = 2;
        o.current_step = 1;
        o.state = fleet::JobState::kRunning;
        o.pause_requested = true;
        o.reason = {"waits_for",
                    {{"vehicle", std::string("TP-02")},
                     {"since_s", 1.0},
                     {"n", std::int64_t{3}},
                     {"again", true}}};
        o.created_by = "Jürgen \"J\" O'Neil";
        o.created = at(ms);
        o.started = at(ms + 1);
        o.steps[1].planned_s = 12.5;
        o.expected = at(ms + 13'000);
        o.revision = 4;
        o.wanted_type = plant::VehicleTypeId("steered-platform");
        o.earliest_start = at(ms + 100);
        o.due = at(ms + 200'000);
        o.after = {{fleet::JobOrderId(ids_.next(at(ms))), 41, fleet::JobState::kEnded},
                   {fleet::JobOrderId(ids_.next(at(ms))), 42, std::nullopt}};
        o.sequence = "left \"wing\"";
        o.sequence_vehicle = plant::VehicleId("TP-01");
        o.from_template = "to station";
        o.from_schedule = fleet::ScheduleId(ids_.next(at(ms)));
        o.stop_requested = true;
        o.removed = false;
        o.steps[1].before = {{"raiseParking", {}}, {"setBracketHeight", {{"height_m", number()}}}};
        o.steps[1].after = {{"lowerParking", {{"name", std::string("all")}, {"slow", true}}}};
        o.steps[1].phase = fleet::StepPhase::kAfter;
        o.steps[1].actions_done = 1;
        return o;
    }

    fleet::Schedule schedule(const std::string& name, std::int64_t ms) {
        fleet::Schedule s;
        s.id = fleet::ScheduleId(ids_.next(at(ms)));
        s.name = name;
        s.recurrence.daily_at_s = {60, 7200};
        s.recurrence.time_zone = "Europe/Berlin";
        s.recurrence.window = std::chrono::seconds(900);
        s.recurrence.from = at(ms);
        s.recurrence.until = at(ms + 86'400'000);
        s.order.vehicle = plant::VehicleId("TP-01");
        s.order.vehicle_type = plant::VehicleTypeId("steered-platform");
        s.order.priority = 5;
        s.order.start = false;
        s.order.sequence = "wing";
        s.order.steps = {{7,
                          plant::MotionMode::kLateral,
                          {{"raiseParking", {{"n", std::int64_t{3}}}}},
                          {{"lowerParking", {}}}}};
        s.paused = true;
        s.next = at(ms + 60'000);
        s.newest_order = fleet::JobOrderId(ids_.next(at(ms)));
        s.made = 12;
        s.skipped = 3;
        s.last_skip = {"previous_order_open", {{"order", std::string("JO-7")}}};
        s.created_by = "mes";
        s.created = at(ms);
        s.revision = 9;
        return s;
    }

    fleet::StopRecord stop(int station_number, std::int64_t ms) {
        fleet::StopRecord s;
        s.id = fleet::StopRecordId(ids_.next(at(ms)));
        s.order = fleet::JobOrderId(ids_.next(at(ms)));
        s.leg = fleet::LegId(ids_.next(at(ms)));
        s.step = 1;
        s.vehicle = plant::VehicleId("TP-01");
        s.station = plant::StationId("st0" + std::to_string(station_number));
        s.station_number = station_number;
        s.theoretical = pose();
        s.measured = pose();
        for (double* value : {&s.dx_m, &s.dy_m, &s.dheading_rad, &s.along_m, &s.left_m,
                              &s.sigma_xy_m, &s.sigma_heading_rad, &s.load_kg, &s.tolerance.dx_m}) {
            *value = number();
        }
        s.tolerance.shape = plant::Tolerance::Shape::kEllipse;
        s.inside = true;
        s.attempt = 3;
        s.method = "dual_camera";
        s.markers = {"ST02-F", "ST02-B"};
        s.load = plant::LoadId("A-101");
        s.at = at(ms);
        s.arrival = fleet::Arrival{number(), number(), number(), number(), number()};
        return s;
    }

    fleet::Event event(std::int64_t seq, std::int64_t ms) {
        fleet::Event e;
        e.seq = seq;
        e.at = at(ms);
        e.type = "job_order.created";
        e.order = fleet::JobOrderId(ids_.next(at(ms)));
        e.vehicle = plant::VehicleId("TP-01");
        e.actor = "mes";
        e.params = {{"x_m", number()}, {"whole", 2.0}, {"count", std::int64_t{-5}}};
        return e;
    }

    fleet::VehicleRecord vehicle(const std::string& id) {
        fleet::VehicleRecord v;
        v.id = plant::VehicleId(id);
        v.pose_known = true;
        v.pose = pose();
        v.hall = "h1";
        v.claim = fleet::Whereabouts{pose(), "h2"};
        v.at_station = plant::StationId("st01");
        v.needs_resume = true;
        v.needs_resume_reason = {"server_restarted", {{"at", std::int64_t{5}}}};
        v.paused = fleet::Pause{"ann", at(7), true};
        v.basis = fleet::PoseBasis{fleet::PoseBasis::Kind::kStatement, plant::StationId("st07"),
                                   "eva", at(9), number()};
        v.integration = fleet::Integration::kNotice;
        v.last_stop = fleet::StopRecordId(ids_.next(at(0)));
        v.last_stop_station = plant::StationId("st01");
        v.last_stop_inside = true;
        v.has_leg = true;
        v.leg_data = leg();
        v.leg = v.leg_data.id;
        return v;
    }

    fleet::Leg leg() {
        fleet::Leg leg;
        leg.id = fleet::LegId(ids_.next(at(0)));
        leg.order = fleet::JobOrderId(ids_.next(at(0)));
        leg.step = 1;
        leg.vehicle = plant::VehicleId("TP-01");
        leg.station = plant::StationId("st02");
        leg.mode = plant::MotionMode::kFixedAxisRotation;
        leg.hall = "main";
        leg.update_id = 2;
        leg.released_nodes = 2;
        leg.duration_s = number();
        leg.attempt = 2;
        for (int i = 0; i < 3; ++i) {
            vda5050::OrderNode node;
            node.node_id = "n" + std::to_string(i);
            node.sequence_id = 2 * i;
            node.released = i < 2;
            node.pose = pose();
            node.has_heading = i != 1;
            node.allowed_deviation_xy_m = number();
            node.map_id = "main";
            leg.nodes.push_back(node);
        }
        vda5050::Action action;
        action.type = "measureStop";
        action.id = "a-1";
        action.blocking = vda5050::BlockingType::kSoft;
        action.params = {{"z", number()}, {"a", std::string("text")}};
        action.stop_target = vda5050::StopTarget{"st02",
                                                 2,
                                                 pose(),
                                                 number(),
                                                 number(),
                                                 number(),
                                                 {{"ST02-F", "qr", 0.06, pose(), number()}}};
        action.init_position = vda5050::InitPosition{pose(), "main", "n0"};
        leg.nodes[2].actions.push_back(action);
        for (int i = 0; i < 2; ++i) {
            vda5050::OrderEdge edge;
            edge.edge_id = "e" + std::to_string(i);
            edge.sequence_id = 2 * i + 1;
            edge.released = i == 0;
            edge.max_speed_mps = number();
            edge.segment = {kinematics::Segment::Kind::kArc,
                            pose(),
                            pose(),
                            number(),
                            number(),
                            number(),
                            {number(), number()},
                            number()};
            leg.edges.push_back(edge);
        }
        return leg;
    }

private:
    static constexpr std::int64_t kStart_ns = 1'790'000'000'000'000'000;

    IdSource ids_;
    std::mt19937_64 random_;
};

}  // namespace pulseline::db
