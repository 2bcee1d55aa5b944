// What is said of beacons over the link: where transmitters and reflectors stand, and what
// receivers and scanners see of them.
#include <gtest/gtest.h>

#include "api/vda5050/instant_actions.hpp"
#include "api/vda5050/state.hpp"
#include "core/vda5050/actions.hpp"
#include "tests/api/vda5050/samples.hpp"

namespace pulseline::vda5050 {
namespace {

using testing::header;

Json parsed(const std::string& text) {
    const auto value = json::parse_json(text, {32, 100'000});
    EXPECT_TRUE(value);
    return value.value_or(Json());
}

/// Each number another one, so that none can take another's place.
plant::Transmitter transmitter(const char* id) {
    plant::Transmitter one;
    one.id = plant::TransmitterId(id);
    one.hall = plant::HallId("hall-1");
    one.position = {1.5, -2.5};
    one.z_m = 2.75;
    one.roll_rad = 0.001;
    one.pitch_rad = -0.002;
    one.heading_rad = 3.1;
    one.rate_hz = 39.2;
    one.first = {1.7, 0.1, 0.01};
    one.second = {0.2, -1.8, -0.02};
    one.range_m = 35;
    one.elevation_rad = 0.5;
    one.sigma_rad = 1.1e-5;
    one.sigma_place_m = 3.1e-5;
    one.sigma_turn_rad = 3.2e-6;
    return one;
}

InstantActionsMessage set_transmitters(std::vector<plant::Transmitter> transmitters) {
    Action action;
    action.type = kSetTransmitters;
    action.id = "a-1";
    action.transmitters = std::move(transmitters);
    return {{action}};
}

TEST(SetTransmitters, RoundTripKeepsEveryNumber) {
    const auto sent = set_transmitters({transmitter("tx-1"), transmitter("tx-2")});
    const auto read = decode_instant_actions(parsed(encode_instant_actions(sent, header())));
    ASSERT_TRUE(read) << read.error().what;
    ASSERT_EQ(read->actions[0].transmitters.size(), 2u);
    const plant::Transmitter& one = read->actions[0].transmitters[1];
    const plant::Transmitter expected = transmitter("tx-2");
    EXPECT_EQ(one.id, expected.id);
    EXPECT_EQ(one.hall, expected.hall);
    EXPECT_EQ(one.position, expected.position);
    EXPECT_EQ(one.z_m, expected.z_m);
    EXPECT_EQ(one.roll_rad, expected.roll_rad);
    EXPECT_EQ(one.pitch_rad, expected.pitch_rad);
    EXPECT_EQ(one.heading_rad, expected.heading_rad);
    EXPECT_EQ(one.rate_hz, expected.rate_hz);
    EXPECT_EQ(one.first, expected.first);
    EXPECT_EQ(one.second, expected.second);
    EXPECT_EQ(one.range_m, expected.range_m);
    EXPECT_EQ(one.elevation_rad, expected.elevation_rad);
    EXPECT_EQ(one.sigma_rad, expected.sigma_rad);
    EXPECT_EQ(one.sigma_place_m, expected.sigma_place_m);
    EXPECT_EQ(one.sigma_turn_rad, expected.sigma_turn_rad);
}

TEST(SetTransmitters, NoneIsNoneAndNotForgotten) {
    const auto read =
        decode_instant_actions(parsed(encode_instant_actions(set_transmitters({}), header())));
    ASSERT_TRUE(read) << read.error().what;
    EXPECT_TRUE(read->actions[0].transmitters.empty());
}

TEST(SetTransmitters, WhatCannotBeIsNamedByItsField) {
    Json message =
        parsed(encode_instant_actions(set_transmitters({transmitter("tx-1")}), header()));
    Json& parameter = message["actions"][0]["actionParameters"][0];
    ASSERT_EQ(parameter["key"], "transmitters");
    for (const auto& [field, value] : {std::pair<const char*, Json>{"z_m", "high"},
                                       {"rate_hz", 0},
                                       {"x_m", 1e9},
                                       {"first", nullptr},
                                       {"id", ""}}) {
        Json spoilt = message;
        spoilt["actions"][0]["actionParameters"][0]["value"][0][field] = value;
        const auto read = decode_instant_actions(spoilt);
        ASSERT_FALSE(read) << field;
        EXPECT_EQ(read.error().field,
                  std::string("/actions/0/actionParameters/transmitters/0/") + field);
    }
    parameter["value"] = "all";
    EXPECT_FALSE(decode_instant_actions(message));
}

TEST(ReceiverReadings, RoundTripKeepsWhatWasSeen) {
    StateMessage sent = testing::state();
    sent.receivers = {
        {"front left", true, {12.5, 3.25}, 0.55, 8e-5, {"tx-1", "gate \"3\", north"}, {}},
        {"rear right", false, {}, 0, 0, {"tx-1"}, "too_few_transmitters"}};
    const auto read = decode_state(parsed(encode_state(sent, header())));
    ASSERT_TRUE(read) << read.error().what;
    ASSERT_EQ(read->receivers.size(), 2u);
    EXPECT_EQ(read->receivers[0].receiver, "front left");
    EXPECT_TRUE(read->receivers[0].found);
    EXPECT_EQ(read->receivers[0].place, sent.receivers[0].place);
    EXPECT_EQ(read->receivers[0].z_m, 0.55);
    EXPECT_EQ(read->receivers[0].sigma_m, 8e-5);
    EXPECT_EQ(read->receivers[0].transmitters, sent.receivers[0].transmitters);
    EXPECT_FALSE(read->receivers[1].found);
    EXPECT_EQ(read->receivers[1].transmitters, sent.receivers[1].transmitters);
    EXPECT_EQ(read->receivers[1].why_not, "too_few_transmitters");
}

TEST(ReceiverReadings, AnEntryThatLacksSomethingIsLeftOut) {
    StateMessage sent = testing::state();
    sent.receivers = {{"front left", true, {12.5, 3.25}, 0.55, 8e-5, {"tx-1"}, {}}};
    Json message = parsed(encode_state(sent, header()));
    for (auto& entry : message["information"]) {
        if (entry["infoType"] == "receiver") entry["infoReferences"].erase(3);
    }
    const auto read = decode_state(message);
    ASSERT_TRUE(read) << read.error().what;
    EXPECT_TRUE(read->receivers.empty());
}

TEST(Navigation, RoundTripKeepsWhatItSteersBy) {
    StateMessage sent = testing::state();
    sent.navigation = {"contours", 1.25, 0.75, "contours_lost"};
    const auto read = decode_state(parsed(encode_state(sent, header())));
    ASSERT_TRUE(read) << read.error().what;
    EXPECT_EQ(read->navigation.by, "contours");
    EXPECT_EQ(read->navigation.driven_m, 1.25);
    EXPECT_EQ(read->navigation.explained, 0.75);
    EXPECT_EQ(read->navigation.why_not, "contours_lost");

    sent.navigation = {"codes", 3, -1, {}};
    const auto without_map = decode_state(parsed(encode_state(sent, header())));
    EXPECT_LT(without_map->navigation.explained, 0);
    EXPECT_TRUE(without_map->navigation.why_not.empty());
}

TEST(Navigation, WhatIsNotOurWordIsLeftOut) {
    StateMessage sent = testing::state();
    sent.navigation = {"stars", 3, -1, {}};
    const auto read = decode_state(parsed(encode_state(sent, header())));
    ASSERT_TRUE(read) << read.error().what;
    EXPECT_TRUE(read->navigation.by.empty());
}

TEST(Navigation, AShareAboveOneIsAnErrorOfTheMessage) {
    StateMessage sent = testing::state();
    sent.navigation = {"contours", 1, 1.5, {}};
    EXPECT_FALSE(decode_state(parsed(encode_state(sent, header()))));
}

TEST(PoseFixes, RoundTripKeepsTheNewestTen) {
    StateMessage sent = testing::state();
    sent.fixes = {{"codes", "Q7", "refused", "innovation_gate", 0.31, 0.02, 1, 4.5},
                  {"contours", "", "taken", "", 0.002, 0.0001, 214, 0.05}};
    const auto read = decode_state(parsed(encode_state(sent, header())));
    ASSERT_TRUE(read) << read.error().what;
    ASSERT_EQ(read->fixes.size(), 2u);
    EXPECT_EQ(read->fixes[0].what, "Q7");
    EXPECT_EQ(read->fixes[0].why, "innovation_gate");
    EXPECT_EQ(read->fixes[0].moved_m, 0.31);
    EXPECT_EQ(read->fixes[1].times, 214);
    EXPECT_EQ(read->fixes[1].ago_s, 0.05);

    sent.fixes.resize(40, sent.fixes.front());
    sent.fixes[3].by = "stars";
    sent.fixes[4].result = "perhaps";
    EXPECT_EQ(decode_state(parsed(encode_state(sent, header())))->fixes.size(), kMostPoseFixes);
}

// A code that somebody else laid on the floor holds what it likes: a visiting card, a key.
TEST(State, WhatACodeHoldsBreaksNoMessage) {
    StateMessage sent = testing::state();
    const std::string card = std::string("BEGIN:VCARD\r\nN:\xFF\0", 17) + std::string(4000, 'x');
    sent.cameras[0].found = true;
    sent.cameras[0].payload = card;
    sent.fixes = {{"codes", card, "refused", "other_code"}};
    sent.action_states[0].measurement.reset();
    sent.action_states[0].result_description = "unknown_code: " + card;
    sent.errors[0].description = "Code " + card;
    sent.errors[0].references = {{"marker", card}};
    const auto read = decode_state(parsed(encode_state(sent, header())));
    ASSERT_TRUE(read) << read.error().field << read.error().what;
    EXPECT_TRUE(read->cameras[0].payload.starts_with("BEGIN:VCARD\xEF\xBF\xBD"));
    EXPECT_EQ(read->fixes.size(), 1u);
    EXPECT_EQ(read->errors.size(), sent.errors.size());
}

// Another maker's vehicle writes as it likes, too.
TEST(State, LineFeedsInWordsForPeopleAreNoFault) {
    Json message = parsed(encode_state(testing::state(), header()));
    message["errors"][0]["errorDescription"] = "Bumper\nfront\tleft";
    message["information"].push_back(
        {{"infoType", "log\n"},
         {"infoLevel", "INFO"},
         {"infoReferences", {{{"referenceKey", "a"}, {"referenceValue", "1\n2"}}}}});
    const auto read = decode_state(message);
    ASSERT_TRUE(read) << read.error().field << read.error().what;
    EXPECT_EQ(read->errors[0].description,
              "Bumper\xEF\xBF\xBD"
              "front\xEF\xBF\xBD"
              "left");
}

InstantActionsMessage set_reflectors(std::vector<plant::Reflector> reflectors) {
    Action action;
    action.type = kSetReflectors;
    action.id = "a-1";
    action.reflectors = std::move(reflectors);
    return {{action}};
}

plant::Reflector reflector(const char* id) {
    plant::Reflector one;
    one.id = plant::ReflectorId(id);
    one.hall = plant::HallId("hall-1");
    one.position = {1.5, -2.5};
    one.sigma_m = 0.0013;
    return one;
}

TEST(SetReflectors, RoundTripKeepsEveryNumber) {
    const auto sent = set_reflectors({reflector("r-1"), reflector("r-2")});
    const auto read = decode_instant_actions(parsed(encode_instant_actions(sent, header())));
    ASSERT_TRUE(read) << read.error().what;
    ASSERT_EQ(read->actions[0].reflectors.size(), 2u);
    const plant::Reflector& one = read->actions[0].reflectors[1];
    EXPECT_EQ(one.id.str(), "r-2");
    EXPECT_EQ(one.hall.str(), "hall-1");
    EXPECT_EQ(one.position, (geometry::Point2{1.5, -2.5}));
    EXPECT_EQ(one.sigma_m, 0.0013);
    const auto none =
        decode_instant_actions(parsed(encode_instant_actions(set_reflectors({}), header())));
    ASSERT_TRUE(none) << none.error().what;
    EXPECT_TRUE(none->actions[0].reflectors.empty());
}

TEST(SetReflectors, WhatCannotBeIsNamedByItsField) {
    const Json message =
        parsed(encode_instant_actions(set_reflectors({reflector("r-1")}), header()));
    for (const auto& [field, value] : {std::pair<const char*, Json>{"sigma_m", -1},
                                       {"x_m", 1e9},
                                       {"y_m", "north"},
                                       {"mapId", 3},
                                       {"id", ""}}) {
        Json spoilt = message;
        spoilt["actions"][0]["actionParameters"][0]["value"][0][field] = value;
        const auto read = decode_instant_actions(spoilt);
        ASSERT_FALSE(read) << field;
        EXPECT_EQ(read.error().field,
                  std::string("/actions/0/actionParameters/reflectors/0/") + field);
    }
}

TEST(ReflectorSights, RoundTripAndLeaveOutWhatLacksSomething) {
    StateMessage sent = testing::state();
    sent.reflectors = {{{12.5, -3.25}, 0.004}, {{-40, 7}, 0.02}};
    Json message = parsed(encode_state(sent, header()));
    const auto read = decode_state(message);
    ASSERT_TRUE(read) << read.error().what;
    ASSERT_EQ(read->reflectors.size(), 2u);
    EXPECT_EQ(read->reflectors[0].place, sent.reflectors[0].place);
    EXPECT_EQ(read->reflectors[0].sigma_m, 0.004);
    EXPECT_EQ(read->reflectors[1].place, sent.reflectors[1].place);
    for (auto& entry : message["information"]) {
        if (entry["infoType"] == "reflector") entry["infoReferences"].erase(1);
    }
    const auto without = decode_state(message);
    ASSERT_TRUE(without) << without.error().what;
    EXPECT_TRUE(without->reflectors.empty());
}

TEST(ReflectorSights, NobodyTellsOfMoreThanAPoseNeeds) {
    StateMessage sent = testing::state();
    for (int i = 0; i < 300; ++i) sent.reflectors.push_back({{1.0 * i, 2}, 0.01});
    const auto read = decode_state(parsed(encode_state(sent, header())));
    ASSERT_TRUE(read) << read.error().what;
    EXPECT_EQ(read->reflectors.size(), kMostReflectorSights);
    sent.reflectors = {{{1, 2}, 50}};
    EXPECT_FALSE(decode_state(parsed(encode_state(sent, header())))) << "no scanner is so poor";
}

}  // namespace
}  // namespace pulseline::vda5050
