#include "api/json/utf8.hpp"

#include <gtest/gtest.h>

#include <random>

#include "api/json/parse.hpp"

namespace pulseline::json {
namespace {

TEST(Printable, LeavesTextAsItIs) {
    EXPECT_EQ(printable("Halle 2, \xE9\x87\x8F\xE6\xB5\x8B \xF0\x9F\x9A\x9A", 100),
              "Halle 2, \xE9\x87\x8F\xE6\xB5\x8B \xF0\x9F\x9A\x9A");
}

TEST(Printable, ReplacesWhatCannotBeShown) {
    EXPECT_EQ(printable("BEGIN:VCARD\r\nN:X", 100), "BEGIN:VCARD\xEF\xBF\xBD\xEF\xBF\xBDN:X");
    EXPECT_EQ(printable(std::string_view("a\0b", 3), 100),
              "a\xEF\xBF\xBD"
              "b");
    EXPECT_EQ(printable("\x7F\xFF\xC0\x80", 100),
              "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
    EXPECT_EQ(printable("\xED\xA0\x80", 100), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST(Printable, CutsBetweenCharacters) {
    EXPECT_EQ(printable("ab\xE9\x87\x8F", 4), "ab");
    EXPECT_EQ(printable("ab\xE9\x87\x8F", 5), "ab\xE9\x87\x8F");
    EXPECT_EQ(printable("ab", 0), "");
}

// Whatever bytes somebody prints into a code, a JSON message carries them.
TEST(Printable, MakesAnyBytesFitForJson) {
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        std::string bytes(random() % 40, '\0');
        for (char& c : bytes) c = static_cast<char>(random());
        const std::string text = printable(bytes, 60);
        EXPECT_LE(text.size(), 60U);
        const auto parsed = parse_json(Json(text).dump());
        ASSERT_TRUE(parsed);
        EXPECT_EQ(printable(text, 60), text);
    }
}

}  // namespace
}  // namespace pulseline::json
