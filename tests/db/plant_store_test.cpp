#include "db/plant/plant_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "api/plant/plant_codec.hpp"
#include "api/plant/plant_file.hpp"
#include "tests/db/temp_folder.hpp"

namespace pulseline::db {
namespace {

plant::Plant demo(const std::string& name) {
    return api::plant_file::load_plant_file(std::string(PULSELINE_PLANTS) + "/" + name + ".json")
        .value();
}

void expect_same(const plant::Plant& a, const plant::Plant& b) {
    EXPECT_EQ(api::plant_file::plant_to_json(a), api::plant_file::plant_to_json(b));
    ASSERT_EQ(a.halls.size(), b.halls.size());
    for (std::size_t i = 0; i < a.halls.size(); ++i) {
        EXPECT_EQ(a.halls[i].grid.width, b.halls[i].grid.width);
        EXPECT_EQ(a.halls[i].grid.height, b.halls[i].grid.height);
        EXPECT_EQ(a.halls[i].grid.resolution_m, b.halls[i].grid.resolution_m);
        EXPECT_EQ(a.halls[i].grid.origin, b.halls[i].grid.origin);
        EXPECT_TRUE(a.halls[i].grid.occupied == b.halls[i].grid.occupied);
    }
}

TEST(PlantStore, EmptyDatabaseHoldsNoPlant) {
    Database database(":memory:");

    EXPECT_EQ(PlantStore(database).load(), std::nullopt);
}

class DemoPlantStored : public testing::TestWithParam<const char*> {};

TEST_P(DemoPlantStored, ComesBackExactlyFromTheFile) {
    const TempFolder folder;
    const plant::Plant plant = demo(GetParam());
    {
        Database database(folder.file("fleet.db"));
        EXPECT_EQ(PlantStore(database).import(plant), 1);
    }
    Database database(folder.file("fleet.db"));
    ReadOnly reader(folder.file("fleet.db"));

    expect_same(PlantStore(database).load().value(), plant);
    expect_same(load_plant(reader).value(), plant);
}

INSTANTIATE_TEST_SUITE_P(Shipped, DemoPlantStored,
                         testing::Values("pulse-line", "measuring-hall", "landmark-lab",
                                         "igps-cell", "final-assembly"),
                         [](const auto& shipped) {
                             std::string name = shipped.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(PlantStore, KeepsWhatTheCalibrationOfACameraSays) {
    Database database(":memory:");
    plant::Plant plant = demo("pulse-line");
    plant::Camera& camera = plant.vehicle_types[0].cameras[0];
    camera.k1 = -0.08;
    camera.tilt_u_rad = 0.003;
    camera.tilt_v_rad = -0.001;
    camera.frame_rate_hz = 90;
    camera.exposure_s = 1e-4;
    camera.loaded = plant::CameraMounting{{5.34, 0.001, 0.01}, 0.452, 0.002, -0.003};
    PlantStore(database).import(plant);

    const plant::Camera kept = PlantStore(database).load()->vehicle_types[0].cameras[0];
    EXPECT_EQ(kept.k1, -0.08);
    EXPECT_EQ(kept.tilt_u_rad, 0.003);
    EXPECT_EQ(kept.tilt_v_rad, -0.001);
    EXPECT_EQ(kept.frame_rate_hz, 90);
    EXPECT_EQ(kept.exposure_s, 1e-4);
    ASSERT_TRUE(kept.loaded);
    EXPECT_EQ(kept.loaded->body_from_camera, (geometry::Pose2{5.34, 0.001, 0.01}));
    EXPECT_EQ(kept.loaded->height_m, 0.452);
    EXPECT_EQ(kept.loaded->tilt_u_rad, 0.002);
    EXPECT_EQ(kept.loaded->tilt_v_rad, -0.003);
}

/// All fields but its names.
std::vector<double> numbers_of(const plant::Transmitter& t) {
    return {t.position.x_m,    t.position.y_m,   t.z_m,           t.roll_rad,
            t.pitch_rad,       t.heading_rad,    t.rate_hz,       t.first.a,
            t.first.b,         t.first.offset_m, t.second.a,      t.second.b,
            t.second.offset_m, t.range_m,        t.elevation_rad, t.sigma_rad,
            t.sigma_place_m,   t.sigma_turn_rad};
}

TEST(PlantStore, KeepsEveryFieldOfTransmittersAndReceivers) {
    Database database(":memory:");
    plant::Plant plant = demo("igps-cell");
    plant.transmitters.resize(2);
    plant.transmitters[1] = {plant::TransmitterId("other"),
                             plant::HallId("cell"),
                             {1.1, 2.2},
                             3.3,
                             0.04,
                             -0.05,
                             0.6,
                             37.7,
                             {1.8, 0.19, 0.001},
                             {-0.21, 1.9, -0.002},
                             31,
                             0.45,
                             1.6e-5,
                             2.7e-5,
                             3.8e-6};
    plant.vehicle_types[0].receivers = {{"mast", {0.11, -0.22}, 1.33}, {"nose", {1.44, 0}, 0.55}};
    PlantStore(database).import(plant);

    const plant::Plant kept = PlantStore(database).load().value();
    ASSERT_EQ(kept.transmitters.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(kept.transmitters[i].id, plant.transmitters[i].id);
        EXPECT_EQ(kept.transmitters[i].hall, plant.transmitters[i].hall);
        EXPECT_EQ(numbers_of(kept.transmitters[i]), numbers_of(plant.transmitters[i]));
    }
    ASSERT_EQ(kept.vehicle_types[0].receivers.size(), 2u);
    const plant::Receiver& mast = kept.vehicle_types[0].receivers[0];
    EXPECT_EQ(mast.name, "mast");
    EXPECT_EQ(mast.position, (geometry::Point2{0.11, -0.22}));
    EXPECT_EQ(mast.z_m, 1.33);
    EXPECT_EQ(kept.vehicle_types[0].receivers[1].name, "nose");
}

TEST(PlantStore, KeepsEveryFieldOfReflectorsAndScanners) {
    Database database(":memory:");
    plant::Plant plant = demo("measuring-hall");
    plant.reflectors.resize(2);
    plant.reflectors[1] = {plant::ReflectorId("other"), plant::HallId("hall"), {1.1, 2.2}, 0.0033};
    plant.vehicle_types[0].navigation_scanner =
        plant::NavigationScanner{{-0.7, 0.1, 0.2}, 1.9, 9, 0.005, 55, 0.03, 0.007, 1.5e-4};
    PlantStore(database).import(plant);

    const plant::Plant kept = PlantStore(database).load().value();
    ASSERT_EQ(kept.reflectors.size(), 2u);
    EXPECT_EQ(kept.reflectors[0].id, plant.reflectors[0].id);
    EXPECT_EQ(kept.reflectors[1].id.str(), "other");
    EXPECT_EQ(kept.reflectors[1].hall.str(), "hall");
    EXPECT_EQ(kept.reflectors[1].position, (geometry::Point2{1.1, 2.2}));
    EXPECT_EQ(kept.reflectors[1].sigma_m, 0.0033);
    const auto& scanner = kept.vehicle_types[0].navigation_scanner;
    ASSERT_TRUE(scanner);
    EXPECT_EQ(scanner->body_from_scanner, (geometry::Pose2{-0.7, 0.1, 0.2}));
    EXPECT_EQ(scanner->z_m, 1.9);
    EXPECT_EQ(scanner->rate_hz, 9);
    EXPECT_EQ(scanner->step_rad, 0.005);
    EXPECT_EQ(scanner->range_m, 55);
    EXPECT_EQ(scanner->reflector_radius_m, 0.03);
    EXPECT_EQ(scanner->sigma_range_m, 0.007);
    EXPECT_EQ(scanner->sigma_bearing_rad, 1.5e-4);

    PlantStore(database).import(demo("pulse-line"));
    EXPECT_FALSE(PlantStore(database).load()->vehicle_types[0].navigation_scanner);
    for (const std::string damaged : {"[", "{}", "{\"x_m\":1}"}) {
        database.sql() << "UPDATE vehicle_types SET navigation_scanner = :damaged",
            soci::use(damaged);
        EXPECT_THROW(PlantStore(database).load(), Error) << damaged;
    }
}

TEST(PlantStore, KeepsEveryFieldOfLaserScanners) {
    Database database(":memory:");
    plant::Plant plant = demo("measuring-hall");
    plant.vehicle_types[0].scanners = {{"nose", {0.8, -0.1, 0.3}, 3.3, 0.006, 25, 0.1, 0.02, 0.05}};
    PlantStore(database).import(plant);

    const auto kept = PlantStore(database).load()->vehicle_types[0].scanners;
    ASSERT_EQ(kept.size(), 1u);
    EXPECT_EQ(kept[0].name, "nose");
    EXPECT_EQ(kept[0].body_from_scanner, (geometry::Pose2{0.8, -0.1, 0.3}));
    EXPECT_EQ(kept[0].field_rad, 3.3);
    EXPECT_EQ(kept[0].step_rad, 0.006);
    EXPECT_EQ(kept[0].range_m, 25);
    EXPECT_EQ(kept[0].least_range_m, 0.1);
    EXPECT_EQ(kept[0].sigma_m, 0.02);
    EXPECT_EQ(kept[0].most_error_m, 0.05);

    plant.vehicle_types[0].scanners.clear();
    PlantStore(database).import(plant);
    EXPECT_TRUE(PlantStore(database).load()->vehicle_types[0].scanners.empty());
}

TEST(PlantStore, KeepsTheLoadRulesOfATypeAndTheUsualOnesOfTypesOfBefore) {
    Database database(":memory:");
    plant::Plant plant = demo("pulse-line");
    plant.vehicle_types[0].load_rules = {71234.5, 0.07, {{-1.5, -0.2}, {1.1, -0.2}, {0, 0.3}}};
    PlantStore(database).import(plant);

    const plant::LoadRules kept = PlantStore(database).load()->vehicle_types[0].load_rules;
    EXPECT_EQ(kept.bracket_rating_n, 71234.5);
    EXPECT_EQ(kept.most_unbalance, 0.07);
    EXPECT_EQ(kept.centre, plant.vehicle_types[0].load_rules.centre);

    database.sql() << "UPDATE vehicle_types SET load_rules = 'null'";
    const plant::LoadRules usual = PlantStore(database).load()->vehicle_types[0].load_rules;
    EXPECT_EQ(usual.bracket_rating_n, 0);
    EXPECT_EQ(usual.most_unbalance, 0.10);
    EXPECT_TRUE(usual.centre.empty());
    database.sql() << "UPDATE vehicle_types SET load_rules = '{}'";
    EXPECT_THROW(PlantStore(database).load(), Error);
}

TEST(PlantStore, KeepsHowBracketsLiftAndTheUsualWayOfTypesOfBefore) {
    Database database(":memory:");
    plant::Plant plant = demo("pulse-line");
    plant.vehicle_types[0].bracket_lift = {0.415, 0.0075};
    PlantStore(database).import(plant);
    EXPECT_EQ(PlantStore(database).load()->vehicle_types[0].bracket_lift,
              (plant::BracketLift{0.415, 0.0075}));

    database.sql() << "UPDATE vehicle_types SET bracket_lift = 'null'";
    EXPECT_EQ(PlantStore(database).load()->vehicle_types[0].bracket_lift, plant::BracketLift{});
    database.sql() << "UPDATE vehicle_types SET bracket_lift = '{}'";
    EXPECT_THROW(PlantStore(database).load(), Error);
}

TEST(PlantStore, KeepsCastersControlAndTemperaturesAndTheUsualOnesOfTypesOfBefore) {
    Database database(":memory:");
    plant::Plant plant = demo("pulse-line");
    plant::VehicleType& type = plant.vehicle_types[0];
    type.casters = {{"left", {0.5, 0.25}, 0.15}, {"right", {0.5, -0.25}, 0.125}};
    type.control = {0.02, 2.5, 6, 7.5};
    type.drive_temperatures = {55, 77};
    PlantStore(database).import(plant);
    const plant::VehicleType kept = PlantStore(database).load()->vehicle_types[0];
    ASSERT_EQ(kept.casters.size(), 2u);
    EXPECT_EQ(kept.casters[1].name, "right");
    EXPECT_EQ(kept.casters[1].position, (plant::Point2{0.5, -0.25}));
    EXPECT_EQ(kept.casters[1].diameter_m, 0.125);
    EXPECT_EQ(kept.control, type.control);
    EXPECT_EQ(kept.drive_temperatures, type.drive_temperatures);

    database.sql() << "UPDATE vehicle_types SET control = 'null'";
    EXPECT_EQ(PlantStore(database).load()->vehicle_types[0].control, plant::AxisControl{});
    database.sql() << "UPDATE vehicle_types SET control = '{}'";
    EXPECT_THROW(PlantStore(database).load(), Error);
}

TEST(PlantStore, KeepsTheFeetOfATypeAndTheUsualOnesOfTypesOfBefore) {
    Database database(":memory:");
    plant::Plant plant = demo("pulse-line");
    plant.vehicle_types[0].parking = plant::ParkingGear{
        {{"a", {1.5, 0.5}}, {"b", {-1, 0.7}}, {"c", {0.1, -0.8}}}, 0.2, 0.11, 0.03, 0.015, 91000};
    PlantStore(database).import(plant);
    const auto kept = PlantStore(database).load()->vehicle_types[0].parking;
    ASSERT_TRUE(kept);
    ASSERT_EQ(kept->feet.size(), 3u);
    EXPECT_EQ(kept->feet[1].name, "b");
    EXPECT_EQ(kept->feet[1].position, (geometry::Point2{-1, 0.7}));
    EXPECT_EQ(kept->stroke_m, 0.2);
    EXPECT_EQ(kept->clearance_m, 0.11);
    EXPECT_EQ(kept->lift_m, 0.03);
    EXPECT_EQ(kept->speed_mps, 0.015);
    EXPECT_EQ(kept->rating_n, 91000);

    plant.vehicle_types[0].parking.reset();
    PlantStore(database).import(plant);
    EXPECT_FALSE(PlantStore(database).load()->vehicle_types[0].parking);
    database.sql() << "UPDATE vehicle_types SET parking = 'before'";
    const auto usual = PlantStore(database).load()->vehicle_types[0].parking;
    ASSERT_TRUE(usual);
    EXPECT_EQ(usual->feet.size(), 4u);
    database.sql() << "UPDATE vehicle_types SET parking = '[1'";
    EXPECT_THROW(PlantStore(database).load(), Error);
}

TEST(PlantStore, KeepsEveryFieldOfLoadsAndWhatHoldsThem) {
    Database database(":memory:");
    plant::Plant plant = demo("pulse-line");
    plant::Load load = plant.loads.at(0);
    load.kind = plant::LoadKind::kInstrument;
    load.model = "tracker";
    load.centre = {0.1, -0.2};
    load.outline = geometry::rectangle(2, 1);
    load.vehicle_types = {plant.vehicle_types[0].id};
    load.names = {{"zh", "飞机"}};
    plant.loads.at(0) = load;
    plant::Load& other = plant.loads.emplace_back();
    other.id = plant::LoadId("A-103");
    other.name = "A-103";
    other.station = plant.stations.back().id;
    plant.stations.back().support = plant::Support{0.25};
    plant.stations.back().parks = true;
    PlantStore(database).import(plant);
    const auto kept = *PlantStore(database).load();
    plant.revision = kept.revision;
    expect_same(kept, plant);
    database.sql() << "UPDATE loads SET kind = 'whale'";
    EXPECT_THROW(PlantStore(database).load(), Error);
}

/// Until version 23 a vehicle had a name and a mass of what it carries.
TEST(PlantStore, WhatVehiclesCarriedBeforeIsALoadOfItsOwn) {
    const TempFolder folder;
    const std::string file = folder.file("old.db");
    {
        Database database(file);
        PlantStore(database).import(demo("pulse-line"));
        for (const char* back :
             {"DROP TABLE loads", "DROP TABLE loads_state", "DROP TABLE load_moves",
              "DROP TABLE load_sheets",
              "ALTER TABLE vehicles ADD COLUMN load_name TEXT NOT NULL DEFAULT ''",
              "ALTER TABLE vehicles ADD COLUMN load_kg REAL NOT NULL DEFAULT 0",
              "ALTER TABLE stations DROP COLUMN has_support",
              "ALTER TABLE stations DROP COLUMN support_height_m",
              "ALTER TABLE vehicle_types DROP COLUMN casters",
              "ALTER TABLE vehicle_types DROP COLUMN control",
              "ALTER TABLE vehicle_types DROP COLUMN drive_warm_c",
              "ALTER TABLE vehicle_types DROP COLUMN drive_hot_c",
              "ALTER TABLE stations DROP COLUMN parks", "ALTER TABLE stop_records DROP COLUMN load",
              "UPDATE vehicles SET load_name = 'A 101', load_kg = 18200",
              "PRAGMA user_version = 23"}) {
            database.sql() << back;
        }
    }
    Database database(file);
    const auto plant = *PlantStore(database).load();
    ASSERT_EQ(plant.loads.size(), 1u);
    const plant::Load& load = plant.loads[0];
    EXPECT_EQ(load.id, plant::LoadId("TP-01-load"));
    EXPECT_EQ(load.name, "A 101");
    EXPECT_EQ(load.mass_kg, 18200);
    EXPECT_EQ(load.vehicle, plant::VehicleId("TP-01"));
    EXPECT_EQ(load.vehicle_types, std::vector{plant.vehicles[0].type});
    EXPECT_FALSE(plant.stations.back().support);
}

TEST(PlantStore, TypesOfBeforeHaveTheScannersThatAreUsual) {
    Database database(":memory:");
    PlantStore(database).import(demo("measuring-hall"));
    database.sql() << "UPDATE vehicle_types SET scanners = 'null'";
    const auto kept = PlantStore(database).load()->vehicle_types[0].scanners;
    ASSERT_EQ(kept.size(), 2u);
    EXPECT_EQ(kept[0].name, "front left");
    database.sql() << "UPDATE vehicle_types SET scanners = '[{}]'";
    EXPECT_THROW(PlantStore(database).load(), Error);
}

TEST(PlantStore, DamagedReceiversAreAnError) {
    Database database(":memory:");
    PlantStore store(database);
    store.import(demo("igps-cell"));
    for (const std::string damaged : {"[", "[{}]", R"([{"name":"a","position":[1],"z_m":1}])"}) {
        database.sql() << "UPDATE vehicle_types SET receivers = :damaged", soci::use(damaged);
        EXPECT_THROW(store.load(), Error) << damaged;
    }
}

TEST(PlantStore, ImportReplacesAllAndRaisesTheRevision) {
    Database database(":memory:");
    PlantStore store(database);
    store.import(demo("final-assembly"));
    EXPECT_EQ(store.import(demo("pulse-line")), 2);
    plant::Plant expected = demo("pulse-line");
    expected.revision = 2;

    expect_same(store.load().value(), expected);
}

TEST(PlantStore, RefusedPlantLeavesTheStoredOne) {
    Database database(":memory:");
    PlantStore store(database);
    const plant::Plant plant = demo("pulse-line");
    store.import(plant);
    plant::Plant dangling = plant;
    dangling.vehicles[0].home = plant::StationId("nowhere");
    plant::Plant nan = plant;
    nan.markers[3].pose.x_m = std::numeric_limits<double>::quiet_NaN();

    EXPECT_THROW(store.import(dangling), Error);
    EXPECT_THROW(store.import(nan), Error);
    expect_same(store.load().value(), plant);
}

}  // namespace
}  // namespace pulseline::db
