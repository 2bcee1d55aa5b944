#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/plant/validate.hpp"

namespace pulseline::plant::testing {

/// Damage to a sound plant, and the one fault that has to be found then.
struct FaultCase {
    const char* name;
    std::function<void(Plant&)> damage;
    const char* element;
    const char* code;
};

inline void expect_named_alone(Plant plant, const FaultCase& broken) {
    broken.damage(plant);
    const std::vector<Fault> faults = validate(plant);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].element, broken.element);
    EXPECT_EQ(faults[0].code, broken.code);
    EXPECT_FALSE(faults[0].what.empty());
    EXPECT_FALSE(faults[0].remedy.empty());
}

inline std::string name_of(const ::testing::TestParamInfo<FaultCase>& broken) {
    return broken.param.name;
}

}  // namespace pulseline::plant::testing
