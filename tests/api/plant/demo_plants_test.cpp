#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <variant>

#include "api/plant/plant_file.hpp"
#include "core/fleet/tables/layout.hpp"
#include "core/kinematics/primitives.hpp"
#include "core/localisation/reading_speed.hpp"
#include "core/planning/legs/blind_way.hpp"
#include "core/planning/legs/leg_planner.hpp"
#include "core/plant/validate.hpp"

// The shipped plants: without a fault, and their vehicles can do what the demos ask of them.
namespace pulseline::api::plant_file {

using namespace plant;

namespace {

Plant demo(const std::string& name) {
    auto plant = load_plant_file(std::string(PULSELINE_PLANTS) + "/" + name + ".json");
    EXPECT_TRUE(plant) << (plant ? "" : plant.error().what);
    return plant ? *plant : Plant();
}

class DemoPlant : public testing::TestWithParam<const char*> {};

TEST_P(DemoPlant, HasNoFault) {
    const Plant plant = demo(GetParam());
    EXPECT_EQ(plant.id, GetParam());
    for (const Fault& fault : validate(plant)) {
        ADD_FAILURE() << fault.element << " " << fault.code << ": " << fault.what;
    }
}

/// Else orders can bar each other for good, and people have to find out which.
TEST_P(DemoPlant, IsWellFormed) {
    const Plant plant = demo(GetParam());
    for (const Reason& reason : fleet::check_layout(plant)) {
        std::string params;
        for (const auto& param : reason.params) {
            const auto* text = std::get_if<std::string>(&param.value);
            params += " " + param.name + "=" + (text ? *text : "");
        }
        ADD_FAILURE() << reason.code << params;
    }
}

/// Two of a type that stand where the other is wanted need a third place to change over.
TEST_P(DemoPlant, HasAPlaceToSpareForEachType) {
    const Plant plant = demo(GetParam());
    for (const auto& type : plant.vehicle_types) {
        const auto is_of = [&](const Vehicle& vehicle) { return vehicle.type == type.id; };
        const auto rests_at = [&](const Station& station) {
            const auto& types = station.vehicle_types;
            return station.resting_place &&
                   (types.empty() || std::find(types.begin(), types.end(), type.id) != types.end());
        };
        EXPECT_GT(std::ranges::count_if(plant.stations, rests_at),
                  std::ranges::count_if(plant.vehicles, is_of))
            << type.id.str();
    }
}

/// What the other vehicles take up when each stands at home.
std::vector<planning::StandingBody> others_at_home(const Plant& plant, const VehicleId& moving) {
    std::vector<planning::StandingBody> bodies;
    for (const Vehicle& vehicle : plant.vehicles) {
        if (vehicle.id == moving) continue;
        planning::StandingBody body{vehicle.id, {}};
        const Pose2 home = find_station(plant, vehicle.home)->pose;
        const auto& type = *find_vehicle_type(plant, vehicle.type);
        for (const Polygon& piece :
             outline_with_load(type, first_load(plant, vehicle.id) != nullptr)) {
            body.outline.push_back(geometry::transformed(home, piece));
        }
        bodies.push_back(std::move(body));
    }
    return bodies;
}

planning::LegRequest leg(const Plant& plant, const Vehicle& vehicle, const Station& from,
                         const Station& to, MotionMode mode) {
    planning::LegRequest request;
    request.type = find_vehicle_type(plant, vehicle.type);
    request.loaded = first_load(plant, vehicle.id) != nullptr;
    request.hall = from.hall;
    request.start = from.pose;
    request.from_station = from.id;
    request.target = to.id;
    request.mode = mode;
    return request;
}

TEST_P(DemoPlant, EveryVehicleCanDriveHomeFromEveryStationOfItsTypeAndBack) {
    const Plant plant = demo(GetParam());
    const planning::LegPlanner planner(plant);
    for (const Vehicle& vehicle : plant.vehicles) {
        const Station& home = *find_station(plant, vehicle.home);
        for (const Station& station : plant.stations) {
            const auto& types = station.vehicle_types;
            if (station.id == home.id ||
                std::find(types.begin(), types.end(), vehicle.type) == types.end()) {
                continue;
            }
            const auto out =
                planner.plan_leg(leg(plant, vehicle, home, station, MotionMode::kAuto));
            EXPECT_TRUE(out) << vehicle.id.str() << " to " << station.number << ": "
                             << out.error().what;
            const auto back =
                planner.plan_leg(leg(plant, vehicle, station, home, MotionMode::kAuto));
            EXPECT_TRUE(back) << vehicle.id.str() << " from " << station.number << ": "
                              << back.error().what;
        }
    }
}

/// What is relied on along all ways of a plant.
struct ChainFigures {
    int ways = 0;
    std::size_t most_markers = 0;
    double worst_m = 0;
    double arrival_m = 0;

    void add(const planning::LegChain& chain) {
        ++ways;
        most_markers = std::max(most_markers, chain.markers.size());
        worst_m = std::max(worst_m, chain.worst_m);
        arrival_m = std::max(arrival_m, chain.arrival_m);
    }
};

/// A code of the chain that its camera would not surely read at its own speed; empty: none.
std::string passed_too_fast(const Plant& plant, const Vehicle& vehicle,
                            const planning::CodeReach& reach, const planning::LegChain& chain,
                            const std::vector<kinematics::Segment>& segments) {
    const auto& type = *find_vehicle_type(plant, vehicle.type);
    for (const auto& one : chain.markers) {
        const Marker& marker = *find_marker(plant, one.marker);
        for (const auto& segment : segments) {
            if (localisation::limit_to_read_mps(type, reach.cameras(), marker, segment)) {
                return marker.payload;
            }
        }
    }
    return "";
}

/// Wherever it goes from a station to another, it catches the next code, and has a marker chain.
TEST_P(DemoPlant, NoVehicleLosesItselfBetweenStations) {
    const Plant plant = demo(GetParam());
    const planning::LegPlanner planner(plant);
    const auto serves = [](const Station& station, const Vehicle& vehicle) {
        const auto& types = station.vehicle_types;
        return types.empty() || std::find(types.begin(), types.end(), vehicle.type) != types.end();
    };
    ChainFigures figures;
    for (const Vehicle& vehicle : plant.vehicles) {
        const planning::CodeReach reach(*find_vehicle_type(plant, vehicle.type),
                                        first_load(plant, vehicle.id) != nullptr);
        for (const Station& from : plant.stations) {
            for (const Station& to : plant.stations) {
                if (from.id == to.id || !serves(from, vehicle) || !serves(to, vehicle)) continue;
                const auto plan =
                    planner.plan_leg(leg(plant, vehicle, from, to, MotionMode::kAuto));
                if (!plan) continue;
                EXPECT_FALSE(plan->blind.loses_itself())
                    << vehicle.id.str() << " from " << from.number << " to " << to.number << ": "
                    << plan->blind.way_m << " m without a code, " << plan->blind.at_most_m
                    << " m are sure";
                const auto chain = planning::leg_chain(plant, to.hall, reach, &to, plan->segments);
                if (!chain) continue;
                EXPECT_TRUE(*chain) << vehicle.id.str() << " from " << from.number << " to "
                                    << to.number << ": " << chain->error().what;
                if (!*chain) continue;
                figures.add(**chain);
                const auto fast = passed_too_fast(plant, vehicle, reach, **chain, plan->segments);
                EXPECT_EQ(fast, "") << vehicle.id.str() << " from " << from.number << " to "
                                    << to.number << " is slowed down for its camera";
            }
        }
    }
    std::printf(
        "[ chains   ] %s: %d ways, at most %zu markers, sigma %.1f mm, on arrival %.1f mm\n",
        GetParam(), figures.ways, figures.most_markers, 1e3 * figures.worst_m,
        1e3 * figures.arrival_m);
}

/// An order is given up anywhere and the next one begins there, on a lane or beside it.
TEST_P(DemoPlant, NoVehicleLosesItselfFromWhereItGaveUpAnOrder) {
    const Plant plant = demo(GetParam());
    const planning::LegPlanner planner(plant);
    const auto serves = [](const Station& station, const VehicleType& type) {
        const auto& types = station.vehicle_types;
        return types.empty() || std::find(types.begin(), types.end(), type.id) != types.end();
    };
    int ways = 0;
    for (const VehicleType& type : plant.vehicle_types) {
        const auto vehicle = std::ranges::find(plant.vehicles, type.id, &Vehicle::type);
        if (vehicle == plant.vehicles.end()) continue;
        for (const Station& from : plant.stations) {
            for (const Station& to : plant.stations) {
                if (from.number >= to.number || !serves(from, type) || !serves(to, type)) continue;
                const auto drive =
                    planner.plan_leg(leg(plant, *vehicle, from, to, MotionMode::kAuto));
                if (!drive) continue;
                for (const auto& segment : drive->segments) {
                    auto back = leg(plant, *vehicle, to, from, MotionMode::kAuto);
                    back.start = kinematics::pose_at(segment, 0.4);
                    if (ways % 2 == 1) back.start = back.start * Pose2{0, 0.3, 0.1};
                    back.from_station = {};
                    const auto plan = planner.plan_leg(back);
                    if (!plan) continue;
                    ++ways;
                    EXPECT_FALSE(plan->blind.loses_itself())
                        << type.id.str() << " on its way from " << from.number << " to "
                        << to.number << ", back from " << back.start.x_m << ", " << back.start.y_m
                        << ", " << back.start.heading_rad << ": " << plan->blind.way_m
                        << " m without a code, " << plan->blind.at_most_m << " m are sure";
                }
            }
        }
    }
    EXPECT_GT(ways, 10);
    std::printf("[ given up ] %s: %d ways back\n", GetParam(), ways);
}

INSTANTIATE_TEST_SUITE_P(Shipped, DemoPlant,
                         testing::Values("pulse-line", "measuring-hall", "landmark-lab",
                                         "igps-cell", "final-assembly"),
                         [](const auto& shipped) {
                             std::string name = shipped.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

class Tour : public testing::TestWithParam<const char*> {};

TEST_P(Tour, LoadedPlatformDrivesTangsStationsClearOfEverybody) {
    const Plant plant = demo(GetParam());
    const planning::LegPlanner planner(plant);
    const Vehicle& platform = *find_vehicle(plant, VehicleId("TP-01"));
    ASSERT_NE(first_load(plant, platform.id), nullptr);
    const MotionMode modes[] = {MotionMode::kLinear,
                                MotionMode::kLinear,
                                MotionMode::kFixedAxisRotation,
                                MotionMode::kFixedAxisRotation,
                                MotionMode::kFixedAxisRotation,
                                MotionMode::kLinear};
    for (int from = 1; from <= 6; ++from) {
        const MotionMode mode = modes[from - 1];
        const auto options = planner.assess_modes(
            leg(plant, platform, *find_station(plant, from), *find_station(plant, from + 1), mode),
            others_at_home(plant, platform.id));
        const auto option = std::ranges::find(options, mode, &planning::ModeOption::mode);
        ASSERT_NE(option, options.end());
        const auto& plan = option->plan;
        ASSERT_TRUE(plan) << from << ": " << plan.error().what;
        EXPECT_GE(plan->clearance_m, 0.5) << from << " near " << plan->nearest;
        EXPECT_TRUE(plan->route.empty()) << "drives straight there";
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, Tour, testing::Values("pulse-line", "final-assembly"),
                         [](const auto& shipped) {
                             std::string name = shipped.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(PulseLine, StationsAreTangsTable4) {
    const Plant plant = demo("pulse-line");
    const double table[8][3] = {{10, 0, 90},  // of preparation and hoisting (Fig. 4), ours
                                {10, 20, 90},  {20, 30, 0}, {30, 20, -90}, {50, 20, 45},
                                {70, 20, -90}, {85, 20, 0}, {95, 20, 90}};
    ASSERT_EQ(plant.stations.size(), 8u);
    ASSERT_EQ(plant.vehicles.size(), 1u);
    for (int n = 0; n <= 7; ++n) {
        const Station& station = *find_station(plant, n);
        const auto& [x, y, degrees_] = table[n];
        EXPECT_DOUBLE_EQ(station.pose.x_m, x);
        EXPECT_DOUBLE_EQ(station.pose.y_m, y);
        EXPECT_NEAR(station.pose.heading_rad, radians(degrees_), 1e-12);
        const std::string code = "ST0" + std::to_string(n);
        EXPECT_NEAR(distance(find_marker_by_payload(plant, code + "-F")->pose.position(),
                             station.pose * Point2{5.346, 0}),
                    0, 1e-6);
        EXPECT_NEAR(distance(find_marker_by_payload(plant, code + "-B")->pose.position(),
                             station.pose * Point2{-5.346, 0}),
                    0, 1e-6);
    }
}

TEST(FinalAssembly, HasFortyStationsAndTwelveVehiclesOfFourTypes) {
    const Plant plant = demo("final-assembly");

    EXPECT_EQ(plant.stations.size(), 40u);
    EXPECT_EQ(plant.vehicles.size(), 12u);
    EXPECT_EQ(plant.vehicle_types.size(), 4u);
}

}  // namespace
}  // namespace pulseline::api::plant_file
