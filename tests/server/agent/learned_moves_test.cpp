#include "server/agent/learned_moves.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/db/temp_folder.hpp"

namespace pulseline::agent {
namespace {

using control::DrivenPass;
using control::MotionCompensation;
using control::MoveKind;

/// Advances come out 3 % short, turns 2 % long.
MotionCompensation learned() {
    MotionCompensation compensation;
    for (int i = 1; i <= 6; ++i) {
        const double way_m = 0.01 * i;
        const double turn_rad = 0.004 * i;
        DrivenPass pass;
        pass.moves = {{MoveKind::kTurn, turn_rad}, {MoveKind::kAdvance, way_m}};
        const double heading = 1.02 * turn_rad;
        pass.measured = {0.97 * way_m * std::cos(heading), 0.97 * way_m * std::sin(heading),
                         heading};
        pass.sigma_m = 5e-5;
        pass.sigma_rad = 5e-5;
        EXPECT_TRUE(compensation.learn(pass));
    }
    return compensation;
}

TEST(LearnedMoves, AreThoseOfTheLastStart) {
    const db::TempFolder folder;
    const std::filesystem::path inside = folder.path() / "learned";
    const auto known = learned();
    ASSERT_TRUE(LearnedMoves(inside, "TP-01").save(known));
    ASSERT_TRUE(LearnedMoves(inside, "TP-01").save(known)) << "over an older one";

    const auto again = LearnedMoves(inside, "TP-01").load();
    ASSERT_TRUE(again) << again.error().what;
    EXPECT_EQ(again->passes(), known.passes());
    EXPECT_EQ(again->commanded(MoveKind::kAdvance, 0.05),
              known.commanded(MoveKind::kAdvance, 0.05));
    EXPECT_GT(again->commanded(MoveKind::kAdvance, 0.05), 0.051);

    const auto other = LearnedMoves(inside, "TP-02").load();
    ASSERT_TRUE(other);
    EXPECT_TRUE(other->passes().empty()) << "each vehicle has its own";
}

TEST(LearnedMoves, WhatCannotBeUsedIsRefusedByName) {
    const db::TempFolder folder;
    const LearnedMoves moves(folder.path(), "TP-01");
    const auto file = folder.path() / "TP-01.moves.json";
    for (const char* text :
         {"", "{", "[]", R"({"passes":[{"moves":[]}]})",
          R"({"passes":[{"moves":[{"kind":"jump",)"
          R"("size":1}],"x_m":0,"y_m":0,)"
          R"("heading_rad":0,"sigma_m":0,)"
          R"("sigma_rad":0}]})",
          R"({"passes":[{"moves":[],"x_m":0,"y_m":0,"heading_rad":0,"sigma_m":0,"sigma_rad":0}]})",
          R"({"passes":[{"moves":[{"kind":"turn","size":1}],"x_m":0,"y_m":0,"heading_rad":0,)"
          R"("sigma_m":-1,"sigma_rad":0}]})"}) {
        std::ofstream(file) << text;
        const auto read = moves.load();
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().reason.code, "bad_learned_moves");
        EXPECT_NE(read.error().what.find(file.string()), std::string::npos);
    }
}

TEST(LearnedMoves, AFolderThatCannotBeWrittenIsSaid) {
    const db::TempFolder folder;
    const auto file = folder.path() / "file";
    std::ofstream(file) << "in the way";
    const auto saved = LearnedMoves(file, "TP-01").save(learned());
    ASSERT_FALSE(saved);
    EXPECT_EQ(saved.error().reason.code, "file_unwritable");
}

}  // namespace
}  // namespace pulseline::agent
