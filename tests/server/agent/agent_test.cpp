#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "api/json/parse.hpp"
#include "api/vda5050/factsheet.hpp"
#include "api/vda5050/frame.hpp"
#include "api/vda5050/instant_actions.hpp"
#include "api/vda5050/order.hpp"
#include "api/vda5050/state.hpp"
#include "server/agent/hand_held.hpp"
#include "server/agent/simulated_vehicle.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/plant/loads.hpp"
#include "tests/db/temp_folder.hpp"
#include "tests/server/agent/small_hall.hpp"

namespace pulseline::agent {
namespace {

using namespace std::chrono_literals;
using testing::small_plant;
using testing::target_of;

/// A vehicle with analytic eyes and a clock that the test turns.
class VehicleTest : public ::testing::Test {
protected:
    void run(std::chrono::milliseconds time) {
        for (auto t = 0ms; t < time; t += 20ms) {
            now += 20ms;
            simulated.step(0.02, now);
            while (auto frame = vehicle.outbox().take()) {
                if (frame->binary) continue;
                auto read = vda5050::decode_frame(frame->bytes);
                ASSERT_TRUE(read);
                ++sent[read->topic];
                if (read->topic == vda5050::Topic::kState) {
                    state = *vda5050::decode_state(read->payload);
                }
            }
        }
    }
    void send(vda5050::Topic topic, const std::string& payload) {
        vehicle.receive(vda5050::encode_frame(topic, false, payload));
    }
    void instant(const std::string& type, std::optional<vda5050::InitPosition> init = {}) {
        vda5050::Action action;
        action.type = type;
        action.id = "id-" + type;
        action.init_position = init;
        send(vda5050::Topic::kInstantActions,
             vda5050::encode_instant_actions({{action}},
                                             headers.next(vda5050::Topic::kInstantActions, {})));
    }

    simulation::World world = simulation::make_world(small_plant(), 1);
    SimulatedVehicle simulated{world,       world.plant.vehicles[0],
                               {20, 10, 0}, SimulationSettings{1, 10, false, {}, false, {}},
                               {},          nullptr};
    Vehicle& vehicle = simulated.program();
    vda5050::HeaderSource headers{"Tang", "TP-01"};
    Vehicle::Steady::time_point now = Vehicle::Steady::time_point(1h);
    std::map<vda5050::Topic, int> sent;
    vda5050::StateMessage state;
};

TEST_F(VehicleTest, SaysWhoItIsAndReportsCodesButNoPoseAtFirst) {
    run(1000ms);
    EXPECT_TRUE(sent.empty());  // no link yet
    vehicle.link_up();
    run(3000ms);
    EXPECT_EQ(sent[vda5050::Topic::kConnection], 1);
    EXPECT_EQ(sent[vda5050::Topic::kFactsheet], 1);
    EXPECT_GE(sent[vda5050::Topic::kState], 3);
    EXPECT_EQ(sent[vda5050::Topic::kVisualization], 0);
    EXPECT_FALSE(state.position_initialized);
    EXPECT_EQ(vehicle.estimate().pose(), geometry::Pose2{})
        << "nobody has told it, and it does not know truth";
    ASSERT_EQ(state.cameras.size(), 2u);
    EXPECT_EQ(state.cameras[0].payload, "ST01-F");
}

TEST_F(VehicleTest, AfterInitPositionItShowsItsPoseTenTimesASecond) {
    vehicle.link_up();
    instant("initPosition", vda5050::InitPosition{{20, 10, 0}, "hall", ""});
    run(200ms);
    sent.clear();
    run(3000ms);
    EXPECT_TRUE(state.position_initialized);
    EXPECT_NEAR(sent[vda5050::Topic::kVisualization], 30, 2);
    EXPECT_LE(sent[vda5050::Topic::kState], 8);
}

TEST_F(VehicleTest, AMalformedOrderIsRejectedByNameAndMovesNothing) {
    vehicle.link_up();
    send(vda5050::Topic::kOrder,
         R"({"headerId":1,"version":"2.1.0","manufacturer":"Tang","serialNumber":"TP-01",)"
         R"("orderId":"bad","orderUpdateId":0,"nodes":[],"edges":[]})");
    vehicle.receive("nonsense");
    vehicle.receive(std::string(60'000, '['));
    run(200ms);
    ASSERT_GE(state.errors.size(), 2u);
    EXPECT_EQ(state.errors[0].type, "validationError");
    EXPECT_EQ(state.errors[0].references[0].second, "bad");
    EXPECT_FALSE(state.driving);
}

TEST_F(VehicleTest, DrivesOnWithoutALinkToTheEndOfItsBaseAndTellsItAfterwards) {
    vehicle.link_up();
    instant("initPosition", vda5050::InitPosition{{20, 10, 0}, "hall", ""});
    vda5050::OrderMessage order;
    order.order_id = "a";
    order.nodes.resize(2);
    order.edges.resize(1);
    order.edges[0].edge_id = "e";
    order.edges[0].sequence_id = 1;
    order.edges[0].released = true;
    order.edges[0].segment = simulation::testing::straight({20, 10, 0}, 3);
    for (int i = 0; i < 2; ++i) {
        order.nodes[i].node_id = "n" + std::to_string(i);
        order.nodes[i].sequence_id = 2 * i;
        order.nodes[i].released = true;
        order.nodes[i].map_id = "hall";
        order.nodes[i].pose = {20.0 + 3 * i, 10, 0};
    }
    send(vda5050::Topic::kOrder,
         vda5050::encode_order(order, headers.next(vda5050::Topic::kOrder, {})));
    run(100ms);
    EXPECT_TRUE(state.driving);
    vehicle.link_down();
    run(5000ms);
    vehicle.link_up();
    run(100ms);
    EXPECT_FALSE(state.driving);
    EXPECT_EQ(state.last_node_id, "n1");
    EXPECT_NEAR(state.pose->x_m, 23, 1e-4);
}

vda5050::OrderMessage straight_order(const geometry::Pose2& from, double length_m) {
    vda5050::OrderMessage order;
    order.order_id = "a";
    order.nodes.resize(2);
    order.edges.resize(1);
    order.edges[0].edge_id = "e";
    order.edges[0].sequence_id = 1;
    order.edges[0].released = true;
    order.edges[0].segment = simulation::testing::straight(from, length_m);
    for (int i = 0; i < 2; ++i) {
        order.nodes[i].node_id = "n" + std::to_string(i);
        order.nodes[i].sequence_id = 2 * i;
        order.nodes[i].released = true;
        order.nodes[i].map_id = "hall";
        order.nodes[i].pose = from * geometry::Pose2{length_m * i, 0, 0};
    }
    return order;
}

/// Through the link: what the factsheet announces for edges it does, and nothing else.
TEST_F(VehicleTest, DrivesAnEdgePreciselyWhenItIsAskedTo) {
    vehicle.link_up();
    std::vector<std::string> for_edges;
    while (auto frame = vehicle.outbox().take()) {
        const auto read = vda5050::decode_frame(frame->bytes);
        if (!read || read->topic != vda5050::Topic::kFactsheet) continue;
        for (const auto& action : read->payload["protocolFeatures"]["agvActions"]) {
            for (const auto& scope : action["actionScopes"]) {
                if (scope == "EDGE") for_edges.push_back(action["actionType"]);
            }
        }
    }
    EXPECT_EQ(for_edges, (std::vector<std::string>{"observeMarkers", "finePositioning"}));

    instant("initPosition", vda5050::InitPosition{{20, 10, 0}, "hall", ""});
    auto order = straight_order({20, 10, 0}, 12);
    vda5050::Action action;
    action.type = "beep";
    action.id = "on-e";
    action.blocking = vda5050::BlockingType::kNone;
    order.edges[0].actions = {action};
    const auto send_order = [&] {
        send(vda5050::Topic::kOrder,
             vda5050::encode_order(order, headers.next(vda5050::Topic::kOrder, {})));
    };
    send_order();
    run(100ms);
    ASSERT_EQ(state.errors.size(), 1u);
    EXPECT_EQ(state.errors[0].type, "orderError");
    EXPECT_EQ(state.errors[0].references.back().second, "on-e");
    EXPECT_FALSE(state.driving);

    order.edges[0].actions[0].type = "finePositioning";
    send_order();
    run(100ms);
    ASSERT_EQ(state.action_states.size(), 2u) << "and initPosition";
    EXPECT_EQ(state.action_states[0].id, "on-e");
    EXPECT_EQ(state.action_states[0].status, vda5050::ActionStatus::kRunning);
    double fastest_mps = 0;
    for (int i = 0; i < 100 && state.driving; ++i) {
        run(100ms);
        fastest_mps = std::max(fastest_mps, state.velocity_mps);
    }
    EXPECT_NEAR(fastest_mps, 0.3 * 10, 1e-6) << "its time runs ten times as fast";
    EXPECT_EQ(state.action_states[0].status, vda5050::ActionStatus::kFinished);
    EXPECT_EQ(state.last_node_id, "n1");
}

/// The same vehicle on a drive with wheels.
class ServoVehicleTest : public VehicleTest {
protected:
    ServoVehicleTest() {
        auto& type = world.plant.vehicle_types[0];
        const auto wheels = pulseline::testing::platform();
        type.wheels = wheels.wheels;
        type.brackets = wheels.brackets;
        type.mass_kg = wheels.mass_kg;
        type.max_load_kg = wheels.max_load_kg;
        type.slip_sensor = wheels.slip_sensor;
        type.scanners = plant::usual_scanners(type.footprint);
        plant::builders::put_on(world.plant, 0, "A-101", 18000);
    }
    void start(std::vector<Fault> faults, std::vector<vda5050::Action> actions = {}) {
        servo.emplace(world, world.plant.vehicles[0], geometry::Pose2{20, 10, 0},
                      SimulationSettings{1, 10, false, {}, true, std::move(faults)},
                      SimulatedVehicle::Program{}, nullptr);
        servo->program().link_up();
        tell("initPosition", vda5050::InitPosition{{20, 10, 0}, "hall", "", 0.0005, 0.0001});
        auto order = straight_order({20, 10, 0}, 12);
        order.nodes[1].actions = std::move(actions);
        servo->program().receive(vda5050::encode_frame(
            vda5050::Topic::kOrder, false,
            vda5050::encode_order(order, headers.next(vda5050::Topic::kOrder, {}))));
    }
    void tell(const std::string& type, std::optional<vda5050::InitPosition> init = {}) {
        vda5050::Action action;
        action.type = type;
        action.id = "id-" + type;
        action.init_position = init;
        servo->program().receive(vda5050::encode_frame(
            vda5050::Topic::kInstantActions, false,
            vda5050::encode_instant_actions({{action}},
                                            headers.next(vda5050::Topic::kInstantActions, {}))));
    }
    void drive(std::chrono::milliseconds time) {
        for (auto t = 0ms; t < time; t += 20ms) {
            now += 20ms;
            servo->step(0.02, now);
            while (auto frame = servo->program().outbox().take()) {
                if (frame->binary) continue;
                const auto read = vda5050::decode_frame(frame->bytes);
                if (read && read->topic == vda5050::Topic::kState) {
                    state = *vda5050::decode_state(read->payload);
                }
            }
        }
    }
    std::optional<SimulatedVehicle> servo;
};

TEST_F(ServoVehicleTest, DrivesItsOrderAndShowsItsWheels) {
    start({});
    drive(1500ms);
    ASSERT_EQ(state.wheels.size(), 6u);
    for (const auto& wheel : state.wheels) EXPECT_GT(wheel.speed_mps, 0.5) << wheel.name;
    drive(8000ms);
    EXPECT_EQ(state.last_node_id, "n1");
    EXPECT_NEAR(state.pose->x_m, 32, 1e-3);
    EXPECT_TRUE(state.errors.empty());
}

TEST_F(ServoVehicleTest, ASlippingWheelIsAFatalErrorUntilThePersonsCancelIsOver) {
    start({{Fault::Kind::kSlip, "back drive", 0.3, 1.5}});
    drive(8000ms);
    ASSERT_EQ(state.errors.size(), 1u);
    EXPECT_EQ(state.errors[0].type, "wheelSlip");
    EXPECT_TRUE(state.errors[0].fatal);
    EXPECT_FALSE(state.driving);
    EXPECT_LT(state.pose->x_m, 31);
    tell("cancelOrder");
    drive(1000ms);
    EXPECT_TRUE(state.errors.empty());
}

TEST_F(ServoVehicleTest, GoesRoundABoxInTheCorridorOfItsEdgesAndTellsSo) {
    start({{Fault::Kind::kObstacle, "", 0, {30, 10.1}, 0}});
    tell("cancelOrder");
    drive(500ms);
    auto order = straight_order(state.pose.value(), 4);
    order.order_id = "round";
    order.edges[0].corridor = plant::Corridor{4, 4};
    order.nodes.back().allowed_deviation_xy_m = 4;
    for (int i = 1; i < 6; ++i) {
        auto edge = order.edges[0];
        edge.sequence_id = 2 * i + 1;
        edge.segment = simulation::testing::straight(order.nodes.back().pose, 4);
        auto node = order.nodes.back();
        node.node_id = "n" + std::to_string(i + 1);
        node.sequence_id = 2 * i + 2;
        node.pose = edge.segment.end;
        order.edges.push_back(edge);
        order.nodes.push_back(node);
    }
    servo->program().receive(vda5050::encode_frame(
        vda5050::Topic::kOrder, false,
        vda5050::encode_order(order, headers.next(vda5050::Topic::kOrder, {}))));
    bool told = false;
    for (int i = 0; i < 300 && state.last_node_id != "n6"; ++i) {
        drive(100ms);
        for (const auto& error : state.errors) {
            told |= error.type == "going_round";
            EXPECT_FALSE(error.fatal) << error.type;
        }
    }
    EXPECT_TRUE(told);
    drive(1000ms);
    EXPECT_EQ(state.last_node_id, "n6");
    EXPECT_LT(distance(state.pose->position(), order.nodes.back().pose.position()), 0.01);
    EXPECT_TRUE(state.errors.empty());
}

TEST_F(ServoVehicleTest, SetsItsBracketsAtANodeAndReportsTheirLoads) {
    const auto set = [](const std::string& id, const std::string& bracket, double height_m) {
        vda5050::Action action;
        action.type = "setBracketHeight";
        action.id = id;
        action.params = {{"bracket", bracket}, {"height_m", height_m}};
        return action;
    };
    start({}, {set("up", "all", 0.05), set("one", "front left", 0.25)});
    drive(15000ms);
    ASSERT_EQ(state.brackets.size(), 4u);
    std::map<std::string, vda5050::ActionState> actions;
    for (const auto& action : state.action_states) actions[action.id] = action;
    EXPECT_EQ(actions["up"].status, vda5050::ActionStatus::kFinished);
    EXPECT_EQ(actions["one"].status, vda5050::ActionStatus::kFailed);
    EXPECT_EQ(actions["one"].result_description.rfind("bracket_force_out_of_range", 0), 0u);
    double force_n = 0;
    for (const auto& bracket : state.brackets) force_n += bracket.force_a_n + bracket.force_b_n;
    EXPECT_NEAR(force_n, 18000 * 9.80665, 2000);
}

TEST_F(ServoVehicleTest, LearnsOnFromWhatItHadLearnedBeforeItsStart) {
    const db::TempFolder folder;
    std::vector<std::size_t> learned;
    for (int start = 0; start < 2; ++start) {
        SimulatedVehicle::Program program;
        program.learned = folder.path();
        servo.emplace(world, world.plant.vehicles[0], geometry::Pose2{20.04, 9.985, 0.003},
                      SimulationSettings{1, 10, false, {}, true, {}}, program, nullptr);
        servo->program().link_up();
        tell("initPosition", vda5050::InitPosition{{20, 10, 0}, "hall", "", 0.002, 0.001});
        vda5050::Action adjust;
        adjust.type = "adjustToMarker";
        adjust.id = "adjust";
        adjust.stop_target = target_of(world.plant);
        auto order = straight_order({20, 10, 0}, 12);
        order.nodes.resize(1);
        order.edges.clear();
        order.nodes[0].actions = {adjust};
        servo->program().receive(vda5050::encode_frame(
            vda5050::Topic::kOrder, false,
            vda5050::encode_order(order, headers.next(vda5050::Topic::kOrder, {}))));
        drive(20000ms);
        ASSERT_EQ(state.action_states.size(), 2u);  // the other one is initPosition
        EXPECT_EQ(state.action_states[0].status, vda5050::ActionStatus::kFinished)
            << state.action_states[0].result_description;
        const auto kept = LearnedMoves(folder.path(), "TP-01").load();
        ASSERT_TRUE(kept);
        learned.push_back(kept->passes().size());
    }
    EXPECT_GT(learned[0], 0u);
    EXPECT_GT(learned[1], learned[0]);
}

TEST_F(ServoVehicleTest, ADeadEncoderIsReportedAsAFaultOfItsWheel) {
    start({{Fault::Kind::kEncoder, "front drive", 0, 1.5}});
    drive(5000ms);
    ASSERT_EQ(state.errors.size(), 1u);
    EXPECT_EQ(state.errors[0].type, "wheelFault");
    EXPECT_EQ(state.wheels[4].fault, "drive_fault");
    EXPECT_FALSE(state.driving);
}

json::Json hand_held(Vehicle& vehicle, const std::string& line) {
    const auto answer = json::parse_json(answer_hand_held({&vehicle}, line));
    EXPECT_TRUE(answer) << "an answer is a line of JSON";
    return answer.value_or(json::Json());
}

TEST_F(VehicleTest, AHandHeldControlIsAnsweredAndRefusedInWords) {
    EXPECT_EQ(hand_held(vehicle, R"({"do":"where"})")["operating_mode"], "AUTOMATIC");
    EXPECT_FALSE(hand_held(vehicle, R"({"do":"where"})").contains("pose")) << "nobody has said it";
    const struct {
        const char* line;
        const char* reason;
    } bad[] = {{R"({"do":"drive","vx_mps":0.1})", "not_in_hand"},
               {R"({"do":"give_back"})", "not_in_hand"},
               {R"({"do":"dance"})", "not_one_of"},
               {R"({"do":"take","vehicle":"Nobody/X"})", "unknown_vehicle"}};
    for (const auto& [line, reason] : bad) {
        const auto answer = hand_held(vehicle, line);
        EXPECT_EQ(answer["ok"], false) << line;
        EXPECT_EQ(answer["reason"], reason) << line;
        EXPECT_FALSE(answer["why"].get<std::string>().empty());
    }
    for (const char* line : {"", "[", "{}", R"({"do":7})", R"({"do":"drive","vx_mps":1e9})",
                             R"({"do":"drive","vx_mps":"fast"})", R"({"do":"take","more":1})"}) {
        EXPECT_EQ(hand_held(vehicle, line)["ok"], false) << line;
    }
    EXPECT_FALSE(vehicle.executor().in_hand()) << "nothing of that took it";
    EXPECT_EQ(hand_held(vehicle, R"({"do":"take"})")["operating_mode"], "MANUAL");
    run(100ms);
    EXPECT_EQ(hand_held(vehicle, R"({"do":"give_back"})")["operating_mode"], "AUTOMATIC");
}

TEST_F(VehicleTest, APageAndAControlBesideItAreTwoAndItsStatesSayWhoHasIt) {
    vehicle.link_up();
    const auto by_page = [&](const char* control, const char* person,
                             vda5050::HandCommand::What what) {
        vda5050::HandCommand command;
        command.what = what;
        command.sequence = 7;
        vehicle.receive(vda5050::encode_frame(
            vda5050::Topic::kHandHeld, false,
            vda5050::encode_hand_frame({control, person, command},
                                       headers.next(vda5050::Topic::kHandHeld, {}))));
    };
    using What = vda5050::HandCommand::What;
    run(2s);
    EXPECT_FALSE(state.in_hand_of);
    by_page("h1", "ann", What::kTake);
    run(2s);
    EXPECT_EQ(state.operating_mode, "MANUAL");
    EXPECT_EQ(state.in_hand_of, "ann");
    EXPECT_EQ(sent[vda5050::Topic::kHandHeld], 1) << "it answers";
    EXPECT_EQ(hand_held(vehicle, R"({"do":"take"})")["params"]["person"], "ann");
    EXPECT_FALSE(hand_held(vehicle, R"({"do":"where"})").contains("mine"));

    by_page("h1", "ann", What::kLeft);
    EXPECT_EQ(hand_held(vehicle, R"({"do":"take"})")["mine"], true);
    run(2s);
    EXPECT_EQ(state.in_hand_of, "") << "somebody beside it";
    by_page("h1", "ann", What::kGiveBack);
    run(1s);
    EXPECT_EQ(state.operating_mode, "MANUAL") << "not hers any more";
    hand_held(vehicle, R"({"do":"give_back"})");
    run(1s);
    EXPECT_FALSE(state.in_hand_of);
}

}  // namespace
}  // namespace pulseline::agent
