#include "server/cli/locate_command.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "api/localization/camera_file.hpp"
#include "tests/core/vision/marker_view.hpp"

namespace pulseline::server::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using plant::MarkerKind;

class Locate : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() /
                  (std::string("pulseline_locate_") +
                   testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
        input_.camera_file = write("camera.json", api::localization::encode_camera({}));
        input_.json = true;
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& bytes) {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return (folder_ / name).string();
    }
    std::string write(const std::string& name, const cv::Mat& image) {
        cv::imwrite((folder_ / name).string(), image);
        return (folder_ / name).string();
    }
    std::vector<json> lines(int expected_exit) {
        std::ostringstream out;
        EXPECT_EQ(locate(input_, out), expected_exit);
        std::vector<json> all;
        std::istringstream in(out.str());
        for (std::string line; std::getline(in, line);) all.push_back(json::parse(line));
        return all;
    }

    fs::path folder_;
    LocateInput input_;
};

TEST_F(Locate, PrintsOneLineWithEverythingPerAcceptedMarker) {
    vision::MarkerView view;
    view.kind = MarkerKind::kLandmark;
    view.payload = "85";
    input_.images = {write("landmark.png", view.image())};

    const auto all = lines(kLocateDone);

    ASSERT_EQ(all.size(), 1U);
    const json& line = all[0];
    EXPECT_EQ(line["image"], input_.images[0]);
    EXPECT_EQ(line["found"], true);
    EXPECT_EQ(line["kind"], "landmark");
    EXPECT_EQ(line["payload"], "85");
    EXPECT_NEAR(line["center_px"][0], view.true_centre().u, 0.02);
    EXPECT_NEAR(line["center_px"][1], view.true_centre().v, 0.02);
    EXPECT_NEAR(line["x_m"], view.camera_from_code.x_m, 3e-6);
    EXPECT_NEAR(line["y_m"], -view.camera_from_code.y_m, 3e-6);
    EXPECT_NEAR(line["angle_rad"], kPi / 2 - view.camera_from_code.heading_rad, 1e-4);
    for (const char* name : {"rms_px", "inliers", "time_ms"})
        EXPECT_TRUE(line[name].is_number()) << name;
}

TEST_F(Locate, SaysWhyItAcceptsNothingAndStillEndsWell) {
    input_.images = {write("black.png", cv::Mat(1024, 1280, CV_8U, cv::Scalar(0))),
                     write("white.png", cv::Mat(1024, 1280, CV_8U, cv::Scalar(255))),
                     write("small.png", cv::Mat(512, 640, CV_8U, cv::Scalar(9)))};
    vision::MarkerView mirrored;
    mirrored.mirrored = true;
    input_.images.push_back(write("mirrored.png", mirrored.image()));

    const auto all = lines(kLocateDone);

    ASSERT_EQ(all.size(), 4U);
    const std::array<const char*, 4> reasons{"no_code", "no_code", "bad_image", "mirrored"};
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i]["found"], false);
        EXPECT_EQ(all[i]["reason"], reasons[i]);
    }
}

TEST_F(Locate, UnreadableInputsEndWithTwoAndTheRestIsStillLookedAt) {
    const vision::MarkerView view;
    const std::string good = write("good.png", view.image());
    std::ifstream file(good, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::string huge = bytes;  // a header of 100,000 x 100,000 pixels
    huge.replace(16, 8, std::string("\0\x01\x86\xA0\0\x01\x86\xA0", 8));
    input_.images = {write("empty.png", std::string()),
                     write("cut.png", bytes.substr(0, bytes.size() / 2)),
                     write("huge.png", huge),
                     write("text.png", std::string("this is no image")),
                     write("big.pgm", std::string("P5\n99999999 99999999\n255\n")),
                     (folder_ / "missing.png").string(),
                     folder_.string(),
                     good};

    const auto all = lines(kLocateUnreadable);

    ASSERT_EQ(all.size(), 8U);
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(all[i]["found"], false);
        EXPECT_EQ(all[i]["reason"], i < 5 ? "image_unreadable" : "file_unreadable") << i;
    }
    EXPECT_EQ(all[7]["payload"], "17");
}

TEST_F(Locate, ABadCameraFileIsUnreadableInput) {
    for (const char* text : {"", "[]", "{\"width_px\":1280}", "{\"f_px\":-1}"}) {
        input_.camera_file = write("camera.json", std::string(text));
        input_.images = {"anything.png"};
        const auto all = lines(kLocateUnreadable);
        ASSERT_EQ(all.size(), 1U);
        EXPECT_EQ(all[0]["found"], false);
    }
}

}  // namespace
}  // namespace pulseline::server::cli
