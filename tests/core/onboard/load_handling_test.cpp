#include "core/onboard/load_handling.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/base/gravity.hpp"
#include "core/simulation/machine/equipment.hpp"
#include "tests/core/control/demo_vehicles.hpp"

// The platform below a hoist: real load cells of a simulated machine, and what hangs there.
namespace pulseline::onboard {
namespace {

using geometry::Pose2;

constexpr double kMass_kg = 18200;
constexpr double kHoist_m = 0.12;
constexpr double kStep_s = 0.02;

vda5050::Action pick(double weight_kg) {
    vda5050::Action action;
    action.type = "pick";
    action.params = {{"loadId", "A-101"}, {"weight", weight_kg}};
    return action;
}

vda5050::Action drop() {
    vda5050::Action action;
    action.type = "drop";
    action.params = {{"loadId", "A-101"}};
    return action;
}

/// A machine that calls a movement failed which it was told to stop, as a controller of its own
/// may.
class FailsWhenStopped : public simulation::VehicleEquipment {
public:
    using VehicleEquipment::VehicleEquipment;
    std::optional<std::string> begin(const vda5050::Action& action) override {
        stopped_.reset();
        return VehicleEquipment::begin(action);
    }
    std::optional<std::string> failure() const override {
        return stopped_ ? stopped_ : VehicleEquipment::failure();
    }
    void abort() override {
        if (busy()) stopped_ = "lifts_stopped";
        VehicleEquipment::abort();
    }

private:
    std::optional<std::string> stopped_;
};

class LoadHandlingTest : public ::testing::Test {
protected:
    /// `hanging`: at the hoist; nothing: it is empty. `on_board`: carried from the beginning.
    void build(std::optional<simulation::TrueLoad> hanging, double on_board_kg = 0,
               double hoist_m = kHoist_m) {
        plant.stations.push_back({});
        plant.stations[0].id = plant::StationId("s0");
        plant.stations[0].support = plant::Support{hoist_m};
        supports = std::make_shared<simulation::Supports>(plant, 1);
        supports->above({}, {})->load = std::move(hanging);
        machine = std::make_unique<FailsWhenStopped>(type, stands, std::vector<Pose2>{}, 90, 1,
                                                     on_board_kg, 3);
        std::optional<simulation::TrueLoad> carried;
        if (on_board_kg > 0) carried = {plant::LoadId("A-101"), on_board_kg, {}};
        machine->work_below(supports, {}, carried);
        handling = std::make_unique<LoadHandling>(*machine, type);
    }
    void run(double most_s = 300) {
        for (double t_s = 0; handling->busy() && t_s < most_s; t_s += kStep_s) {
            machine->step(kStep_s, 0);
            handling->step();
            most_n = std::max(most_n, force_n());
        }
        EXPECT_FALSE(handling->busy());
    }
    void raise_to(double height_m) {
        vda5050::Action action;
        action.type = "setBracketHeight";
        action.params = {{"bracket", "all"}, {"height_m", height_m}};
        ASSERT_FALSE(handling->begin(action));
        run();
        ASSERT_FALSE(handling->failure());
    }
    static vda5050::Action act(const char* type) {
        vda5050::Action action;
        action.type = type;
        return action;
    }
    void pass() {
        machine->step(kStep_s, 0);
        handling->step();
    }
    void break_off_pick() {
        ASSERT_FALSE(handling->begin(pick(kMass_kg)));
        for (double t_s = 0; force_n() < 0.4 * kMass_kg * kGravity_mps2 && t_s < 300;
             t_s += kStep_s)
            pass();
        handling->abort();
        pass();
    }
    void run_until_below(double share) {
        for (double t_s = 0; force_n() > share * kMass_kg * kGravity_mps2 && t_s < 300;
             t_s += kStep_s)
            pass();
    }
    double force_n() {
        double sum_n = 0;
        for (const auto& one : machine->brackets()) sum_n += one.force_a_n + one.force_b_n;
        return sum_n;
    }
    double height_m() { return *machine->bracket_height_m("front left"); }
    simulation::Supports::Place& hoist() { return *supports->above({}, {}); }

    plant::Plant plant;
    plant::VehicleType type = pulseline::testing::platform();
    Pose2 stands;
    std::shared_ptr<simulation::Supports> supports;
    std::unique_ptr<FailsWhenStopped> machine;
    std::unique_ptr<LoadHandling> handling;
    double most_n = 0;
};

TEST_F(LoadHandlingTest, TakesOverBySmallStepsAndStandsClearOfTheHoist) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {-0.2, 0.01}});
    EXPECT_FALSE(handling->carries());
    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    EXPECT_EQ(handling->begin(pick(kMass_kg)), "lifts_moving");
    run();
    EXPECT_FALSE(handling->failure()) << *handling->failure();
    EXPECT_TRUE(handling->carries());
    EXPECT_FALSE(hoist().load);
    EXPECT_NEAR(force_n(), kMass_kg * kGravity_mps2, 0.02 * kMass_kg * kGravity_mps2);
    EXPECT_GT(height_m(), kHoist_m + 0.02 + 0.008);
    EXPECT_DOUBLE_EQ(machine->load_kg(), kMass_kg);
}

TEST_F(LoadHandlingTest, SetsDownWhatItCarriesAndTakesItOverAgain) {
    build({}, kMass_kg);
    raise_to(0.2);
    ASSERT_FALSE(handling->begin(drop()));
    run();
    EXPECT_FALSE(handling->failure()) << *handling->failure();
    EXPECT_FALSE(handling->carries());
    ASSERT_TRUE(hoist().load);
    EXPECT_LT(height_m(), kHoist_m);
    EXPECT_EQ(machine->load_kg(), 0);

    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    run();
    EXPECT_FALSE(handling->failure()) << *handling->failure();
    EXPECT_FALSE(hoist().load);
}

TEST_F(LoadHandlingTest, GivesBackAtTheFirstStepWhatLiesUnevenly) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {0, 0.2}});
    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    run();
    ASSERT_TRUE(handling->failure());
    EXPECT_EQ(handling->failure()->substr(0, 15), "load_unbalanced");
    EXPECT_FALSE(handling->carries());
    ASSERT_TRUE(hoist().load);
    EXPECT_LT(most_n, 0.3 * kMass_kg * kGravity_mps2) << "nothing heavier was on it";
    EXPECT_NEAR(height_m(), 0, 0.001);
}

TEST_F(LoadHandlingTest, GivesBackWhatIsTooHeavy) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), 23000, {}});
    ASSERT_FALSE(handling->begin(pick(0)));
    run();
    ASSERT_TRUE(handling->failure());
    EXPECT_EQ(handling->failure()->substr(0, 14), "load_too_heavy");
    EXPECT_TRUE(hoist().load);
    EXPECT_FALSE(handling->carries());
}

TEST_F(LoadHandlingTest, GivesBackWhatWeighsOtherThanItWasTold) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {}});
    ASSERT_FALSE(handling->begin(pick(15000)));
    run();
    ASSERT_TRUE(handling->failure());
    EXPECT_EQ(handling->failure()->substr(0, 12), "load_differs");
    EXPECT_TRUE(hoist().load);
}

TEST_F(LoadHandlingTest, GivesBackWhatItCannotRaiseFarEnough) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {}}, 0,
          type.bracket_lift.stroke_m - 0.012);  // a hoist gives 20 mm until it holds nothing
    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    run();
    ASSERT_TRUE(handling->failure());
    EXPECT_EQ(handling->failure()->substr(0, 15), "load_not_lifted");
    EXPECT_TRUE(hoist().load);
    EXPECT_FALSE(handling->carries());
    EXPECT_LT(height_m(), 0.001);
}

TEST_F(LoadHandlingTest, ComesDownAgainWhereNothingHangs) {
    build({});
    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    run();
    ASSERT_TRUE(handling->failure());
    EXPECT_EQ(handling->failure()->substr(0, 13), "load_not_felt");
    EXPECT_NEAR(height_m(), 0, 0.001);
}

TEST_F(LoadHandlingTest, RaisesAgainWhatNothingTakes) {
    build(simulation::TrueLoad{plant::LoadId("B-1"), 100, {}}, kMass_kg);  // the hoist is taken
    raise_to(0.15);
    ASSERT_FALSE(handling->begin(drop()));
    run(600);
    ASSERT_TRUE(handling->failure());
    EXPECT_EQ(handling->failure()->substr(0, 14), "load_not_taken");
    EXPECT_TRUE(handling->carries());
    EXPECT_NEAR(height_m(), 0.15, 0.001);
}

/// What broke off a movement before is not what becomes of the transfer.
TEST_F(LoadHandlingTest, SetsDownAlsoAfterAMovementThatFailed) {
    build({}, kMass_kg);
    raise_to(0.2);
    vda5050::Action higher;
    higher.type = "setBracketHeight";
    higher.params = {{"bracket", "all"}, {"height_m", 0.25}};
    ASSERT_FALSE(handling->begin(higher));
    for (double t_s = 0; t_s < 0.1; t_s += kStep_s) machine->step(kStep_s, 0);
    handling->abort();
    run();
    ASSERT_TRUE(handling->failure()) << "it was broken off";
    ASSERT_FALSE(handling->begin(drop()));
    run();
    EXPECT_FALSE(handling->failure()) << *handling->failure();
    EXPECT_TRUE(hoist().load);
}

TEST_F(LoadHandlingTest, HeldInTheMiddleGoesOnFromThere) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {}});
    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    for (double t_s = 0; force_n() < 0.4 * kMass_kg * kGravity_mps2 && t_s < 300; t_s += kStep_s) {
        machine->step(kStep_s, 0);
        handling->step();
    }
    handling->abort();
    machine->step(kStep_s, 0);
    EXPECT_FALSE(handling->busy());
    const double held_m = height_m();
    for (int i = 0; i < 100; ++i) {
        machine->step(kStep_s, 0);
        handling->step();
    }
    EXPECT_EQ(height_m(), held_m) << "nothing goes on by itself";
    EXPECT_TRUE(hoist().load);
    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    run();
    EXPECT_FALSE(handling->failure()) << *handling->failure();
    EXPECT_FALSE(hoist().load);
}

TEST_F(LoadHandlingTest, HalfTakenItNeitherDrivesNorRisesUntilItIsTakenOrGivenBack) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {}});
    EXPECT_FALSE(handling->half_transferred());
    break_off_pick();
    EXPECT_TRUE(handling->half_transferred());
    EXPECT_EQ(handling->begun(), (BegunTransfer{kMass_kg, 0, {}}));
    EXPECT_EQ(handling->begin(act("lowerParking")), "load_half_taken");
    EXPECT_EQ(handling->begin(act("raiseParking")), "load_half_taken");

    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    run();
    EXPECT_FALSE(handling->half_transferred()) << "it has all of it";
    EXPECT_FALSE(handling->begun());

    ASSERT_FALSE(handling->begin(drop()));
    run_until_below(0.6);
    handling->abort();
    EXPECT_TRUE(handling->half_transferred());
    raise_to(0);
    EXPECT_FALSE(handling->half_transferred()) << "it has given all of it back";
    EXPECT_FALSE(handling->begun());
}

// A light touch is below the noise of its load cells, and it would drag at what it touches.
TEST_F(LoadHandlingTest, BrokenOffAtTheFirstTouchItStaysUntilItsBracketsAreClear) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {}});
    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    for (double t_s = 0; machine->load_kg() == 0 && t_s < 300; t_s += kStep_s) {
        machine->step(kStep_s, 0);
        handling->step();
    }
    handling->abort();
    for (int i = 0; i < 10; ++i) {
        machine->step(kStep_s, 0);
        handling->step();
    }
    ASSERT_GT(machine->load_kg(), 0);
    ASSERT_FALSE(handling->carries()) << "it does not feel it";
    EXPECT_TRUE(handling->half_transferred());
    raise_to(0);
    EXPECT_EQ(machine->load_kg(), 0);
    EXPECT_FALSE(handling->half_transferred());
    EXPECT_FALSE(handling->begun());
}

TEST_F(LoadHandlingTest, OneThatNobodyHasWeighedIsTakenWholeAndSetDownWhole) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {}});
    ASSERT_FALSE(handling->begin(pick(0)));
    run();
    EXPECT_FALSE(handling->failure()) << *handling->failure();
    EXPECT_FALSE(handling->half_transferred()) << "it may drive with it";
    ASSERT_FALSE(handling->begin(drop()));
    run();
    EXPECT_FALSE(handling->failure()) << *handling->failure();
    EXPECT_FALSE(handling->half_transferred());
    EXPECT_TRUE(hoist().load);
}

/// The hoist still has a share that load cells and scales may differ by.
TEST_F(LoadHandlingTest, BrokenOffAtTheBeginningOfSettingDownItStaysUntilItIsBackWhereItBegan) {
    build({}, kMass_kg);
    raise_to(0.2);
    ASSERT_FALSE(handling->begin(drop()));
    EXPECT_NEAR(*handling->begun()->laden_m, 0.2, 0.001);
    run_until_below(0.98);
    handling->abort();
    pass();
    ASSERT_TRUE(hoist().load);
    ASSERT_GT(machine->load_kg(), 0.95 * kMass_kg);
    EXPECT_TRUE(handling->half_transferred());
    raise_to(0.19);
    EXPECT_TRUE(handling->half_transferred()) << "nobody knows where the hoist lets go";
    raise_to(0.2);
    EXPECT_FALSE(hoist().load);
    EXPECT_FALSE(handling->half_transferred());
    EXPECT_FALSE(handling->begun());
}

TEST_F(LoadHandlingTest, BrokenOffBeforeItIsClearOfTheHoistItHasNotTakenTheLoadOver) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {}});
    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    for (double t_s = 0; machine->load_kg() < 0.98 * kMass_kg && t_s < 300; t_s += kStep_s) pass();
    handling->abort();
    pass();
    ASSERT_TRUE(hoist().load);
    EXPECT_TRUE(handling->half_transferred());
    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    run();
    EXPECT_FALSE(hoist().load);
    EXPECT_FALSE(handling->half_transferred());
}

TEST_F(LoadHandlingTest, AProgramThatStartsAnewIsToldOfWhatHadBeenBegun) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {}});
    raise_to(0.05);
    break_off_pick();
    LoadHandling anew(*machine, type);
    EXPECT_FALSE(anew.half_transferred()) << "weight alone says nothing";
    anew.begun_before({});
    EXPECT_TRUE(anew.half_transferred()) << "of a load that nobody knows any weight may be a part";
    anew.begun_before(*handling->begun());
    EXPECT_TRUE(anew.half_transferred());
    raise_to(0.05);
    EXPECT_FALSE(anew.half_transferred()) << "it knows where the other began";
}

TEST_F(LoadHandlingTest, ACornerThatRisesAheadIsGivenBackBeforeItBearsMuch) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {}});
    ASSERT_TRUE(machine->displace_bracket("front left", 0.004));
    EXPECT_FALSE(machine->displace_bracket("middle", 0.004));
    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    run();
    ASSERT_TRUE(handling->failure());
    EXPECT_EQ(handling->failure()->substr(0, 15), "load_unbalanced");
    EXPECT_NE(handling->failure()->find("front left"), std::string::npos) << *handling->failure();
    EXPECT_TRUE(hoist().load) << "it hangs as before";
    EXPECT_FALSE(handling->carries());
    EXPECT_EQ(machine->load_kg(), 0);
    EXPECT_LT(most_n, 0.5 * kMass_kg * kGravity_mps2);
    EXPECT_FALSE(handling->half_transferred());
}

TEST_F(LoadHandlingTest, OnItsFeetItsBracketsReachHigherAndTakeOverLower) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {}});
    ASSERT_FALSE(handling->begin(act("lowerParking")));
    run();
    ASSERT_FALSE(handling->failure());
    ASSERT_FALSE(handling->begin(pick(kMass_kg)));
    run();
    EXPECT_FALSE(handling->failure()) << *handling->failure();
    EXPECT_FALSE(hoist().load);
    EXPECT_LT(height_m(), kHoist_m + 0.02 + 0.008) << "the feet have raised it by 20 mm";
    double feet_n = 0;
    vda5050::StateMessage state;
    machine->write_state(state);
    for (const auto& foot : state.parking_feet) feet_n += *foot.force_n;
    EXPECT_NEAR(feet_n, (type.mass_kg + kMass_kg) * kGravity_mps2, 8e3);
}

TEST_F(LoadHandlingTest, FeetThatRaiseItBelowALoadTakeThatOver) {
    build(simulation::TrueLoad{plant::LoadId("A-101"), kMass_kg, {}});
    raise_to(kHoist_m - 0.002);
    EXPECT_FALSE(handling->carries());
    ASSERT_FALSE(handling->begin(act("lowerParking")));
    run();
    EXPECT_TRUE(handling->carries()) << "that is why the server forbids it";
}

}  // namespace
}  // namespace pulseline::onboard
