#include "core/onboard/foot_faults.hpp"

#include <gtest/gtest.h>

#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::onboard {
namespace {

class FootFaults : public ::testing::Test {
protected:
    FootFaults() {
        type.parking = plant::usual_parking(type.footprint);
        for (const auto& foot : type.parking->feet) feet.push_back({foot.name, 0.12, 70e3});
    }
    std::vector<vda5050::VehicleError> faults() const { return foot_faults(type, feet); }

    plant::VehicleType type = pulseline::testing::platform();
    std::vector<vda5050::ParkingFoot> feet;
};

TEST_F(FootFaults, OneThatHoldsNothingOrTooMuchIsNamed) {
    EXPECT_TRUE(faults().empty());
    feet[1].force_n = 40;
    ASSERT_EQ(faults().size(), 1u);
    EXPECT_EQ(faults()[0].type, "footLostContact");
    EXPECT_EQ(faults()[0].references[0].second, type.parking->feet[1].name);
    EXPECT_FALSE(faults()[0].fatal);
    feet[2].force_n = type.parking->rating_n + 1;
    ASSERT_EQ(faults().size(), 2u);
    EXPECT_EQ(faults()[1].type, "footOverloaded");
}

TEST_F(FootFaults, WhatStandsOnItsWheelsHasNone) {
    feet[1].extension_m = 0;
    feet[2].force_n = 0;
    EXPECT_TRUE(faults().empty()) << "not all are down";
    for (auto& foot : feet) foot = {foot.name, 0.1, 0};
    EXPECT_TRUE(faults().empty()) << "they are felt for the floor";
    feet[0].force_n.reset();
    EXPECT_TRUE(faults().empty()) << "they have no cells";
    type.parking.reset();
    EXPECT_TRUE(faults().empty());
}

}  // namespace
}  // namespace pulseline::onboard
