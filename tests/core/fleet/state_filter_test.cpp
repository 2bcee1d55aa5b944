#include "core/fleet/vehicle/state_filter.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

namespace pulseline::fleet {
namespace {

vda5050::StateMessage standing() {
    vda5050::StateMessage state;
    state.header_id = 7;
    state.timestamp = "2026-01-01T00:00:00Z";
    state.pose = geometry::Pose2{1, 2, 0.5};
    state.position_initialized = true;
    state.map_id = "hall";
    state.node_states = {{"s2", 2, true}};
    state.edge_states = {{"e1", 1, true}};
    state.action_states = {{"a", "measureStop", vda5050::ActionStatus::kRunning, "", {}}};
    state.brackets = {{"front left", 5000, 5000, 0.2}};
    state.wheels = {{"w1", 0, 0, 30, ""}};
    state.cameras = {{"front", true, "P1", {1, 0}, 0.1, 1e-4, 0.1, ""}};
    state.parking_feet = {{"foot", 0.1, 60000}};
    return state;
}

vda5050::StateMessage driving() {
    vda5050::StateMessage state = standing();
    state.driving = true;
    return state;
}

using Change = std::function<void(vda5050::StateMessage&)>;

bool passes(const vda5050::StateMessage& known, const Change& change) {
    vda5050::StateMessage next = known;
    change(next);
    return may_change_decision(known, next);
}

TEST(StateFilter, TheSameReportAgainTellsNothing) {
    EXPECT_FALSE(passes(standing(), [](vda5050::StateMessage& s) {
        s.header_id = 8;
        s.timestamp = "2026-01-01T00:00:01Z";
    }));
}

TEST(StateFilter, WhatTheFleetDecidesByPassesAtOnce) {
    const Change changes[] = {
        [](auto& s) { s.order_id = "other"; },
        [](auto& s) { s.order_update_id = 1; },
        [](auto& s) { s.last_node_id = "s2"; },
        [](auto& s) { s.last_node_sequence_id = 2; },
        [](auto& s) { s.node_states.clear(); },
        [](auto& s) { s.edge_states[0].released = false; },
        [](auto& s) { s.driving = !s.driving; },
        [](auto& s) { s.paused = true; },
        [](auto& s) { s.new_base_request = true; },
        [](auto& s) { s.operating_mode = "MANUAL"; },
        [](auto& s) { s.in_hand_of = "ann"; },
        [](auto& s) { s.position_initialized = false; },
        [](auto& s) { s.pose.reset(); },
        [](auto& s) { s.map_id = "other"; },
        [](auto& s) { s.charging = true; },
        [](auto& s) { s.e_stop = "MANUAL"; },
        [](auto& s) { s.field_violation = true; },
        [](auto& s) { s.action_states[0].status = vda5050::ActionStatus::kFinished; },
        [](auto& s) { s.action_states[0].measurement = vda5050::StopMeasurement{}; },
        [](auto& s) {
            s.errors.push_back({"motor", true, "", {}});
        },
        [](auto& s) { s.brackets[0].force_b_n = 5200; },
        [](auto& s) { s.brackets[0].height_m = 0.202; },
        [](auto& s) { s.brackets[0].height_m.reset(); },
        [](auto& s) { s.parking_feet[0].force_n = 0; },
        [](auto& s) { s.wheels[0].fault = "hot"; },
        [](auto& s) { s.cameras[0].found = false; },
        [](auto& s) { s.cameras[0].payload = "P2"; },
        [](auto& s) { s.parking_feet[0].extension_m = 0.102; },
        [](auto& s) { s.battery_percent = 99; },
        [](auto& s) { s.load_kg = 10; },
    };
    for (std::size_t i = 0; i < std::size(changes); ++i) {
        EXPECT_TRUE(passes(standing(), changes[i])) << "change " << i << " of a standing vehicle";
        EXPECT_TRUE(passes(driving(), changes[i])) << "change " << i << " of a driving vehicle";
    }
}

TEST(StateFilter, NoiseOfSensorsDoesNot) {
    EXPECT_FALSE(passes(standing(), [](vda5050::StateMessage& s) {
        s.pose->x_m += 0.001;
        s.pose->heading_rad += 0.0002;
        s.velocity_mps = 0.01;
        s.turn_rate_radps = 0.01;
        s.brackets[0].force_a_n += 30;
        s.brackets[0].height_m = 0.2003;
        s.parking_feet[0].force_n = 60100;
        s.wheels[0].temperature_c += 1;
        s.wheels[0].steering_rad += 0.1;
        s.cameras[0].code.x_m += 0.001;
        s.parking_feet[0].extension_m += 0.0004;
        s.battery_percent -= 0.2;
        s.load_kg += 0.1;
    }));
}

TEST(StateFilter, AStandingVehicleThatWasMovedIsSeenAtOnceADrivingOneTwiceASecond) {
    const Change moved = [](vda5050::StateMessage& s) {
        s.pose->x_m += 0.4;
        s.distance_since_last_node_m += 0.4;
    };

    EXPECT_TRUE(passes(standing(), moved));
    EXPECT_FALSE(passes(driving(), moved));
    EXPECT_EQ(seen_every(standing()), kStandingEvery);
    EXPECT_EQ(seen_every(driving()), kDrivingEvery);
}

TEST(StateFilter, SmallStepsAddUpBecauseTheLastOnePassedIsComparedWith) {
    const vda5050::StateMessage known = standing();
    vda5050::StateMessage next = known;
    int steps = 0;
    while (!may_change_decision(known, next)) {
        next.pose->x_m += 0.0005;
        ASSERT_LT(++steps, 10);
    }
    EXPECT_GT(steps, 1);
}

TEST(StateFilter, ALostVehiclesCamerasCountToTheLastDigit) {
    vda5050::StateMessage lost = standing();
    lost.position_initialized = false;

    EXPECT_TRUE(passes(lost, [](vda5050::StateMessage& s) { s.cameras[0].code.x_m += 1e-6; }));
}

TEST(StateFilter, NothingIsKeptBackForLongAndWhatConnectedTogetherIsNotSeenTogether) {
    const Duration start = std::chrono::hours(12345);
    std::map<Duration, int> due;  // by tenths of the time between two beats
    for (std::size_t vehicle = 0; vehicle < 1000; ++vehicle) {
        const std::size_t number = std::hash<std::string>{}("V" + std::to_string(vehicle));
        const Duration first = to_next_beat(start, kStandingEvery, number);
        ASSERT_GT(first, Duration(0));
        ASSERT_LE(first, kStandingEvery);
        ++due[first / (kStandingEvery / 10) * (kStandingEvery / 10)];
        // On its beat the next one is a whole time away; a little after it, a little less.
        EXPECT_EQ(to_next_beat(start + first, kStandingEvery, number), kStandingEvery);
        EXPECT_EQ(to_next_beat(start + first + Duration(7), kStandingEvery, number),
                  kStandingEvery - Duration(7));
    }
    for (const auto& [when, vehicles] : due) EXPECT_LT(vehicles, 150);
}

}  // namespace
}  // namespace pulseline::fleet
