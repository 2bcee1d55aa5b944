#include "server/agent/kept_transfer.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/db/temp_folder.hpp"

namespace pulseline::agent {
namespace {

const onboard::BegunTransfer kLowering{18200.5, std::nullopt, 0.15};

TEST(KeptTransfer, IsKnownToTheNextProgramUntilItHasEnded) {
    const db::TempFolder folder;
    const auto inside = folder.path() / "learned";
    EXPECT_FALSE(KeptTransfer(inside, "TP-01").load());
    ASSERT_TRUE(KeptTransfer(inside, "TP-01").save(kLowering));
    EXPECT_EQ(KeptTransfer(inside, "TP-01").load(), kLowering);
    EXPECT_FALSE(KeptTransfer(inside, "TP-02").load()) << "each vehicle has its own";
    ASSERT_TRUE(KeptTransfer(inside, "TP-01").save(std::nullopt));
    EXPECT_FALSE(KeptTransfer(inside, "TP-01").load());
    EXPECT_TRUE(KeptTransfer(inside, "TP-01").save(std::nullopt)) << "ended twice";
}

TEST(KeptTransfer, WhatCannotBeReadWasBegunWithALoadThatNobodyKnows) {
    const db::TempFolder folder;
    const KeptTransfer kept(folder.path(), "TP-01");
    for (const char* text : {"", "{", "[]", "{}", R"({"load_kg":"heavy"})", R"({"load_kg":-3})",
                             R"({"load_kg":1e400})",
                             R"({"load_kg":18200,"laden_m":"high"})"}) {
        std::ofstream(folder.path() / "TP-01.transfer.json") << text;
        EXPECT_EQ(kept.load(), onboard::BegunTransfer{}) << text;
    }
}

TEST(KeptTransfer, AFolderThatCannotBeWrittenIsSaid) {
    const db::TempFolder folder;
    const auto file = folder.path() / "file";
    std::ofstream(file) << "in the way";
    const auto saved = KeptTransfer(file, "TP-01").save(kLowering);
    ASSERT_FALSE(saved);
    EXPECT_EQ(saved.error().reason.code, "file_unwritable");
}

}  // namespace
}  // namespace pulseline::agent
