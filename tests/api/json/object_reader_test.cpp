#include "api/json/object_reader.hpp"

#include <gtest/gtest.h>

namespace pulseline::json {
namespace {

enum class Colour { kRed, kBlue };
const char* to_string(Colour colour) { return colour == Colour::kRed ? "red" : "blue"; }

/// "code at pointer" of every error, in order.
std::vector<std::string> list(const FieldErrors& errors) {
    std::vector<std::string> result;
    for (const Error& e : errors.all()) result.push_back(e.reason.code + " at " + e.field);
    return result;
}

using Lines = std::vector<std::string>;

TEST(ObjectReader, ReadsEveryTypeOfMember) {
    const Json json =
        Json::parse(R"({"s":"a","n":1.5,"i":3,"w":4.0,"b":true,"c":"blue","a":[1,2],"o":{"x":1}})");
    FieldErrors errors;
    ObjectReader in(json, "", errors);

    EXPECT_EQ(in.text("s"), "a");
    EXPECT_EQ(in.number("n"), 1.5);
    EXPECT_EQ(in.number("i"), 3);
    EXPECT_EQ(in.integer("w"), 4);
    EXPECT_TRUE(in.boolean("b"));
    EXPECT_EQ(in.one_of("c", {Colour::kRed, Colour::kBlue}), Colour::kBlue);
    std::vector<std::string> pointers;
    in.items("a", {1, 5}, [&](const Json&, const std::string& p) { pointers.push_back(p); });
    EXPECT_EQ(pointers, (Lines{"/a/0", "/a/1"}));
    EXPECT_EQ(in.object("o").number("x"), 1);
    in.refuse_unknown();
    EXPECT_TRUE(errors.status());
}

TEST(ObjectReader, AbsentMembersTakeTheirFallback) {
    const Json json = Json::object();
    FieldErrors errors;
    ObjectReader in(json, "", errors);

    EXPECT_EQ(in.text_or("s", "x"), "x");
    EXPECT_EQ(in.number_or("n", 2.5), 2.5);
    EXPECT_EQ(in.integer_or("i", 7), 7);
    EXPECT_TRUE(in.boolean_or("b", true));
    EXPECT_EQ(in.one_of_or("c", Colour::kBlue, {Colour::kRed, Colour::kBlue}), Colour::kBlue);
    EXPECT_FALSE(in.object_if_any("o"));
    EXPECT_TRUE(errors.empty());
}

TEST(ObjectReader, EveryFaultIsCollectedWithItsPointer) {
    const Json json = Json::parse(
        R"({"s":1,"long":"abcdef","ctl":"a\u0000b","n":"1","far":11,"i":1.5,"b":0,"c":"green","a":{},"few":[],"x/y~z":1})");
    FieldErrors errors;
    ObjectReader in(json, "/steps/2", errors);
    in.text("s");
    in.text("long", {1, 5});
    in.text("ctl");
    in.number("n");
    in.number("far", {0, 10});
    in.integer("i");
    in.boolean("b");
    in.one_of("c", {Colour::kRed, Colour::kBlue});
    in.items("a", {}, [](const Json&, const std::string&) { FAIL(); });
    in.items("few", {1, 3}, [](const Json&, const std::string&) { FAIL(); });
    in.text("gone");
    in.refuse_unknown();

    EXPECT_EQ(list(errors),
              (Lines{"wrong_type at /steps/2/s", "wrong_length at /steps/2/long",
                     "control_character at /steps/2/ctl", "wrong_type at /steps/2/n",
                     "out_of_range at /steps/2/far", "wrong_type at /steps/2/i",
                     "wrong_type at /steps/2/b", "not_one_of at /steps/2/c",
                     "wrong_type at /steps/2/a", "wrong_count at /steps/2/few",
                     "missing_field at /steps/2/gone", "unknown_field at /steps/2/x~1y~0z"}));
    EXPECT_EQ(errors.status().error().reason.code, "wrong_type");
}

TEST(ObjectReader, WhatIsNoObjectIsReportedOnce) {
    const Json json = Json::parse("[1]");
    FieldErrors errors;
    ObjectReader in(json, "/x", errors);
    in.text("a");
    in.object("b").number("c");
    in.refuse_unknown();

    EXPECT_EQ(list(errors), (Lines{"wrong_type at /x"}));
}

TEST(ObjectReader, IntegersBeyondTheLimitsAreRefused) {
    const Json json = Json::parse(R"({"a":18446744073709551615,"b":-101,"c":1e300})");
    FieldErrors errors;
    ObjectReader in(json, "", errors);
    in.integer("a");
    in.integer("b", {-100, 100});
    in.integer("c");

    EXPECT_EQ(list(errors),
              (Lines{"out_of_range at /a", "out_of_range at /b", "wrong_type at /c"}));
}

TEST(FieldErrors, KeepOnlyAHundred) {
    FieldErrors errors;
    for (int i = 0; i < 1000; ++i) errors.add("/x", {"c", {}}, "w");

    EXPECT_EQ(errors.all().size(), FieldErrors::kMost);
}

}  // namespace
}  // namespace pulseline::json
