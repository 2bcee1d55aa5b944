#include "server/cli/calibrate_command.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "api/localization/camera_file.hpp"
#include "core/simulation/world/floor_camera.hpp"
#include "tests/db/temp_folder.hpp"

namespace pulseline::server::cli {
namespace {

namespace fs = std::filesystem;
using geometry::Point2;
using geometry::Pose2;
using simulation::ImageConditions;

constexpr double kSquare_m = 0.010;
constexpr int kColumns = 13;
constexpr int kRows = 10;
const char* const kCorners = "13x10";

plant::Camera true_camera() {
    plant::Camera camera;
    camera.f_px = 3290;
    camera.cu_px = 645;
    camera.cv_px = 508;
    camera.k1 = -0.08;
    camera.height_m = 0.4512;
    camera.body_from_camera = {5.346, -0.012, radians(1.3)};
    camera.tilt_u_rad = radians(0.4);
    camera.tilt_v_rad = radians(-0.7);
    return camera;
}

/// Mean grey of a board over a pixel; the first inner corner is the origin, its
/// row runs along x, the next ones lie to the right.
double board_grey(Point2 at, double pixel_m) {
    const auto wave = [&](double along) {
        const double squares = along / kSquare_m;
        const double edge = std::abs(squares - std::round(squares)) * kSquare_m;
        const double sign = static_cast<int>(std::floor(squares)) % 2 == 0 ? 1 : -1;
        return sign * std::min(1.0, 2 * edge / pixel_m);
    };
    const bool inside = at.x_m > -kSquare_m && at.x_m < kColumns * kSquare_m &&
                        -at.y_m > -kSquare_m && -at.y_m < kRows * kSquare_m;
    return inside ? 120 + 90 * wave(at.x_m) * wave(-at.y_m) : 210;
}

cv::Mat picture_of_board(const plant::Camera& camera, const Pose2& body_from_board) {
    const simulation::FloorProjection projection(camera, {});
    const Pose2 board_from_camera = inverse(body_from_board) * camera.body_from_camera;
    cv::Mat image(camera.height_px, camera.width_px, CV_8U);
    for (int v = 0; v < image.rows; ++v)
        for (int u = 0; u < image.cols; ++u)
            image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(board_grey(
                board_from_camera *
                    projection.floor_from_image({static_cast<double>(u), static_cast<double>(v)}),
                camera.height_m / camera.f_px));
    cv::GaussianBlur(image, image, {}, 0.7);
    return image;
}

/// The board's middle under the optical axis, turned a little.
Pose2 below(const plant::Camera& camera, double turn_rad) {
    const Point2 axis =
        simulation::FloorProjection(camera, {}).floor_from_image({camera.cu_px, camera.cv_px});
    return camera.body_from_camera * Pose2{axis.x_m, axis.y_m, turn_rad} *
           Pose2{-(kColumns - 1) * kSquare_m / 2, (kRows - 1) * kSquare_m / 2, 0};
}

class Calibrate : public testing::Test {
protected:
    std::string file(const std::string& name) const { return folder_.file(name); }
    std::string write(const std::string& name, const std::string& bytes) {
        std::ofstream(file(name), std::ios::binary) << bytes;
        return file(name);
    }
    std::string write(const std::string& name, const cv::Mat& image) {
        cv::imwrite(file(name), image);
        return file(name);
    }
    /// With the lens known and the mounting as drawn, centimetres and degrees off.
    MountingInput mounting() {
        MountingInput input;
        input.camera_file = write("lens.json", api::localization::encode_camera(true_camera()));
        input.start = {5.3, 0, 0, 0.46};
        input.out = file("camera.json");
        input.residuals = file("residuals.png");
        return input;
    }
    void expect_true_mounting(double foot_m, double tilt_rad) {
        const auto found = api::localization::read_camera_file(file("camera.json"));
        ASSERT_TRUE(found) << out_.str();
        EXPECT_NEAR(found->height_m, true_camera().height_m, foot_m);
        EXPECT_NEAR(found->tilt_u_rad, true_camera().tilt_u_rad, tilt_rad);
        EXPECT_NEAR(found->tilt_v_rad, true_camera().tilt_v_rad, tilt_rad);
        EXPECT_NEAR(found->body_from_camera.x_m, true_camera().body_from_camera.x_m, foot_m);
        EXPECT_NEAR(found->body_from_camera.y_m, true_camera().body_from_camera.y_m, foot_m);
        EXPECT_NEAR(found->body_from_camera.heading_rad, true_camera().body_from_camera.heading_rad,
                    2e-4);
        EXPECT_EQ(cv::imread(file("residuals.png")).size(), cv::Size(1280, 1024));
    }
    /// Refused: one line that ends with the reason's code, and no file.
    void expect_refused(const std::string& code) {
        EXPECT_NE(out_.str().find("(" + code + ")"), std::string::npos) << out_.str();
        EXPECT_FALSE(fs::exists(file("camera.json")));
        EXPECT_FALSE(fs::exists(file("residuals.png")));
        out_.str("");
    }

    db::TempFolder folder_;
    std::ostringstream out_;
};

TEST_F(Calibrate, FindsTheLensFromTiltedBoards) {
    LensInput input;
    input.board = {kCorners, kSquare_m};
    for (int i = 0; i < 8; ++i) {
        plant::Camera camera = true_camera();
        camera.tilt_u_rad = 0.3 * std::cos(2 * i);
        camera.tilt_v_rad = 0.3 * std::sin(2 * i);
        input.images.push_back(write("board" + std::to_string(i) + ".png",
                                     picture_of_board(camera, below(camera, 0.05 * i))));
    }
    input.out = file("camera.json");
    input.residuals = file("residuals.png");

    ASSERT_EQ(calibrate_lens(input, out_), 0) << out_.str();

    const auto found = api::localization::read_camera_file(input.out);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->f_px, 3290, 1);
    EXPECT_NEAR(found->cu_px, 645, 1);
    EXPECT_NEAR(found->cv_px, 508, 1);
    EXPECT_NEAR(found->k1, -0.08, 0.02);
    EXPECT_EQ(cv::imread(input.residuals).size(), cv::Size(1280, 1024));
}

TEST_F(Calibrate, FindsTheMountingFromABoardOnTheFloor) {
    const Pose2 at = below(true_camera(), radians(4));
    MountingInput input = mounting();
    input.image = write("floor.png", picture_of_board(true_camera(), at));
    input.board = {kCorners, kSquare_m};
    input.board_at = {at.x_m, at.y_m, degrees(at.heading_rad)};

    ASSERT_EQ(calibrate_mounting(input, out_), 0) << out_.str();

    expect_true_mounting(2e-4, radians(0.05));
}

TEST_F(Calibrate, KeepsTheMountingUnderLoadBesideTheOther) {
    const Pose2 at = below(true_camera(), radians(4));
    MountingInput input = mounting();
    const auto before = api::localization::read_camera_file(input.camera_file);
    input.image = write("floor.png", picture_of_board(true_camera(), at));
    input.board = {kCorners, kSquare_m};
    input.board_at = {at.x_m, at.y_m, degrees(at.heading_rad)};
    input.loaded = true;

    ASSERT_EQ(calibrate_mounting(input, out_), 0) << out_.str();

    const auto found = api::localization::read_camera_file(file("camera.json"));
    ASSERT_TRUE(before && found && found->loaded) << out_.str();
    EXPECT_NEAR(found->loaded->height_m, true_camera().height_m, 2e-4);
    EXPECT_NEAR(found->loaded->body_from_camera.x_m, true_camera().body_from_camera.x_m, 2e-4);
    EXPECT_NEAR(found->loaded->tilt_u_rad, true_camera().tilt_u_rad, radians(0.05));
    EXPECT_EQ(found->body_from_camera, before->body_from_camera);
    EXPECT_EQ(found->height_m, before->height_m);
}

TEST_F(Calibrate, FindsTheMountingFromCodesOfAList) {
    const Pose2 body{20, 30, 1.2};
    std::vector<simulation::FloorCode> codes;
    std::ostringstream list;
    list.precision(12);
    list << "kind,payload,size_m,x_m,y_m,up_rad\n";
    for (const Point2 at : {Point2{0.05, 0.035}, {-0.05, 0.035}, {0.05, -0.04}, {-0.05, -0.04}}) {
        const Pose2 lies = body * true_camera().body_from_camera * Pose2{at.x_m, at.y_m, 0.1};
        const auto payload = std::to_string(17 + codes.size());
        codes.push_back({payload, lies, 0.050, false, plant::MarkerKind::kAprilTag});
        list << "apriltag," << payload << ",0.05," << lies.x_m << "," << lies.y_m << ","
             << lies.heading_rad << "\n";
    }
    MountingInput input = mounting();
    input.image = write("floor.png", simulation::render_floor(true_camera(), body, codes, {}));
    input.codes_file = write("list.csv", list.str());
    input.body_at = {body.x_m, body.y_m, degrees(body.heading_rad)};

    ASSERT_EQ(calibrate_mounting(input, out_), 0) << out_.str();

    expect_true_mounting(2e-4, radians(0.05));
}

TEST_F(Calibrate, WritesNothingWhenThePicturesDoNotDetermineTheCamera) {
    const plant::Camera camera = true_camera();
    LensInput lens;
    lens.board = {kCorners, kSquare_m};
    lens.out = file("camera.json");
    lens.residuals = file("residuals.png");
    lens.images.assign(5, write("level.png", picture_of_board(camera, below(camera, 0))));
    EXPECT_EQ(calibrate_lens(lens, out_), 1);
    expect_refused("ill_conditioned");
    lens.images = {write("grey.png", cv::Mat(1024, 1280, CV_8U, cv::Scalar(99)))};
    EXPECT_EQ(calibrate_lens(lens, out_), 1);
    expect_refused("no_chessboard");
    lens.board.corners = "9";
    EXPECT_EQ(calibrate_lens(lens, out_), 1);
    expect_refused("bad_board");

    MountingInput input = mounting();
    input.image = lens.images[0];
    input.codes_file =
        write("list.csv", "kind,payload,size_m,x_m,y_m,up_rad\nqr,ST01-F,0.06,0,0,0\n");
    EXPECT_EQ(calibrate_mounting(input, out_), 1);
    expect_refused("too_few_points");
    write("list.csv", "kind,payload,size_m,x_m,y_m,up_rad\nbarcode,1,0.06,0,0,0\n");
    EXPECT_EQ(calibrate_mounting(input, out_), 1);
    expect_refused("bad_list");
    input.image = write("small.png", cv::Mat(64, 64, CV_8U, cv::Scalar(99)));
    EXPECT_EQ(calibrate_mounting(input, out_), 1);
    expect_refused("bad_image");
}

}  // namespace
}  // namespace pulseline::server::cli
