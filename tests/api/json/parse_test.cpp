#include "api/json/parse.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "api/json/parse_quickly.hpp"

namespace pulseline::json {
namespace {

std::string code_of(std::string_view text, JsonLimits limits = {}) {
    const auto parsed = parse_json(text, limits);
    return parsed ? "" : parsed.error().reason.code;
}

std::int64_t integer_param(const Error& error, const std::string& name) {
    for (const Param& p : error.reason.params) {
        if (p.name == name) return std::get<std::int64_t>(p.value);
    }
    return -1;
}

TEST(ParseJson, BuildsTheSameValueAsThePlainParser) {
    const std::string text =
        R"({"a":[1,-2,3.5e-3,true,false,null,"\u00e4\n"],"b":{"c":{}},"d":18446744073709551615})";

    EXPECT_EQ(parse_json(text).value(), Json::parse(text));
}

// What the quick parser takes, the slow one takes too, to the last bit; what it leaves is explained
// or taken by the slow one.
TEST(ParseJson, TheQuickParserReadsNumbersAsThePlainOne) {
    for (const char* text :
         {"0", "-0", "-0.0", "1e-400", "5e-324", "-2.2250738585072011e-308",
          "1.7976931348623157e308", "9007199254740993", "9223372036854775807",
          "9223372036854775808", "18446744073709551615", "-9223372036854775808", "0.1",
          "123456789012345678.5", "1e0", "1E+2", "7.1234567890123456789012345678901234567890"}) {
        const auto quickly = parse_quickly(text, {});
        ASSERT_TRUE(quickly) << text;
        EXPECT_EQ(*quickly, Json::parse(text)) << text;
        EXPECT_EQ(quickly->dump(), Json::parse(text).dump()) << text;
    }
    for (const char* text : {"1e400", "-1e999", "18446744073709551616", "-9223372036854775809"}) {
        EXPECT_FALSE(parse_quickly(text, {})) << text;
    }
}

TEST(ParseJson, WhatIsTooLongForTheQuickParserIsReadAllTheSame) {
    std::string text(70'002, 'a');
    text.front() = text.back() = '"';
    EXPECT_FALSE(parse_quickly(text, {}));
    EXPECT_EQ(parse_json(text).value(), text.substr(1, 70'000));
    EXPECT_TRUE(parse_quickly("[1]", {}));
}

TEST(ParseJson, ScalarsAreDocumentsToo) {
    EXPECT_EQ(parse_json("17").value(), 17);
    EXPECT_EQ(parse_json(" \"x\" ").value(), "x");
}

TEST(ParseJson, AHundredThousandsOfBracketsAreAnswered) {
    EXPECT_EQ(code_of(std::string(300'000, '[')), "json_too_deep");
    std::string objects;
    for (int i = 0; i < 60'000; ++i) objects += "{\"a\":";
    EXPECT_EQ(code_of(objects), "json_too_deep");
}

TEST(ParseJson, DepthLimitIsExact) {
    EXPECT_EQ(code_of(std::string(32, '[') + std::string(32, ']')), "");
    EXPECT_EQ(code_of(std::string(33, '[') + std::string(33, ']')), "json_too_deep");
}

TEST(ParseJson, NodeLimitIsExact) {
    EXPECT_EQ(code_of("[1,2,3]", {32, 4}), "");
    EXPECT_EQ(code_of("[1,2,3,4]", {32, 4}), "json_too_large");
    std::string many = "[0";
    for (int i = 0; i < 10'000; ++i) many += ",0";
    EXPECT_EQ(code_of(many + "]"), "json_too_large");
    EXPECT_EQ(code_of(many + "]", kPlantImport), "");
}

TEST(ParseJson, DuplicateKeysAreNamed) {
    const auto parsed = parse_json(R"({"a":1,"b":{"x":1,"x":2}})");

    ASSERT_FALSE(parsed);
    EXPECT_EQ(parsed.error().reason.code, "json_duplicate_key");
    EXPECT_EQ(std::get<std::string>(parsed.error().reason.params[0].value), "x");
    EXPECT_EQ(code_of(R"({"a":1,"\u0061":2})"), "json_duplicate_key");
}

TEST(ParseJson, NumbersThatDoNotFitAreRefused) {
    EXPECT_EQ(code_of("[1e400]"), "json_number");
    EXPECT_EQ(code_of("-1e999"), "json_number");
    EXPECT_EQ(code_of("18446744073709551616"), "json_number");
    EXPECT_EQ(code_of("-9223372036854775809"), "json_number");
    EXPECT_EQ(code_of("NaN"), "json_syntax");
    EXPECT_EQ(code_of("[Infinity]"), "json_syntax");
}

TEST(ParseJson, SyntaxErrorsSayWhere) {
    const auto parsed = parse_json("{\n  \"a\": 1,\n  \"b\": x\n}");

    ASSERT_FALSE(parsed);
    EXPECT_EQ(parsed.error().reason.code, "json_syntax");
    EXPECT_EQ(integer_param(parsed.error(), "line"), 3);
    EXPECT_EQ(integer_param(parsed.error(), "column"), 8);
}

TEST(ParseJson, RefusesWhatIsNotJson) {
    for (const char* text : {"", " ", "{", "[1,]", "{\"a\"}", "{'a':1}", "[1] [2]", "// c\n1", "01",
                             "\"\\ud800\"", "\"a\nb\"", "tru", "[1}", "]"}) {
        EXPECT_EQ(code_of(text), "json_syntax") << text;
    }
}

TEST(ParseJson, RefusesInvalidUtf8AndNulBytes) {
    EXPECT_EQ(code_of("\"\xff\""), "json_syntax");
    EXPECT_EQ(code_of("\"\xc0\xaf\""), "json_syntax");
    EXPECT_EQ(code_of("\"\xed\xa0\x80\""), "json_syntax");
    EXPECT_EQ(code_of(std::string("{}\0{", 4)), "json_syntax");
    EXPECT_EQ(code_of("{\"\xe2\x82\":1}"), "json_syntax");
}

// Whatever a mutation makes of valid documents: an answer, and what is accepted prints and parses
// to itself again.
TEST(ParseJson, MutationsOfValidDocumentsAreAnswered) {
    const std::vector<std::string> seeds = {
        R"({"vehicle":"TP-01","steps":[{"station":2,"motion_mode":"linear"},{"station":3}]})",
        R"({"x":[-1.5e3,0.0,12345678901234,true,null,"\u00e9\u20ac\ud83d\ude00","a\\\"b"],"y":{}})",
        R"([[[[1],[2]],{"k":{"k":{"k":[]}}}],"end"])"};
    const std::string alphabet = "{}[],:\"\\0123456789.eE+-truefalsn u\xc3\xa9\xff\n";
    std::mt19937 random(20260727);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    int accepted = 0;
    for (int run = 0; run < 60'000; ++run) {
        std::string text = seeds[below(seeds.size())];
        for (std::size_t edit = 1 + below(4); edit > 0 && !text.empty(); --edit) {
            const std::size_t at = below(text.size());
            switch (random() % 5) {
                case 0:
                    text[at] = alphabet[below(alphabet.size())];
                    break;
                case 1:
                    text.erase(at, 1 + below(6));
                    break;
                case 2:
                    text.insert(at, 1, alphabet[below(alphabet.size())]);
                    break;
                case 3:
                    text.insert(at, text.substr(below(text.size()), below(12)));
                    break;
                default:
                    text.resize(at);
                    break;
            }
        }
        const auto parsed = parse_json(text, {8, 40});
        if (!parsed) {
            EXPECT_EQ(parsed.error().reason.code.rfind("json_", 0), 0u) << text;
            continue;
        }
        ++accepted;
        const std::string printed = parsed->dump();
        const auto again = parse_json(printed, {8, 40});
        ASSERT_TRUE(again) << text;
        EXPECT_EQ(*again, *parsed) << text;
        ASSERT_TRUE(Json::accept(text)) << text;
        const auto quickly = parse_quickly(text, {8, 40});
        ASSERT_TRUE(quickly) << text;
        EXPECT_EQ(quickly->dump(), Json::parse(text).dump()) << text;
    }
    EXPECT_GT(accepted, 1000);
}

}  // namespace
}  // namespace pulseline::json
