#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "api/localization/camera_file.hpp"
#include "core/control/adjustment.hpp"
#include "core/plant/marker_geometry.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "core/simulation/world/floor_camera.hpp"
#include "core/simulation/world/true_camera.hpp"
#include "core/vision/marker_reader.hpp"
#include "tests/experiments/experiments.hpp"

namespace pulseline::experiments {
namespace {

using geometry::Pose2;
using plant::MarkerKind;

constexpr int kStarts = 200;
constexpr int kStartsOfAVehicle = 20;
// The paper's vehicle was calibrated for the experiment.
const auto kErrors = localisation::ErrorBudget::kind();
constexpr double kSigma_m = 1e-4;  // of a measured pose, for the learning
constexpr double kSigma_rad = 1e-4;
constexpr double kStep_s = 0.05;
constexpr double kBetter = 10;

/// One way to adjust, and what Li 2020, Fig. 12, has for it.
struct Method {
    const char* name;
    int passes;
    bool learns;
    double paper_mm;
    double paper_deg;
};
const std::array<Method, 3> kMethods{{{"one pass", 1, false, 12.89, 9.76},
                                      {"loop", 8, false, 10.36, 3.98},
                                      {"loop, compensated", 8, true, 7.58, 2.39}}};

struct Tally {
    int ends = 0;
    int passes = 0;
    int unread = 0;
    double sum_mm = 0;
    double most_mm = 0;
    double sum_deg = 0;
    double most_deg = 0;

    void add(const Pose2& off) {
        const double mm = 1e3 * norm(off.position());
        const double deg = degrees(std::abs(off.heading_rad));
        ++ends;
        sum_mm += mm;
        sum_deg += deg;
        most_mm = std::max(most_mm, mm);
        most_deg = std::max(most_deg, deg);
    }
};

/// Li's vehicle: two driven wheels, the camera looking down from its middle.
plant::VehicleType vehicle_type(const plant::Camera& camera) {
    plant::VehicleType type;
    type.kinematics = plant::Kinematics::kDifferential;
    type.footprint = geometry::rectangle(0.8, 0.6);
    type.wheels = {{"left", {0, 0.25}, true, false, 0.2}, {"right", {0, -0.25}, true, false, 0.2}};
    type.max_speed_mps = 0.5;
    type.max_accel_mps2 = 0.3;
    type.max_turn_rate_radps = 0.5;
    type.max_turn_accel_radps2 = 0.5;
    type.cameras = {camera};
    return type;
}

/// Landmark, camera and light of one vehicle's adjustments.
class Eye {
public:
    Eye(const plant::Camera& camera, std::uint64_t seed)
        : camera_(camera),
          random_(seed),
          actual_(simulation::true_camera(camera, kErrors.camera, false, random_)) {}

    /// The landmark in the body frame, as a rendered image shows it.
    vision::ReadResult look(const Pose2& hall_from_body, const simulation::FloorCode& landmark) {
        const auto conditions = simulation::ImageConditions::nominal(random_);
        const cv::Mat image =
            simulation::render_floor(actual_, hall_from_body, std::array{landmark}, conditions);
        return vision::read_marker(MarkerKind::kLandmark, image, camera_);
    }

private:
    plant::Camera camera_;  // as the vehicle knows it
    std::mt19937_64 random_;
    plant::Camera actual_;
};

class Trial {
public:
    Trial(const Method& method, const plant::Camera& camera, std::uint64_t seed)
        : method_(method),
          camera_(camera),
          motion_(vehicle_type(camera), {}, seed, 1, 0, kErrors),
          eye_(camera, seed) {}

    /// Adjusts to a landmark that lies there as the vehicle stands.
    void adjust(const Pose2& body_from_landmark, const std::string& payload, Tally& tally) {
        const simulation::FloorCode landmark{payload, motion_.true_pose() * body_from_landmark,
                                             plant::usual_size_m(MarkerKind::kLandmark), false,
                                             MarkerKind::kLandmark};
        control::AdjustmentLimits limits;
        limits.good_m = 4e-4;
        limits.good_rad = radians(0.02);
        limits.reach_m = 0.5;
        limits.reach_rad = kPi;
        limits.passes = method_.passes;
        control::Adjustment loop(motion_.type(), limits);
        std::optional<Pose2> before;  // landmark seen from the body
        std::vector<control::Move> driven;
        for (;;) {
            const auto reading = eye_.look(motion_.true_pose(), landmark);
            if (!reading || reading->payload != payload) {
                ++tally.unread;
                break;
            }
            const Pose2 target = vision::body_from_marker(*reading, camera_);
            if (before && method_.learns) {
                const Status learned =
                    compensation_.learn({driven, *before * inverse(target), kSigma_m, kSigma_rad});
                if (!learned) throw std::runtime_error(learned.error().what);
            }
            const auto moves = loop.next(target, compensation_);
            if (!moves || moves->empty()) break;
            before = target;
            driven = control::moves_of(*moves);
            motion_.correct(control::placed(motion_.believed_pose(), *moves));
            while (!motion_.idle()) motion_.step(kStep_s);
        }
        tally.passes += loop.passes();
        tally.add(inverse(motion_.true_pose()) * landmark.pose);
    }

private:
    const Method& method_;
    const plant::Camera& camera_;
    simulation::ServoDrive motion_;
    Eye eye_;
    control::MotionCompensation compensation_;
};

/// How far from the middle of the image a landmark is seen whole.
geometry::Point2 room(const plant::Camera& camera) {
    const double per_px = camera.height_m / camera.f_px;
    const double edge_m = plant::usual_size_m(MarkerKind::kLandmark) / 2 + 0.007;
    return {camera.width_px / 2.0 * per_px - edge_m, camera.height_px / 2.0 * per_px - edge_m};
}

Tally run(const Method& method, const plant::Camera& camera, std::uint64_t seed, int starts) {
    Tally tally;
    std::mt19937_64 random(seed);  // the same starts for every method
    std::uniform_real_distribution<double> share(-1, 1);
    const geometry::Point2 free = room(camera);
    std::optional<Trial> trial;
    for (int i = 0; i < starts; ++i) {
        if (i % kStartsOfAVehicle == 0) trial.emplace(method, camera, random());
        const Pose2 start{free.x_m * share(random), free.y_m * share(random), kPi * share(random)};
        trial->adjust(start, std::to_string(1 + random() % 254), tally);
    }
    return tally;
}

void print_budget(int starts) {
    fmt::print(
        "\nLi 2020 Fig. 12: end of the adjustment to a landmark, {} random starts in view of it, "
        "any heading\n"
        "Wheel by wheel (servo drive): lost motion {:.2f} mm, wheels {:.3f} deg askew, sag {:.2f} "
        "mm "
        "at each stop, nothing of it known to what is learned\n"
        "A new vehicle every {} starts, which knows nothing of itself; nominal images, calibrated "
        "camera\n",
        starts, 1e3 * kErrors.drive.play_m, degrees(kErrors.drive.steering_common_rad),
        1e3 * kErrors.drive.fine_m, kStartsOfAVehicle);
    fmt::print("{:<18} {:>16}  {:>18}  {:>18}  {:>6}  {}\n", "", "paper, mean", "position mm",
               "heading deg", "passes", "better");
    fmt::print("{:<18} {:>8}{:>8}  {:>9}{:>9}  {:>9}{:>9}\n", "", "mm", "deg", "mean", "max",
               "mean", "max");
}

}  // namespace

bool stop_adjustment(const Options& options) {
    const auto camera =
        api::localization::read_camera_file(options.folder + "/landmark_camera.json");
    if (!camera) throw std::runtime_error(camera.error().what);
    const int starts = options.runs.value_or(kStarts);
    print_budget(starts);
    bool good = true;
    for (const Method& method : kMethods) {
        const Tally tally = run(method, *camera, options.seed, starts);
        const double mm = tally.sum_mm / tally.ends;
        const double deg = tally.sum_deg / tally.ends;
        fmt::print(
            "{:<18} {:>8.2f}{:>8.2f}  {:>9.3f}{:>9.3f}  {:>9.4f}{:>9.4f}  {:>6.2f}  {:.0f}x "
            "{:.0f}x",
            method.name, method.paper_mm, method.paper_deg, mm, tally.most_mm, deg, tally.most_deg,
            static_cast<double>(tally.passes) / tally.ends, method.paper_mm / mm,
            method.paper_deg / deg);
        if (tally.unread > 0) fmt::print("  {} images not read", tally.unread);
        good &= tally.unread == 0;
        if (method.learns) {
            const bool enough =
                kBetter * mm <= method.paper_mm && kBetter * deg <= method.paper_deg;
            good &= enough;
            fmt::print("  {:.0f}x claimed: {}", kBetter, enough ? "yes" : "NO");
        }
        fmt::print("\n");
        std::fflush(stdout);
    }
    return good;
}

}  // namespace pulseline::experiments
