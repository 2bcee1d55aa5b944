#include <gtest/gtest.h>

#include "api/vda5050/hand_held.hpp"

namespace pulseline::vda5050 {
namespace {

TEST(HandHeld, CommandsAndAnswersSurviveTheLink) {
    HandFrame said{
        "h3", "ann \"of\" hall", {HandCommand::What::kDrive, {0.1, -0.2, 0.03}, 12.5, 9}};
    HeaderSource headers("Maker", "S1");
    const auto payload =
        json::parse_json(encode_hand_frame(said, headers.next(Topic::kHandHeld, {})));
    ASSERT_TRUE(payload);
    ASSERT_TRUE(decode_header(*payload));
    const auto heard = decode_hand_frame(*payload);
    ASSERT_TRUE(heard) << heard.error().what;
    EXPECT_EQ(heard->control, said.control);
    EXPECT_EQ(heard->person, said.person);
    EXPECT_EQ(heard->command.what, said.command.what);
    EXPECT_EQ(heard->command.twist, said.command.twist);
    EXPECT_EQ(heard->command.sent_s, 12.5);
    EXPECT_EQ(heard->command.sequence, 9);

    HandAnswer answer;
    answer.sequence = 9;
    answer.refused = Error{
        Errc::kConflict, {"in_other_hands", {{"person", std::string("bob")}}}, "Bob has it.", {}};
    answer.operating_mode = "MANUAL";
    answer.standing = true;
    answer.person = "bob";
    answer.pose = geometry::Pose2{1, 2, 3};
    const auto back =
        json::parse_json(encode_hand_answer({"h3", answer}, headers.next(Topic::kHandHeld, {})));
    ASSERT_TRUE(back);
    const auto read = decode_hand_answer(*back);
    ASSERT_TRUE(read) << read.error().what;
    EXPECT_EQ(read->answer.refused->reason, answer.refused->reason);
    EXPECT_EQ(read->answer.person, "bob");
    EXPECT_FALSE(read->answer.mine);
    EXPECT_EQ(read->answer.pose, answer.pose);
    EXPECT_EQ(hand_answer_json(read->answer), hand_answer_json(answer));
}

TEST(HandHeld, WhatNoControlCanMeanIsRefusedByItsField) {
    const struct {
        const char* text;
        const char* field;
    } bad[] = {{R"({})", "/do"},
               {R"({"do":"left"})", "/do"},  // the server says that
               {R"({"do":"fly"})", "/do"},
               {R"({"do":"drive","vx_mps":11})", "/vx_mps"},
               {R"({"do":"drive","turn_radps":-11})", "/turn_radps"},
               {R"({"do":"drive","vy_mps":"1"})", "/vy_mps"},
               {R"({"do":"drive","sent_ms":-1})", "/sent_ms"},
               {R"({"do":"where","sequence":-1})", "/sequence"},
               {R"({"do":"take","vx_mps":1})", "/vx_mps"},
               {R"({"do":"take","control":"other"})", "/control"},
               {R"({"do":"take","person":"boss"})", "/person"}};
    for (const auto& [text, field] : bad) {
        const auto read = decode_hand_command(text);
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().field, field) << text;
    }
    for (const char* text : {"", "[]", "null", "{\"do\":\"drive\",\"vx_mps\":1e999}"}) {
        EXPECT_FALSE(decode_hand_command(text)) << text;
    }
}

}  // namespace
}  // namespace pulseline::vda5050
