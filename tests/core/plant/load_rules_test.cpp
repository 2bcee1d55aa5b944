#include "core/plant/load_rules.hpp"

#include <gtest/gtest.h>

#include "core/base/gravity.hpp"
#include "core/plant/carrying.hpp"

namespace pulseline::plant {
namespace {

/// Four brackets 2 m and 0.8 m apart, six wheels wider than them, 1,000 kg at most.
VehicleType platform() {
    VehicleType type;
    type.max_load_kg = 1000;
    for (const double x_m : {1.0, -1.0}) {
        for (const double y_m : {0.4, -0.4}) {
            const std::string name =
                std::string(x_m > 0 ? "front" : "back") + (y_m > 0 ? " left" : " right");
            type.brackets.push_back({name, {x_m, y_m}});
            type.wheels.push_back({name, {1.2 * x_m, 1.2 * y_m}, false, false, 0.2});
        }
    }
    return type;
}

/// A body with its centre there, on four brackets.
std::vector<BracketForce> body(double kg, Point2 centre) {
    std::vector<BracketForce> forces;
    for (const Bracket& bracket : platform().brackets) {
        const double along = (1 + centre.x_m * bracket.position.x_m) / 2;
        const double across = (1 + centre.y_m * bracket.position.y_m / 0.16) / 2;
        forces.push_back({bracket.name, kg * kGravity_mps2 * along * across});
    }
    return forces;
}

std::string fault_of(const VehicleType& type, const std::vector<BracketForce>& forces) {
    const auto fault = load_fault(type, forces);
    return fault ? fault->code : "";
}

TEST(LoadRules, ItsCentreIsWhereItsForcesAreInBalance) {
    const auto load = load_on(platform(), body(800, {-0.3, 0.02}));
    ASSERT_TRUE(load);
    EXPECT_NEAR(load->force_n, 800 * kGravity_mps2, 1e-9);
    EXPECT_NEAR(load->centre.x_m, -0.3, 1e-12);
    EXPECT_NEAR(load->centre.y_m, 0.02, 1e-12);
    EXPECT_FALSE(load_on(platform(), body(9.9, {})));  // noise of sensors
    EXPECT_FALSE(load_on(platform(), {}));
}

TEST(LoadRules, AnAftCentreOfGravityIsAllowedAsFarAsTheBracketsBearIt) {
    EXPECT_EQ(fault_of(platform(), body(1000, {-0.45, 0})), "");
    EXPECT_EQ(fault_of(platform(), body(1000, {-0.55, 0})), "bracket_overloaded");
    EXPECT_EQ(fault_of(platform(), body(700, {-0.55, 0})), "");  // a lighter one may lie there
    VehicleType stronger = platform();
    stronger.load_rules.bracket_rating_n = 5000;
    EXPECT_EQ(fault_of(stronger, body(1000, {-0.55, 0})), "");
}

TEST(LoadRules, EachRuleIsNamedWithItsNumbers) {
    const auto heavy = load_fault(platform(), body(1001, {}));
    ASSERT_TRUE(heavy);
    EXPECT_EQ(heavy->code, "load_too_heavy");
    EXPECT_NEAR(std::get<double>(heavy->params[0].value), 1001, 1e-9);

    auto corner = body(600, {});
    corner[2].force_n = 3700;
    const auto overloaded = load_fault(platform(), corner);
    ASSERT_TRUE(overloaded);
    EXPECT_EQ(overloaded->code, "bracket_overloaded");
    EXPECT_EQ(std::get<std::string>(overloaded->params[0].value), "back left");
    EXPECT_EQ(std::get<double>(overloaded->params[1].value), 3700);
    EXPECT_NEAR(std::get<double>(overloaded->params[2].value), 1.5 * 250 * kGravity_mps2, 1e-9);

    const auto leaning = load_fault(platform(), body(800, {0, -0.045}));
    ASSERT_TRUE(leaning);
    EXPECT_EQ(leaning->code, "load_unbalanced");
    EXPECT_EQ(std::get<double>(leaning->params[2].value), 0.10);
}

TEST(LoadRules, TheBalanceIsTheTypesOwn) {
    VehicleType type = platform();
    EXPECT_EQ(fault_of(type, body(800, {0, 0.045})), "load_unbalanced");  // a ninth
    type.load_rules.most_unbalance = 0.12;
    EXPECT_EQ(fault_of(type, body(800, {0, 0.045})), "");
    const auto worst = worst_bracket(type, body(800, {0, 0.045}));
    ASSERT_TRUE(worst);
    EXPECT_NEAR(worst->share, 0.045 / 0.4, 1e-9);
    EXPECT_EQ(worst->limit, 0.12);
}

TEST(LoadRules, TheCentreStaysBetweenTheWheelsAndWhereTheTypeAllowsIt) {
    VehicleType type = platform();
    type.load_rules.bracket_rating_n = 1e5;
    type.load_rules.centre = {{-0.5, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.5, 0.1}};
    EXPECT_EQ(fault_of(type, body(800, {-0.45, 0})), "");
    EXPECT_EQ(fault_of(type, body(800, {0.25, 0})), "load_outside_limits");
    for (Wheel& wheel : type.wheels) wheel.position.x_m *= 0.1;
    EXPECT_EQ(fault_of(type, body(800, {-0.45, 0})), "load_outside_wheel_base");
}

TEST(LoadRules, WithoutBracketsThereIsNothingToAsk) {
    VehicleType cart;
    cart.max_load_kg = 250;
    EXPECT_EQ(fault_of(cart, {}), "");
    EXPECT_FALSE(worst_bracket(cart, {}));
}

TEST(LoadRules, AllOnOneEndIsNoUnbalanceOfTheOther) {
    auto forces = body(400, {});
    forces[0].force_n = forces[1].force_n = 0;
    const auto worst = worst_bracket(platform(), forces);
    ASSERT_TRUE(worst);
    EXPECT_EQ(worst->share, 0);
}

TEST(LoadRules, OneThatHasBeenWeighedWeighsThatWithinAFewPerCent) {
    EXPECT_TRUE(weighs_as_known(18200, 18200));
    EXPECT_TRUE(weighs_as_known(1.049 * 18200, 18200));
    EXPECT_FALSE(weighs_as_known(1.051 * 18200, 18200));
    EXPECT_FALSE(weighs_as_known(0.949 * 18200, 18200));
    EXPECT_TRUE(weighs_as_known(500, 0)) << "nobody has weighed it";
}

TEST(LoadRules, PapersThatNoTypeCanKeepAreNamedByTheTypeThatComesNearest) {
    Plant plant;
    plant.vehicle_types = {platform(), platform()};
    VehicleType& weak = plant.vehicle_types.front();
    VehicleType& strong = plant.vehicle_types.back();
    weak.id = VehicleTypeId("weak");
    weak.max_load_kg = 100;
    strong.id = VehicleTypeId("strong");
    for (auto* type : {&weak, &strong}) type->footprint = geometry::rectangle(6, 3);
    Load load;
    load.name = "A-105";
    const auto why_not = [&] {
        const auto reason = nobody_can_carry(plant, load);
        return reason ? reason->code : "";
    };
    load.mass_kg = 900;
    EXPECT_EQ(why_not(), "");
    load.mass_kg = 1100;
    EXPECT_EQ(why_not(), "load_too_heavy");
    load.mass_kg = 900;
    load.centre = {1.3, 0};
    EXPECT_EQ(why_not(), "load_outside_wheel_base") << "the weak one is too weak, too";
    load.centre = {};
    load.vehicle_types = {weak.id};
    EXPECT_EQ(why_not(), "load_too_heavy");
    load.vehicle_types = {VehicleTypeId("none")};
    EXPECT_EQ(why_not(), "load_not_for_type");
}

/// Papers tell a centre from the middle of the brackets, which need not be that of the vehicle.
TEST(LoadRules, TheCentreIsToldFromTheMiddleOfTheBrackets) {
    VehicleType type = platform();
    type.footprint = geometry::rectangle(6, 3);
    for (auto& bracket : type.brackets) bracket.position.x_m += 0.15;
    EXPECT_NEAR(bracket_middle(type).x_m, 0.15, 1e-12);
    Load load;
    load.centre = {1.0, 0};
    EXPECT_FALSE(cannot_carry_by_papers(type, load));
    load.centre = {1.1, 0};  // 1.25 m, and the wheels are 1.2 m ahead
    EXPECT_EQ(cannot_carry_by_papers(type, load)->code, "load_outside_wheel_base");
    type.load_rules.centre = geometry::rectangle(0.6, 0.4);
    load.centre = {0.2, 0};
    EXPECT_EQ(cannot_carry_by_papers(type, load)->code, "load_outside_limits");
}

}  // namespace
}  // namespace pulseline::plant
