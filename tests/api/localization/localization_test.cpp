#include "api/localization/localization.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "core/simulation/world/floor_camera.hpp"
#include "tests/core/plant/loads.hpp"

namespace pulseline::api::localization {

using namespace vision;

namespace {

using geometry::Pose2;

const plant::VehicleId kVehicle("TP-01");
constexpr double kCamera_m = 5.346;  // ahead of and behind the platform's centre

plant::Camera camera(const char* name, const Pose2& at) {
    plant::Camera made;
    made.name = name;
    made.body_from_camera = at;
    made.k1 = -0.06;
    return made;
}

/// Stations 4 and 5 of two codes each, and a platform with a camera at each end.
plant::Plant two_stations() {
    plant::Plant plant;
    plant.halls.emplace_back();
    plant.halls.back().id = plant::HallId("hall");
    plant::VehicleType type;
    type.id = plant::VehicleTypeId("platform");
    type.cameras = {camera("front", {kCamera_m, 0, 0}), camera("back", {-kCamera_m, 0, 0})};
    plant.vehicle_types.push_back(type);
    plant::Vehicle vehicle;
    vehicle.id = kVehicle;
    vehicle.type = type.id;
    plant.vehicles.push_back(vehicle);
    for (const int number : {4, 5}) {
        plant::Station station;
        station.id = plant::StationId("s" + std::to_string(number));
        station.number = number;
        station.hall = plant.halls.back().id;
        station.pose = {10.0 * number, 20, radians(30)};
        station.tolerance.dx_m = station.tolerance.dy_m = 0.025;
        station.tolerance.dheading_rad = 0.0035;
        for (const auto& [side, ahead_m] : {std::pair{"F", kCamera_m}, {"B", -kCamera_m}}) {
            plant::Marker marker;
            marker.payload = "ST0" + std::to_string(number) + "-" + side;
            marker.id = plant::MarkerId(marker.payload);
            marker.hall = station.hall;
            marker.pose = station.pose * Pose2{ahead_m, 0, 0};
            station.markers.push_back(marker.id);
            plant.markers.push_back(marker);
        }
        plant.stations.push_back(station);
    }
    return plant;
}

std::string png(const cv::Mat& image) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(".png", image, bytes);
    return {bytes.begin(), bytes.end()};
}

class Localize : public ::testing::Test {
protected:
    /// What a camera of the platform sees when it stands at the pose.
    cv::Mat view(const char* name, const Pose2& stands) {
        const auto& cameras = plant.vehicle_types[0].cameras;
        const auto& seen_by = std::string(name) == "front" ? cameras[0] : cameras[1];
        std::vector<simulation::FloorCode> codes;
        for (const auto& marker : plant.markers) {
            codes.push_back({marker.payload, marker.pose, marker.size_m, false});
        }
        return simulation::render_floor(seen_by, stands, codes,
                                        simulation::ImageConditions::nominal(random));
    }
    LocalizationQuestion question(const Pose2& stands, std::optional<int> station = {}) {
        return {kVehicle,
                station,
                {{"front", png(view("front", stands))}, {"back", png(view("back", stands))}}};
    }
    std::string reason(const LocalizationQuestion& asked) {
        const auto answer = localize(plant, asked);
        if (!answer) return answer.error().reason.code + " " + answer.error().field;
        return answer->fix ? "fixed" : answer->fix.error().reason.code;
    }

    plant::Plant plant = two_stations();
    Pose2 at_4 = plant.stations[0].pose * Pose2{0.012, -0.008, radians(0.1)};
    std::mt19937_64 random{3};
};

TEST_F(Localize, TwoImagesGivePoseDeviationAndPictures) {
    const auto answer = localize(plant, question(at_4));

    ASSERT_TRUE(answer);
    ASSERT_TRUE(answer->fix) << answer->fix.error().what;
    EXPECT_EQ(answer->fix->method, localisation::Method::kDualCamera);
    EXPECT_NEAR(answer->fix->pose.x_m, at_4.x_m, 1e-4);
    EXPECT_NEAR(answer->fix->pose.y_m, at_4.y_m, 1e-4);
    EXPECT_NEAR(answer->fix->pose.heading_rad, at_4.heading_rad, 5e-5);
    ASSERT_TRUE(answer->station);
    EXPECT_EQ(answer->station->number, 4);
    EXPECT_NEAR(answer->deviation.along_m, 0.012, 1e-4);
    EXPECT_NEAR(answer->deviation.left_m, -0.008, 1e-4);
    EXPECT_TRUE(answer->deviation.inside);
    ASSERT_EQ(answer->cameras.size(), 2u);
    EXPECT_EQ(answer->cameras[0].reading->payload, "ST04-F");
    EXPECT_EQ(answer->cameras[0].picture.substr(0, 2), "\xFF\xD8");
}

TEST_F(Localize, ALoadedVehicleIsPlacedByItsCamerasUnderLoad) {
    const auto asked = question(at_4);
    // What took the images is the mounting under load; without load the cameras look elsewhere.
    for (plant::Camera& camera : plant.vehicle_types[0].cameras) {
        camera.loaded = plant::CameraMounting{camera.body_from_camera, camera.height_m, 0, 0};
        camera.body_from_camera.y_m += 0.003;
        camera.height_m += 0.002;
    }
    const auto unloaded = localize(plant, asked);
    plant::builders::put_on(plant, 0, "A-101", 22'000);
    const auto loaded = localize(plant, asked);

    ASSERT_TRUE(unloaded && unloaded->fix && loaded && loaded->fix);
    EXPECT_GT(distance(unloaded->fix->pose.position(), at_4.position()), 0.002);
    EXPECT_LT(distance(loaded->fix->pose.position(), at_4.position()), 1e-4);
}

TEST_F(Localize, WithOneCodeCoveredTheOtherGivesLess) {
    auto asked = question(at_4);
    asked.images[1].bytes = png(cv::Mat(1024, 1280, CV_8U, cv::Scalar(120)));

    const auto answer = localize(plant, asked);

    ASSERT_TRUE(answer && answer->fix);
    EXPECT_EQ(answer->fix->method, localisation::Method::kSingleCamera);
    ASSERT_FALSE(answer->cameras[1].reading);
    EXPECT_EQ(answer->cameras[1].reading.error().reason.code, "no_code");
    EXPECT_GT(answer->fix->sigma_xy_m, 1e-3);
}

TEST_F(Localize, ACodeOfAnotherStationIsRefusedByName) {
    const auto answer = localize(plant, question(at_4, 5));

    ASSERT_TRUE(answer);
    ASSERT_FALSE(answer->fix);
    EXPECT_EQ(answer->fix.error().reason.code, "unknown_code");
}

TEST_F(Localize, ImagesOrCodesExchangedForEachOtherAreRefused) {
    auto images = question(at_4);
    std::swap(images.images[0].bytes, images.images[1].bytes);
    EXPECT_EQ(reason(images), "code_angle_mismatch");

    // The drawing has them the right way round, the floor does not.
    const auto codes = question(at_4);
    std::swap(plant.markers[0].pose, plant.markers[1].pose);
    EXPECT_EQ(reason(codes), "code_angle_mismatch");
}

TEST_F(Localize, AVehicleTheWrongWayRoundIsFarOutsideTolerance) {
    const auto answer = localize(plant, question(plant.stations[0].pose * Pose2{0, 0, kPi}));

    ASSERT_TRUE(answer && answer->fix);
    EXPECT_NEAR(std::abs(answer->deviation.dheading_rad), kPi, 1e-3);
    EXPECT_FALSE(answer->deviation.inside);
}

TEST_F(Localize, AMirroredImageIsRefused) {
    auto asked = question(at_4);
    for (auto& image : asked.images) {
        const cv::Mat seen = view(image.camera.c_str(), at_4);
        cv::Mat mirrored;
        cv::flip(seen, mirrored, 1);
        image.bytes = png(mirrored);
    }

    const auto answer = localize(plant, asked);

    ASSERT_TRUE(answer);
    EXPECT_FALSE(answer->fix);
    for (const auto& camera : answer->cameras) EXPECT_FALSE(camera.reading);
}

TEST_F(Localize, WhatIsNoImageOfTheCameraIsRefusedWithTheField) {
    const auto with = [&](std::string bytes) {
        return LocalizationQuestion{kVehicle, {}, {{"front", std::move(bytes)}}};
    };
    const auto plain = [](int rows, int columns, int grey) {
        return png(cv::Mat(rows, columns, CV_8U, cv::Scalar(grey)));
    };
    const std::string good = png(view("front", at_4));
    EXPECT_EQ(reason(with("")), "image_unreadable /images/0/image");
    EXPECT_EQ(reason(with("no image at all")), "image_unreadable /images/0/image");
    EXPECT_EQ(reason(with(good.substr(0, good.size() / 2))), "image_unreadable /images/0/image");
    // Begins like a PGM and is a DICOM image to OpenCV, whose reader of those ends the process.
    const std::string dicom =
        std::string("DICM\x02\0\x09\0UI\x06\x35\x13\x31\xdc\x6f\x31\x44", 18) +
        "\x0e\x15\x7c\xb8\x31\xae 4 4 255\n" + std::string(64, 'a');
    EXPECT_EQ(reason(with("P5#\n4 4 255\n" + std::string(116, 'x') + dicom)),
              "image_unreadable /images/0/image");
    EXPECT_EQ(reason(with(plain(100, 100, 0))), "image_size /images/0/image");
    EXPECT_EQ(reason(with(plain(8000, 8000, 0))), "image_unreadable /images/0/image");
    EXPECT_EQ(reason(with(plain(1024, 1280, 0))), "no_marker_in_view");
    EXPECT_EQ(reason(with(plain(1024, 1280, 255))), "no_marker_in_view");
}

TEST_F(Localize, WhatThePlantDoesNotHaveIsRefusedWithTheField) {
    const auto asked = question(at_4);
    auto wrong = asked;
    wrong.vehicle = plant::VehicleId("TP-09");
    EXPECT_EQ(reason(wrong), "unknown_vehicle /vehicle");
    wrong = asked;
    wrong.station = 9;
    EXPECT_EQ(reason(wrong), "unknown_station /station");
    wrong = asked;
    wrong.images[1].camera = "left";
    EXPECT_EQ(reason(wrong), "unknown_camera /images/1/camera");
    wrong = asked;
    wrong.images[1].camera = "front";
    EXPECT_EQ(reason(wrong), "camera_twice /images/1/camera");
}

}  // namespace
}  // namespace pulseline::api::localization
