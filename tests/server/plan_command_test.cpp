#include "server/cli/plan_command.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/db/temp_folder.hpp"

namespace pulseline::server::cli {
namespace {

class PlanCommand : public testing::Test {
protected:
    PlanCommand() {
        std::ofstream(folder_.file("a.map")) << "type octile\nheight 3\nwidth 5\nmap\n"
                                                ".....\n"
                                                "@@@@.\n"
                                                "..G.S\n";
        std::ofstream(folder_.file("closed.map")) << "type octile\nheight 1\nwidth 3\nmap\n.T.\n";
        std::ofstream(folder_.file("a.scen")) << "version 1\n"
                                                 "0\ta.map\t5\t3\t0\t0\t3\t0\t3\n"
                                                 "0\ta.map\t5\t3\t0\t0\t0\t2\t10\n";
        std::ofstream(folder_.file("closed.scen")) << "version 1\n"
                                                      "0 closed.map 3 1 0 0 2 0 2\n";
        input_.json = true;
        choose("a");
    }
    void choose(const std::string& name) {
        input_.map = folder_.file(name + ".map");
        input_.scenario = folder_.file(name + ".scen");
    }
    std::vector<nlohmann::json> lines() {
        std::vector<nlohmann::json> result;
        std::istringstream in(out_.str());
        for (std::string line; std::getline(in, line);) {
            result.push_back(nlohmann::json::parse(line));
        }
        return result;
    }

    db::TempFolder folder_;
    PlanInput input_;
    std::ostringstream out_;
};

TEST_F(PlanCommand, PrintsOneLineAProblem) {
    for (const char* algorithm : {"turn-jump", "bucket", "astar", "dijkstra"}) {
        input_.algorithm = algorithm;
        out_.str("");
        ASSERT_EQ(plan_scenario(input_, out_), kPlanned);

        const auto answers = lines();
        ASSERT_EQ(answers.size(), 2u);
        EXPECT_EQ(answers[0].at("problem"), 0);
        EXPECT_EQ(answers[0].at("cost"), 30.0);
        EXPECT_EQ(answers[1].at("problem"), 1);
        EXPECT_EQ(answers[1].at("length"), 10);
        EXPECT_EQ(answers[1].at("turns"), 2);
        EXPECT_EQ(answers[1].at("cost"), 120.0);
        EXPECT_GE(answers[1].at("expanded").get<int>(), 1);
        EXPECT_GE(answers[1].at("time_us").get<double>(), 0);
        EXPECT_GT(answers[1].at("build_us").get<double>(), 0);
    }
}

TEST_F(PlanCommand, TakesCostsAndTheLastProblems) {
    input_.limit = 1;
    input_.k_same = 0.5;
    input_.k_diff = 2.25;

    ASSERT_EQ(plan_scenario(input_, out_), kPlanned);

    ASSERT_EQ(lines().size(), 1u);
    EXPECT_EQ(lines()[0].at("problem"), 1);
    EXPECT_EQ(lines()[0].at("cost"), 0.5 * 8 + 2.25 * 2);
}

TEST_F(PlanCommand, SaysNullWithoutARoute) {
    choose("closed");

    ASSERT_EQ(plan_scenario(input_, out_), kPlanned);

    EXPECT_TRUE(lines()[0].at("cost").is_null());
}

TEST_F(PlanCommand, ExitsWithTwoForWhatItCannotRead) {
    const auto refused = [&](auto change) {
        PlanInput input = input_;
        change(input);
        return plan_scenario(input, out_) == kPlanUnreadable;
    };
    EXPECT_TRUE(refused([](PlanInput& i) { i.map += "x"; }));
    EXPECT_TRUE(refused([](PlanInput& i) { i.map = i.scenario; }));
    EXPECT_TRUE(refused([](PlanInput& i) { i.scenario = i.map; }));
    EXPECT_TRUE(refused([](PlanInput& i) { i.algorithm = "jps"; }));
    EXPECT_TRUE(refused([](PlanInput& i) { i.k_same = -1; }));
    EXPECT_TRUE(refused([&](PlanInput& i) { i.map = folder_.file("closed.map"); }));
}

}  // namespace
}  // namespace pulseline::server::cli
