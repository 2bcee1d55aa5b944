#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "api/vda5050/connection.hpp"
#include "api/vda5050/factsheet.hpp"
#include "api/vda5050/frame.hpp"
#include "api/vda5050/instant_actions.hpp"
#include "api/vda5050/order.hpp"
#include "api/vda5050/state.hpp"
#include "api/vda5050/visualization.hpp"
#include "tests/api/vda5050/samples.hpp"

namespace pulseline::vda5050 {
namespace {

using testing::header;

std::string factsheet_text() {
    const auto type = testing::vehicle_type();
    FactsheetSource source;
    source.type = &type;
    source.time_factor = 10;
    source.node_actions = {"measureStop", "adjustToMarker"};
    source.edge_actions = {"observeMarkers"};
    source.instant_actions = {"cancelOrder", "initPosition", "measureStop"};
    return encode_factsheet(source, header());
}

Json parsed(const std::string& text) {
    const auto value = json::parse_json(text, {32, 100'000});
    EXPECT_TRUE(value);
    return value.value_or(Json());
}

TEST(Order, RoundTripKeepsNodesAndActions) {
    const auto sent = testing::order();
    const auto read = decode_order(parsed(encode_order(sent, header())));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->order_id, sent.order_id);
    EXPECT_EQ(read->order_update_id, 3);
    ASSERT_EQ(read->nodes.size(), sent.nodes.size());
    EXPECT_EQ(read->nodes[0].map_id, "hall-1");
    EXPECT_EQ(read->nodes[1].sequence_id, 6);
    EXPECT_FALSE(read->nodes.back().released);
    EXPECT_EQ(read->edges[0].max_speed_mps, 0.4);
    EXPECT_EQ(read->edges[0].corridor, (plant::Corridor{1.4, 0.9}));
    EXPECT_FALSE(read->edges[1].corridor);
    const auto& action = read->nodes.back().actions.at(1);
    EXPECT_EQ(action.type, "measureStop");
    ASSERT_TRUE(action.stop_target);
    const auto expected = testing::stop_target();
    EXPECT_EQ(action.stop_target->target, expected.target);
    EXPECT_EQ(action.stop_target->station_number, 2);
    EXPECT_EQ(action.stop_target->tolerance_heading_rad, 0.0035);
    ASSERT_EQ(action.stop_target->markers.size(), 2u);
    EXPECT_EQ(action.stop_target->markers[1].pose, expected.markers[1].pose);
    EXPECT_EQ(action.stop_target->markers[1].sigma_rad, expected.markers[1].sigma_rad);
}

TEST(Order, AnEdgeMayAskToObserveMarkers) {
    const auto message = parsed(encode_order(testing::order(), header()));
    const auto read = decode_order(message);
    ASSERT_TRUE(read) << read.error().what;
    ASSERT_EQ(read->edges[0].actions.size(), 1u);
    const auto& action = read->edges[0].actions[0];
    const auto expected = testing::order().edges[0].actions[0];
    EXPECT_EQ(action.type, "observeMarkers");
    EXPECT_EQ(action.id, expected.id);
    EXPECT_EQ(action.blocking, BlockingType::kNone);
    ASSERT_EQ(action.markers.size(), expected.markers.size());
    EXPECT_EQ(action.markers[1].payload, expected.markers[1].payload);
    EXPECT_EQ(action.markers[1].pose, expected.markers[1].pose);
    EXPECT_EQ(action.markers[1].sigma_rad, expected.markers[1].sigma_rad);
    EXPECT_EQ(action.segment_markers, expected.segment_markers);
    EXPECT_EQ(action.boundary_marker, expected.boundary_marker);
    EXPECT_TRUE(read->edges[1].actions.empty());
}

/// Whether the vehicle can do it is the vehicle's to say.
TEST(Order, AnEdgeMayAskForAnyActionThatIsWellFormed) {
    auto sent = testing::order();
    Action beep;
    beep.type = "beep";
    beep.id = "leg-1-e1-beep";
    beep.blocking = BlockingType::kSoft;
    beep.params = {{"loud", true}, {"times", std::int64_t{3}}};
    sent.edges[1].actions = {beep};
    auto message = parsed(encode_order(sent, header()));
    const auto read = decode_order(message);
    ASSERT_TRUE(read) << read.error().what;
    ASSERT_EQ(read->edges[1].actions.size(), 1u);
    const auto& action = read->edges[1].actions[0];
    EXPECT_EQ(action.type, "beep");
    EXPECT_EQ(action.id, beep.id);
    EXPECT_EQ(action.blocking, BlockingType::kSoft);
    ASSERT_EQ(action.params.size(), 2u);
    EXPECT_EQ(std::get<bool>(action.params[0].value), true);
    EXPECT_EQ(std::get<std::int64_t>(action.params[1].value), 3);
    EXPECT_EQ(read->edges[0].actions.size(), 1u) << "each edge keeps its own";

    auto& actions = message["edges"][1]["actions"];
    actions[0]["blockingType"] = "LATER";
    EXPECT_EQ(decode_order(message).error().field, "/edges/1/actions/0/blockingType");
    actions[0]["blockingType"] = "NONE";
    actions[0].erase("actionId");
    EXPECT_EQ(decode_order(message).error().field, "/edges/1/actions/0/actionId");
    actions[0]["actionId"] = "again";
    const Json one = actions[0];
    while (actions.size() <= 100) actions.push_back(one);
    EXPECT_EQ(decode_order(message).error().field, "/edges/1/actions");
}

TEST(Order, NamesOfMarkersThatTheWayReliesOnAreOptional) {
    auto sent = testing::order();
    auto& observe = sent.edges[0].actions[0];
    observe.segment_markers.clear();
    observe.boundary_marker.clear();
    const std::string text = encode_order(sent, header());
    EXPECT_EQ(text.find("segmentMarkers"), std::string::npos);
    EXPECT_EQ(text.find("boundaryMarker"), std::string::npos);
    const auto read = decode_order(parsed(text));
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->edges[0].actions[0].segment_markers.empty());
    EXPECT_TRUE(read->edges[0].actions[0].boundary_marker.empty());
}

TEST(Order, ACorridorOfTheCentreAloneIsNone) {
    auto message = parsed(encode_order(testing::order(), header()));
    message["edges"][0]["corridor"]["corridorRefPoint"] = "KINEMATICCENTER";
    const auto read = decode_order(message);
    ASSERT_TRUE(read);
    EXPECT_FALSE(read->edges[0].corridor);
}

TEST(InstantActions, RoundTripAndNumbersAsText) {
    Json message = parsed(encode_instant_actions(testing::instant_actions(), header()));
    const auto read = decode_instant_actions(message);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->actions[0].params.size(), 3u);
    EXPECT_EQ(read->actions[1].init_position->pose, (geometry::Pose2{1.5, -2, 0.3}));
    EXPECT_EQ(read->actions[1].init_position->last_node_id, "st01");
    EXPECT_EQ(read->actions[1].init_position->sigma_xy_m, 0.005);
    EXPECT_EQ(read->actions[1].init_position->sigma_heading_rad, 0.001);
    EXPECT_TRUE(read->actions[1].init_position->worked_out);
    for (auto& parameter : message["actions"][1]["actionParameters"]) {
        if (parameter["key"] == "x") parameter["value"] = "1.5";
    }
    ASSERT_TRUE(decode_instant_actions(message));
    for (auto& parameter : message["actions"][1]["actionParameters"]) {
        if (parameter["key"] == "x") parameter["value"] = "1.5 m";
    }
    const auto wrong = decode_instant_actions(message);
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().field, "/actions/1/actionParameters/x");
}

TEST(State, RoundTripKeepsWhatTheServerUses) {
    const auto sent = testing::state();
    const auto read = decode_state(parsed(encode_state(sent, header())));
    ASSERT_TRUE(read) << read.error().what;
    EXPECT_EQ(read->header_id, 7);
    EXPECT_EQ(read->order_id, "leg-1");
    EXPECT_EQ(read->last_node_sequence_id, 6);
    ASSERT_EQ(read->node_states.size(), 2u);
    EXPECT_FALSE(read->node_states[1].released);
    EXPECT_EQ(read->edge_states[1].node_id, "e2");
    EXPECT_EQ(*read->pose, *sent.pose);
    EXPECT_TRUE(read->driving && read->paused && read->new_base_request);
    EXPECT_EQ(read->velocity_mps, -0.3);
    EXPECT_EQ(read->battery_percent, 81.5);
    ASSERT_TRUE(read->action_states[0].measurement);
    EXPECT_EQ(read->action_states[0].measurement->pose, sent.action_states[0].measurement->pose);
    EXPECT_EQ(read->action_states[0].measurement->markers.size(), 2u);
    EXPECT_EQ(read->action_states[0].measurement->arrived,
              sent.action_states[0].measurement->arrived);
    EXPECT_EQ(read->action_states[1].status, vda5050::ActionStatus::kFailed);
    EXPECT_EQ(read->action_states[1].result_description, "no_marker_in_view");
    EXPECT_EQ(read->errors[0].references, sent.errors[0].references);
    EXPECT_EQ(read->brackets[0].force_a_n, 27000.5);
    EXPECT_EQ(read->brackets[0].height_m, 0.125);
    EXPECT_FALSE(read->brackets[1].height_m);
    EXPECT_EQ(read->wheels[1].fault, "overheated");
    EXPECT_EQ(read->cameras[0].code, sent.cameras[0].code);
    EXPECT_EQ(read->cameras[1].why_not, "no_code");
    EXPECT_EQ(read->parking_feet[0].extension_m, 0.1);
    EXPECT_EQ(read->parking_feet[0].force_n, 52300);
    EXPECT_FALSE(read->parking_feet[1].force_n);
    EXPECT_EQ(read->load_kg, 11000);
}

TEST(State, AVehicleWithoutAPoseSendsNone) {
    auto sent = testing::state();
    sent.pose.reset();
    const Json message = parsed(encode_state(sent, header()));
    EXPECT_FALSE(message.contains("agvPosition"));
    EXPECT_FALSE(decode_state(message)->pose);
}

struct Fault {
    const char* field;
    std::function<void(Json&)> make;
};

TEST(State, FaultsAreNamedByTheirField) {
    const std::vector<Fault> faults{
        {"/orderId", [](Json& m) { m.erase("orderId"); }},
        {"/headerId", [](Json& m) { m["headerId"] = -1; }},
        {"/headerId", [](Json& m) { m["headerId"] = "7"; }},
        {"/operatingMode", [](Json& m) { m["operatingMode"] = "DANCING"; }},
        {"/nodeStates", [](Json& m) { m["nodeStates"] = Json::object(); }},
        {"/nodeStates/1/sequenceId", [](Json& m) { m["nodeStates"][1].erase("sequenceId"); }},
        {"/agvPosition/x", [](Json& m) { m["agvPosition"]["x"] = "11"; }},
        {"/agvPosition/theta", [](Json& m) { m["agvPosition"]["theta"] = nullptr; }},
        {"/batteryState/batteryCharge", [](Json& m) { m["batteryState"]["batteryCharge"] = 101; }},
        {"/safetyState", [](Json& m) { m.erase("safetyState"); }},
        {"/actionStates/0/actionStatus",
         [](Json& m) { m["actionStates"][0]["actionStatus"] = "DONE"; }},
        {"/errors/0/errorLevel", [](Json& m) { m["errors"][0]["errorLevel"] = "LOW"; }},
    };
    for (const auto& fault : faults) {
        Json message = parsed(encode_state(testing::state(), header()));
        fault.make(message);
        const auto read = decode_state(message);
        ASSERT_FALSE(read) << fault.field;
        EXPECT_EQ(read.error().field, fault.field);
    }
}

TEST(State, UnknownFieldsAndForeignInformationAreTakenCalmly) {
    Json message = parsed(encode_state(testing::state(), header()));
    message["vendorSpecific"] = {{"deep", {1, 2}}};
    message["information"].push_back(
        {{"infoType", "wheel"},
         {"infoLevel", "DEBUG"},
         {"infoReferences",
          {{{"referenceKey", "name"}, {"referenceValue", "X"}},
           {{"referenceKey", "steering_rad"}, {"referenceValue", "left"}}}}});
    message["information"].push_back({{"infoType", "coffee"}, {"infoLevel", "INFO"}});
    message["actionStates"][0]["actionStatus"] = "PAUSED";  // in the text, not in the schema
    const auto read = decode_state(message);
    ASSERT_TRUE(read) << read.error().what;
    EXPECT_EQ(read->wheels.size(), 2u);
    EXPECT_EQ(read->action_states[0].status, vda5050::ActionStatus::kPaused);
}

TEST(State, AForeignResultDescriptionIsKeptAsText) {
    auto sent = testing::state();
    sent.action_states[0].measurement.reset();
    sent.action_states[0].result_description = "well done";
    const auto read = decode_state(parsed(encode_state(sent, header())));
    ASSERT_TRUE(read);
    EXPECT_FALSE(read->action_states[0].measurement);
    EXPECT_EQ(read->action_states[0].result_description, "well done");
}

TEST(State, AMeasurementThatCannotBeOneFailsTheStopAndNotTheMessage) {
    auto sent = testing::state();
    sent.action_states[0].measurement->pose.x_m = 1e300;
    const auto read = decode_state(parsed(encode_state(sent, header())));
    ASSERT_TRUE(read);
    EXPECT_FALSE(read->action_states[0].measurement);
    EXPECT_TRUE(read->action_states[0].result_description.starts_with("/x_m: "))
        << read->action_states[0].result_description;
}

TEST(State, ANumberThatIsNoneIsAnErrorOfItsMessage) {
    auto state = testing::state();
    state.cameras[0].code.x_m = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)encode_state(state, header()), NotFinite);
    auto order = testing::order();
    order.nodes[2].pose.y_m = -std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)encode_order(order, header()), NotFinite);
}

TEST(Factsheet, ATopSpeedThatIsNoneIsRefused) {
    auto message = parsed(factsheet_text());
    for (const double speed : {5e-324, 1e-300, 1e-6, 1e4, 1e300, -1.0}) {
        message["physicalParameters"]["speedMax"] = speed;
        const auto read = decode_factsheet(message);
        ASSERT_FALSE(read) << speed;
        EXPECT_EQ(read.error().field, "/physicalParameters/speedMax");
    }
    message["physicalParameters"]["speedMax"] = 0;  // not told
    EXPECT_TRUE(decode_factsheet(message));
}

TEST(Factsheet, SaysHeightAndCodesOfItsOwnType) {
    plant::VehicleType type;
    type.footprint = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    type.height_m = 0.42;
    bool has_map = false;
    const auto told = [&] {
        FactsheetSource source;
        source.type = &type;
        source.has_map = has_map;
        return parsed(encode_factsheet(source, header()));
    };
    EXPECT_EQ(told()["physicalParameters"]["heightMax"], 0.42);
    EXPECT_EQ(told()["typeSpecification"]["localizationTypes"], Json::array()) << "no camera";
    type.cameras.emplace_back();
    type.usual_code.kind = plant::MarkerKind::kLandmark;
    EXPECT_EQ(told()["typeSpecification"]["localizationTypes"], Json::array());
    type.usual_code.kind = plant::MarkerKind::kQr;
    EXPECT_EQ(told()["typeSpecification"]["localizationTypes"], Json::array({"DMC"}));
    type.navigation_scanner = plant::NavigationScanner{};
    EXPECT_EQ(told()["typeSpecification"]["localizationTypes"], Json::array({"DMC", "REFLECTOR"}));
    has_map = true;
    EXPECT_EQ(told()["typeSpecification"]["localizationTypes"],
              Json::array({"DMC", "NATURAL", "REFLECTOR"}));
}

TEST(Others, VisualizationConnectionAndFactsheetRoundTrip) {
    const vda5050::VisualizationMessage shown{{1, 2, 3}, true, 0.4, -0.1};
    const auto read = decode_visualization(parsed(encode_visualization(shown, "hall-1", header())));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->pose, shown.pose);
    EXPECT_EQ(read->turn_rate_radps, -0.1);
    for (const auto state : {vda5050::ConnectionState::kOnline, vda5050::ConnectionState::kOffline,
                             vda5050::ConnectionState::kConnectionBroken}) {
        EXPECT_EQ(*decode_connection(parsed(encode_connection(state, header()))), state);
    }
    const auto factsheet = decode_factsheet(parsed(factsheet_text()));
    ASSERT_TRUE(factsheet);
    EXPECT_EQ(factsheet->speed_max_mps, 5);
    EXPECT_EQ(factsheet->acceleration_max_mps2, 10);
    EXPECT_EQ(factsheet->length_m, 10.5);
    EXPECT_EQ(factsheet->actions.size(), 5u);
    // What only an edge may ask for is no step's action.
    EXPECT_EQ(factsheet->node_actions, (std::vector<std::string>{"measureStop", "adjustToMarker"}));
    EXPECT_EQ(parsed(factsheet->json), parsed(factsheet_text()));
}

TEST(Header, CountsEachTopicApartAndKnowsItsVersion) {
    HeaderSource source("Tang", "TP-01");
    const Time now = time_from_ns(1'769'860'800'123'000'000);
    EXPECT_EQ(source.next(Topic::kState, now).header_id, 0);
    EXPECT_EQ(source.next(Topic::kState, now).header_id, 1);
    EXPECT_EQ(source.next(Topic::kConnection, now).header_id, 0);
    EXPECT_EQ(timestamp(now), "2026-01-31T12:00:00.123Z");
    Json message = begin_message(header());
    EXPECT_EQ(decode_header(message)->serial_number, "TP-01");
    message["version"] = "3.0.0";
    EXPECT_EQ(decode_header(message).error().field, "/version");
    message.erase("manufacturer");
    EXPECT_EQ(decode_header(message).error().field, "/manufacturer");
}

TEST(Frame, PayloadTravelsByteForByte) {
    const std::string payload = encode_connection(vda5050::ConnectionState::kOnline, header());
    const std::string text = encode_frame(Topic::kConnection, true, payload);
    EXPECT_NE(text.find(payload), std::string::npos);
    const auto frame = decode_frame(text);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->topic, Topic::kConnection);
    EXPECT_TRUE(frame->retain);
    EXPECT_EQ(print(frame->payload), payload);
}

TEST(Frame, HostileTextIsRefused) {
    EXPECT_EQ(decode_frame(std::string(300'000, '[')).error().reason.code, "json_too_deep");
    EXPECT_FALSE(decode_frame("hello"));
    EXPECT_FALSE(decode_frame(R"({"topic":"state","payload":{"x":1e999}})"));
    EXPECT_EQ(decode_frame(R"({"topic":"weather","payload":{}})").error().field, "/topic");
    EXPECT_EQ(decode_frame(R"({"topic":"state","payload":[]})").error().field, "/payload");
    EXPECT_EQ(decode_frame(R"({"topic":"state"})").error().field, "/payload");
    EXPECT_FALSE(decode_frame(R"({"topic":"state","topic":"order","payload":{}})"));
}

TEST(CameraFrame, RoundTripAndLimits) {
    const std::string picture("\xff\xd8\0jpeg", 7);
    const CameraFrame sent{"front", "2026-01-31T12:00:00.123Z", "image/jpeg", picture};
    const auto frame = encode_camera_frame(sent);
    ASSERT_TRUE(frame);
    const auto read = decode_camera_frame(*frame);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->camera, "front");
    EXPECT_EQ(read->bytes, picture);
    const std::string large(kMaxCameraFrame, 'x');
    EXPECT_FALSE(encode_camera_frame({"front", "t", "image/jpeg", large}));
    EXPECT_FALSE(decode_camera_frame("abc"));
    EXPECT_FALSE(decode_camera_frame(std::string("\xff\xff\xff\xff{}", 6)));
    EXPECT_FALSE(decode_camera_frame(std::string("\x02\0\0\0{}", 6)));  // no camera named
}

/// Files for validate_samples.mjs, which holds them against the official schemas.
TEST(Samples, AreWrittenForTheSchemaCheck) {
    const std::filesystem::path folder = "vda_samples";
    std::filesystem::create_directories(folder);
    const auto write = [&](const char* name, const std::string& text) {
        std::ofstream file(folder / (std::string(name) + ".json"));
        file << text;
        EXPECT_TRUE(file.good());
    };
    auto bare = testing::state();
    bare.pose.reset();
    bare.action_states.clear();
    auto small = testing::order();
    small.nodes.resize(1);
    small.edges.clear();
    write("order", encode_order(testing::order(), header()));
    write("order.one_node", encode_order(small, header()));
    write("instantActions", encode_instant_actions(testing::instant_actions(), header()));
    write("state", encode_state(testing::state(), header()));
    write("state.no_pose", encode_state(bare, header()));
    write("state.first", encode_state({}, header()));
    write("visualization", encode_visualization({{1, 2, 3}, true, 0.4, 0}, "hall-1", header()));
    write("connection", encode_connection(vda5050::ConnectionState::kOnline, header()));
    write("connection.broken",
          encode_connection(vda5050::ConnectionState::kConnectionBroken, header()));
    write("factsheet", factsheet_text());
}

}  // namespace
}  // namespace pulseline::vda5050
