#include <fmt/core.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "api/localization/camera_file.hpp"
#include "core/localisation/error_budget.hpp"
#include "core/plant/marker_geometry.hpp"
#include "core/simulation/world/floor_camera.hpp"
#include "core/vision/marker_reader.hpp"
#include "core/vision/papers/li_landmark.hpp"
#include "tests/experiments/experiments.hpp"

namespace pulseline::experiments {
namespace {

using geometry::Point2;
using geometry::Pose2;
using plant::MarkerKind;

constexpr int kRuns = 50;
// Of a laboratory's camera.
const double kTiltCalibration_rad = localisation::ErrorBudget::kind().camera.tilt_rad;
constexpr double kMargin_m = 0.003;  // of white sheet that stays in view

struct Row {
    double actual;       // mm or deg
    double paper_error;  // as printed
    double better;       // by at least this factor
};
// Rows of 250 mm and more suffer in the paper from the distortion at the image's edge.
const std::vector<Row> kDistances{{50.45, 0.23, 3},  {99.32, 0.44, 3},   {150.50, 0.47, 3},
                                  {200.26, 0.73, 3}, {250.61, 1.38, 10}, {299.08, 5.22, 10}};
const std::vector<Row> kAngles{{0.07, 0.12, 3},  {30.67, 0.20, 3},  {59.71, 0.10, 3},
                               {90.48, 0.19, 3}, {119.25, 0.24, 3}, {150.14, 0.27, 3},
                               {180.53, 0.22, 3}};

/// A landmark as one pipeline places it in the camera's floor frame (x along +u, y along -v).
struct Seen {
    Point2 at;
    double angle_rad = 0;
};
struct Capture {
    std::optional<Seen> own;
    std::optional<Seen> paper;
};

class Rig {
public:
    Rig(const Options& options)
        : random_(options.seed), size_m_(plant::usual_size_m(MarkerKind::kLandmark)) {
        const auto camera =
            api::localization::read_camera_file(options.folder + "/landmark_camera.json");
        if (!camera) throw std::runtime_error(camera.error().what);
        camera_ = *camera;
    }

    double uniform(double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random_);
    }
    double normal(double sigma) { return std::normal_distribution<double>(0, sigma)(random_); }

    /// How far a landmark's centre may lie from the axis, along u and v.
    Point2 room() const {
        const double per_px = camera_.height_m / camera_.f_px;
        // The foot lies off the image's middle by height x tilt, and by the principal point.
        const double off_m = 0.004;
        return {camera_.width_px / 2.0 * per_px - size_m_ / 2 - kMargin_m - off_m,
                camera_.height_px / 2.0 * per_px - size_m_ / 2 - kMargin_m - off_m};
    }

    /// What stays as it is while one landmark after the other is covered.
    simulation::ImageConditions conditions() {
        auto made = simulation::ImageConditions::nominal(random_);
        made.tilt_u_rad = normal(kTiltCalibration_rad);
        made.tilt_v_rad = normal(kTiltCalibration_rad);
        made.height_error_m = 0;  // the rig stands on a table
        return made;
    }

    Capture capture(const Pose2& camera_from_mark, simulation::ImageConditions conditions) {
        conditions.seed = random_();
        const std::string payload = std::to_string(1 + random_() % 254);
        const Pose2 body{uniform(-40, 40), uniform(-40, 40), uniform(-kPi, kPi)};
        const std::vector<simulation::FloorCode> codes{
            {payload, body * camera_from_mark, size_m_, false, MarkerKind::kLandmark}};
        const cv::Mat image = simulation::render_floor(camera_, body, codes, conditions);
        Capture made;
        const auto own = vision::read_marker(MarkerKind::kLandmark, image, camera_);
        if (own && own->payload == payload) {
            made.own = Seen{{own->x_m, -own->y_m}, own->angle_rad};
        } else {
            keep_refused(image, own ? "payload " + own->payload : own.error().what);
        }
        if (const auto found = vision::li_landmark(image, camera_, size_m_)) {
            const auto pose = vision::li_p4p(*found, camera_);
            made.paper = Seen{{pose.translation.x(), -pose.translation.y()},
                              std::atan2(pose.rotation(1, 0), pose.rotation(0, 0))};
        }
        return made;
    }

private:
    /// None should be: the picture is there to find out why.
    void keep_refused(const cv::Mat& image, const std::string& why) {
        const std::string file = "refused-" + std::to_string(++refused_) + ".png";
        cv::imwrite(file, image);
        fmt::print("refused: {} ({})\n", why, file);
    }

    std::mt19937_64 random_;
    plant::Camera camera_;
    double size_m_;
    int refused_ = 0;
};

/// Errors of one pipeline in one row.
struct Tally {
    int seen = 0;
    double sum = 0;
    double absolute = 0;

    void add(double error) {
        ++seen;
        sum += error;
        absolute += std::abs(error);
    }
    double of_mean() const { return seen > 0 ? std::abs(sum) / seen : NAN; }  // as the paper counts
    double mean_absolute() const { return seen > 0 ? absolute / seen : NAN; }
};

template <class Run>
bool table(const char* title, const char* unit, const std::vector<Row>& rows, int runs, Run run) {
    fmt::print("\n{}, {} runs a row\n", title, runs);
    fmt::print("{:>10}  {:>10}  {:>24}  {:>24}  {:>8}  {}\n", unit, "paper", "its pipeline here",
               "pulseline", "better", "claimed");
    fmt::print("{:>10}  {:>10}  {:>12}{:>12}  {:>12}{:>12}\n", "actual", "printed", "of mean",
               "mean abs", "of mean", "mean abs");
    bool good = true;
    for (const Row& row : rows) {
        Tally own;
        Tally paper;
        for (int i = 0; i < runs; ++i) run(row.actual, own, paper);
        // The stricter of the two ways to count.
        const double error = std::max(own.of_mean(), own.mean_absolute());
        const bool enough = own.seen == runs && error * row.better <= row.paper_error;
        good &= enough;
        fmt::print(
            "{:>10.2f}  {:>10.2f}  {:>12.4f}{:>12.4f}  {:>12.4f}{:>12.4f}  {:>7.0f}x  {}x {}",
            row.actual, row.paper_error, paper.of_mean(), paper.mean_absolute(), own.of_mean(),
            own.mean_absolute(), row.paper_error / error, row.better, enough ? "yes" : "NO");
        if (own.seen < runs || paper.seen < runs) {
            fmt::print("  read {} of {}, its pipeline {}", own.seen, runs, paper.seen);
        }
        fmt::print("\n");
        std::fflush(stdout);
    }
    return good;
}

}  // namespace

bool landmark_accuracy(const Options& options) {
    Rig rig(options);
    const Point2 room = rig.room();
    const int runs = options.runs.value_or(kRuns);
    const bool distances = table(
        "Li 2020 Table 1: distance of two landmarks", "mm", kDistances, runs,
        [&](double actual_mm, Tally& own, Tally& paper) {
            const double actual_m = actual_mm / 1e3;
            // Both in view, as far apart as that: nearly along the image's rows.
            const double lean = rig.uniform(-0.15, 0.15);
            const Point2 half{actual_m / 2 * std::cos(lean), actual_m / 2 * std::sin(lean)};
            const double free_x = room.x_m - std::abs(half.x_m);
            const double free_y = room.y_m - std::abs(half.y_m);
            const Point2 middle{rig.uniform(-free_x, free_x), rig.uniform(-free_y, free_y)};
            const auto conditions = rig.conditions();
            const auto first = rig.capture(
                {middle.x_m - half.x_m, middle.y_m - half.y_m, rig.uniform(-kPi, kPi)}, conditions);
            const auto second = rig.capture(
                {middle.x_m + half.x_m, middle.y_m + half.y_m, rig.uniform(-kPi, kPi)}, conditions);
            const auto compare = [&](const std::optional<Seen>& a, const std::optional<Seen>& b,
                                     Tally& tally) {
                if (a && b) tally.add(1e3 * (distance(a->at, b->at) - actual_m));
            };
            compare(first.own, second.own, own);
            compare(first.paper, second.paper, paper);
        });
    const bool angles = table(
        "Li 2020 Table 2: angle between two landmarks", "deg", kAngles, runs,
        [&](double actual_deg, Tally& own, Tally& paper) {
            const auto place = [&](double turn) {
                return Pose2{rig.uniform(-room.x_m, room.x_m), rig.uniform(-room.y_m, room.y_m),
                             turn};
            };
            const double turn = rig.uniform(-kPi, kPi);
            const auto conditions = rig.conditions();
            const auto first = rig.capture(place(turn), conditions);
            const auto second = rig.capture(place(turn + radians(actual_deg)), conditions);
            const auto compare = [&](const std::optional<Seen>& a, const std::optional<Seen>& b,
                                     Tally& tally) {
                // Image angles turn from +u to +v, against the hall's.
                if (a && b)
                    tally.add(degrees(wrap(a->angle_rad - b->angle_rad - radians(actual_deg))));
            };
            compare(first.own, second.own, own);
            compare(first.paper, second.paper, paper);
        });
    fmt::print(
        "\nCamera of tests/experiments/landmark_camera.json, 1.15 m above the floor; nominal "
        "images; "
        "tilt known to 0.01 deg; the other landmark covered, as in the paper.\n");
    return distances && angles;
}

}  // namespace pulseline::experiments
