#include "server/agent/begun_transfer.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/db/temp_folder.hpp"

namespace pulseline::agent {
namespace {

TEST(BegunTransfer, IsKnownToTheNextProgramUntilItHasEnded) {
    const db::TempFolder folder;
    const auto inside = folder.path() / "learned";
    EXPECT_FALSE(BegunTransfer(inside, "TP-01").load());
    ASSERT_TRUE(BegunTransfer(inside, "TP-01").save(18200.5));
    EXPECT_EQ(BegunTransfer(inside, "TP-01").load(), 18200.5);
    EXPECT_FALSE(BegunTransfer(inside, "TP-02").load()) << "each vehicle has its own";
    ASSERT_TRUE(BegunTransfer(inside, "TP-01").save(std::nullopt));
    EXPECT_FALSE(BegunTransfer(inside, "TP-01").load());
    EXPECT_TRUE(BegunTransfer(inside, "TP-01").save(std::nullopt)) << "ended twice";
}

TEST(BegunTransfer, WhatCannotBeReadWasBegunWithALoadThatNobodyKnows) {
    const db::TempFolder folder;
    const BegunTransfer kept(folder.path(), "TP-01");
    for (const char* text : {"", "{", "[]", "{}", R"({"load_kg":"heavy"})", R"({"load_kg":-3})",
                             R"({"load_kg":1e400})"}) {
        std::ofstream(folder.path() / "TP-01.transfer.json") << text;
        EXPECT_EQ(kept.load(), 0) << text;
    }
}

TEST(BegunTransfer, AFolderThatCannotBeWrittenIsSaid) {
    const db::TempFolder folder;
    const auto file = folder.path() / "file";
    std::ofstream(file) << "in the way";
    const auto saved = BegunTransfer(file, "TP-01").save(1);
    ASSERT_FALSE(saved);
    EXPECT_EQ(saved.error().reason.code, "file_unwritable");
}

}  // namespace
}  // namespace pulseline::agent
