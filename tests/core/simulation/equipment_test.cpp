#include "core/simulation/machine/equipment.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::simulation {
namespace {

const Pose2 kOrigin{};

vda5050::Action action(const std::string& type, Params params = {}) {
    vda5050::Action made;
    made.type = type;
    made.id = "id";
    made.params = std::move(params);
    return made;
}

vda5050::Action bracket_height(const std::string& bracket, ParamValue height_m) {
    return action("setBracketHeight", {{"bracket", bracket}, {"height_m", std::move(height_m)}});
}

class VehicleEquipmentTest : public ::testing::Test {
protected:
    double run() {
        double t_s = 0;
        for (; equipment.busy() && t_s < 100; t_s += 0.02) equipment.step(0.02, 0);
        return t_s;
    }
    vda5050::StateMessage state() {
        vda5050::StateMessage state;
        equipment.write_state(state);
        return state;
    }

    Pose2 place;
    VehicleEquipment equipment{
        pulseline::testing::platform(), place, {{5, 0, 0}}, 50, 10, 18200, 4};
};

TEST_F(VehicleEquipmentTest, FeetGoDownTogetherHoldTheVehicleAndComeBackToTheirSwitches) {
    EXPECT_FALSE(equipment.holds_vehicle());
    EXPECT_FALSE(equipment.begin(action("lowerParking")));
    EXPECT_TRUE(equipment.busy());
    EXPECT_LT(run(), 2);  // ten times faster than 0.12 m at 0.02 m/s
    EXPECT_TRUE(equipment.holds_vehicle());
    double sum_n = 0;
    for (const auto& foot : state().parking_feet) {
        EXPECT_NEAR(foot.extension_m, 0.12, 0.005);  // as the floor is
        sum_n += *foot.force_n;
    }
    EXPECT_NEAR(sum_n, (10200 + 18200) * 9.80665, 5000);

    EXPECT_FALSE(equipment.begin(action("raiseParking")));
    run();
    EXPECT_FALSE(equipment.holds_vehicle());
    for (const auto& foot : state().parking_feet) EXPECT_EQ(foot.extension_m, 0);
}

TEST_F(VehicleEquipmentTest, BracketsRiseSinglyOrAllAndTellTheirLoads) {
    EXPECT_FALSE(equipment.begin(bracket_height("all", 0.1)));
    run();
    EXPECT_FALSE(equipment.failure());
    EXPECT_NEAR(*equipment.bracket_height_m("back left"), 0.1, 1.5e-4);
    EXPECT_FALSE(equipment.begin(bracket_height("back left", 0.101)));
    run();
    EXPECT_NEAR(*equipment.bracket_height_m("back left"), 0.101, 1.5e-4);
    EXPECT_NEAR(*equipment.bracket_height_m("front left"), 0.1, 1.5e-4);
    EXPECT_FALSE(equipment.begin(bracket_height("all", std::int64_t{0})));
    run();

    const auto now = state();
    ASSERT_EQ(now.brackets.size(), 4u);
    double sum_n = 0;
    for (const auto& bracket : now.brackets) {
        EXPECT_GT(bracket.force_a_n, 0);
        sum_n += bracket.force_a_n + bracket.force_b_n;
    }
    EXPECT_NEAR(sum_n, 18200 * 9.80665, 2000);
    EXPECT_EQ(now.load_kg, 18200);
}

TEST_F(VehicleEquipmentTest, AForceOutOfRangeFailsTheActionAndNotTheNext) {
    EXPECT_FALSE(equipment.begin(bracket_height("front right", 0.2)));
    run();
    ASSERT_TRUE(equipment.failure());
    EXPECT_EQ(equipment.failure()->rfind("bracket_force_out_of_range: bracket ", 0), 0u);
    place = {5, 0, 0};
    EXPECT_FALSE(equipment.begin(action("startCharging")));
    EXPECT_FALSE(equipment.failure());
}

TEST_F(VehicleEquipmentTest, RefusesBracketActionsThatSayTooLittleOrTooMuch) {
    const auto refused = [&](const vda5050::Action& wrong, const std::string& code) {
        const auto why_not = equipment.begin(wrong);
        return why_not && why_not->rfind(code + ":", 0) == 0 && !equipment.busy();
    };
    EXPECT_TRUE(refused(action("setBracketHeight"), "bad_parameters"));
    EXPECT_TRUE(refused(action("setBracketHeight", {{"height_m", 0.1}}), "bad_parameters"));
    EXPECT_TRUE(refused(bracket_height("all", std::string("high")), "bad_parameters"));
    EXPECT_TRUE(refused(bracket_height("fifth", 0.1), "unknown_bracket"));
    EXPECT_TRUE(refused(bracket_height("all", 0.5), "out_of_stroke"));
}

TEST_F(VehicleEquipmentTest, OneFootGoesDownAndUpAlone) {
    EXPECT_FALSE(equipment.begin(action("lowerParking", {{"foot", std::string("back left")}})));
    run();
    EXPECT_FALSE(equipment.failure());
    for (const auto& foot : state().parking_feet)
        EXPECT_NEAR(foot.extension_m, foot.name == "back left" ? 0.1 : 0, 0.015) << foot.name;
    EXPECT_TRUE(equipment.holds_vehicle());
    EXPECT_FALSE(equipment.begin(action("raiseParking", {{"foot", std::string("back left")}})));
    run();
    EXPECT_FALSE(equipment.failure());
    EXPECT_FALSE(equipment.holds_vehicle());
    const auto fifth = equipment.begin(action("lowerParking", {{"foot", std::string("fifth")}}));
    ASSERT_TRUE(fifth);
    EXPECT_EQ(fifth->rfind("unknown_foot:", 0), 0u);
    EXPECT_TRUE(equipment.begin(action("lowerParking", {{"foot", 5.0}})));
    EXPECT_FALSE(equipment.busy());
}

TEST_F(VehicleEquipmentTest, AFootThatCarriesIsNotTakenAwayAlone) {
    EXPECT_FALSE(equipment.begin(action("lowerParking")));
    run();
    const auto before = state().parking_feet;
    const auto refused =
        equipment.begin(action("raiseParking", {{"foot", std::string("front left")}}));
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->rfind("foot_carries: foot front left, force_n ", 0), 0u) << *refused;
    EXPECT_FALSE(equipment.busy());
    for (std::size_t i = 0; i < before.size(); ++i)
        EXPECT_EQ(state().parking_feet[i].extension_m, before[i].extension_m);
}

TEST_F(VehicleEquipmentTest, BracketsMoveAtTheSpeedThatIsAskedFor) {
    auto slow = bracket_height("all", 0.05);
    slow.params.push_back({"speed_mps", 0.005});
    EXPECT_FALSE(equipment.begin(slow));
    EXPECT_NEAR(run(), 1.0, 0.15);  // ten times faster than 0.05 m at 0.005 m/s
    EXPECT_FALSE(equipment.begin(bracket_height("all", 0.0)));
    EXPECT_LT(run(), 0.7);
    for (const ParamValue& wrong : {ParamValue(0.011), ParamValue(0.0), ParamValue(-0.001)}) {
        auto action = bracket_height("all", 0.05);
        action.params.push_back({"speed_mps", wrong});
        EXPECT_EQ(equipment.begin(action)->rfind("out_of_speed:", 0), 0u);
    }
    EXPECT_FALSE(equipment.busy());
}

TEST_F(VehicleEquipmentTest, AbortLeavesThemWhereTheyAre) {
    EXPECT_FALSE(equipment.begin(bracket_height("all", 0.2)));
    equipment.step(0.5, 0);
    equipment.abort();
    EXPECT_FALSE(equipment.busy());
    const double at_m = *equipment.bracket_height_m("front left");
    EXPECT_GT(at_m, 0.01);
    equipment.step(1, 0);
    EXPECT_EQ(*equipment.bracket_height_m("front left"), at_m);
}

TEST(VehicleEquipment, AVehicleWithoutBracketsHasNoneOfTheirActions) {
    VehicleEquipment equipment(pulseline::testing::mecanum(), kOrigin, {}, 50, 1);
    EXPECT_EQ(equipment.action_types(),
              (std::vector<std::string>{"startCharging", "stopCharging"}));
    EXPECT_FALSE(equipment.bracket_height_m("front left"));
}

TEST(VehicleEquipment, CarriesEveryLoadEvenlyEnoughToDriveAndSomeAftOfTheMiddle) {
    double least = 1;
    double most = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        VehicleEquipment equipment(pulseline::testing::platform(), kOrigin, {}, 50, 1, 18200, seed);
        vda5050::StateMessage state;
        equipment.write_state(state);
        double sum_n = 0;
        for (const auto& bracket : state.brackets) sum_n += bracket.force_a_n + bracket.force_b_n;
        EXPECT_NEAR(sum_n, 18200 * 9.80665, 0.01 * 18200 * 9.80665);
        // Across, each end for itself; along, a load has its weight where it has it.
        double back_n = 0;
        for (std::size_t end = 0; end < 4; end += 2) {
            const double left_n = state.brackets[end].force_a_n + state.brackets[end].force_b_n;
            const double right_n =
                state.brackets[end + 1].force_a_n + state.brackets[end + 1].force_b_n;
            EXPECT_NEAR(2 * left_n / (left_n + right_n), 1, 0.08) << "seed " << seed;
            back_n = left_n + right_n;
        }
        least = std::min(least, back_n / sum_n);
        most = std::max(most, back_n / sum_n);
    }
    EXPECT_LT(least, 0.45);
    EXPECT_GT(most, 0.55);
}

}  // namespace
}  // namespace pulseline::simulation
