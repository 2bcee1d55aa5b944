// Accuracy and time of the QR reader on rendered images, level by level (design.md section 10).
// usage: bench_vision [images per level]
#include <fmt/core.h>

#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <ctime>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "core/plant/marker_geometry.hpp"
#include "core/simulation/floor_camera.hpp"
#include "core/vision/marker_reader.hpp"

namespace {

using namespace pulseline;
using simulation::FloorCode;
using simulation::ImageConditions;

/// Processor time of this thread: other work on the machine does not count.
double cpu_ms() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}
double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

struct Tally {
    int images = 0, right = 0, wrong = 0;
    double centre2 = 0, angle2 = 0, worst_px = 0, bias_u = 0, bias_v = 0, chi2 = 0, sigma = 0;
    std::vector<double> read_ms, render_ms;
    std::map<std::string, int> refused;
};

void run(plant::MarkerKind kind, const char* level, ImageConditions (*sample)(std::mt19937_64&),
         int images) {
    std::mt19937_64 random{2026};
    const auto uniform = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    Tally t;
    for (int i = 0; i < images; ++i) {
        const bool clean = std::string(level) == "clean";
        const ImageConditions conditions = sample(random);
        plant::Camera camera;
        camera.k1 = clean ? 0 : simulation::sample_k1(random);
        const bool any = !clean && uniform(0, 1) < 0.5;
        const double turn =
            any ? uniform(-kPi, kPi)
                : kPi / 2 * static_cast<double>(random() % 4) + radians(uniform(-3.4, 3.4));
        // The whole marker is in view; its offset fills what the view allows.
        const double size = plant::usual_size_m(kind);
        const double half = kind == plant::MarkerKind::kLandmark
                                ? size / 2
                                : size / 2 * (std::abs(std::cos(turn)) + std::abs(std::sin(turn)));
        const double room_x = 0.0855 - half - 0.001;
        const double room_y = 0.0680 - half - 0.001;
        const geometry::Pose2 camera_from_code{uniform(-room_x, room_x), uniform(-room_y, room_y),
                                               turn};
        const geometry::Pose2 body{uniform(-40, 40), uniform(-40, 40), uniform(-kPi, kPi)};
        const std::string payload =
            kind == plant::MarkerKind::kQr
                ? fmt::format("ST{:02}-{}", 1 + i % 99, i % 2 == 0 ? 'F' : 'B')
                : std::to_string(kind == plant::MarkerKind::kAprilTag ? i % 587 : 1 + i % 254);
        const std::vector<FloorCode> codes{{payload, body * camera_from_code, size, false, kind}};

        const double start = cpu_ms();
        const cv::Mat image = simulation::render_floor(camera, body, codes, conditions);
        t.render_ms.push_back(cpu_ms() - start);
        const double begin = cpu_ms();
        const auto reading = vision::read_marker(kind, image, camera);
        t.read_ms.push_back(cpu_ms() - begin);

        ++t.images;
        if (!reading) {
            ++t.refused[reading.error().reason.code];
            continue;
        }
        if (reading->payload != payload) {
            ++t.wrong;
            fmt::print("WRONG {} {} {} read {} spec {} exp {}\n",level,i,payload,reading->payload,conditions.specular,conditions.exposure);
            cv::imwrite(fmt::format("/tmp/wrong_{}.png",i),image);
            continue;
        }
        ++t.right;
        const simulation::FloorProjection projection(camera, conditions);
        const vision::Pixel truth = projection.image_from_floor(camera_from_code.position());
        const double du = reading->centre.u - truth.u;
        const double dv = reading->centre.v - truth.v;
        const double da = wrap(reading->angle_rad - (kPi / 2 - turn));
        t.centre2 += du * du + dv * dv;
        t.bias_u += du;
        t.bias_v += dv;
        t.angle2 += da * da;
        t.worst_px = std::max(t.worst_px, std::hypot(du, dv));
        t.sigma += reading->sigma_px;
        t.chi2 += (du * du + dv * dv) / (2 * reading->sigma_px * reading->sigma_px);
    }
    const double n = std::max(1, t.right);
    fmt::print(
        "{:8} {:8} images {} right {} wrong {}  centre rms {:.4f} px worst {:.4f} bias {:+.4f} "
        "{:+.4f}  "
        "angle "
        "rms {:.5f} deg  sigma {:.4f} px chi2/2 {:.2f}  read ms p50 {:.2f} p95 {:.2f}  render ms "
        "p50 {:.1f}\n",
        plant::to_string(kind), level, t.images, t.right, t.wrong, std::sqrt(t.centre2 / n),
        t.worst_px, t.bias_u / n, t.bias_v / n, degrees(std::sqrt(t.angle2 / n)), t.sigma / n,
        t.chi2 / n, quantile(t.read_ms, 0.5), quantile(t.read_ms, 0.95),
        quantile(t.render_ms, 0.5));
    for (const auto& [reason, count] : t.refused)
        fmt::print("         refused {}: {}\n", reason, count);
}

}  // namespace

int main(int argc, char** argv) {
    cv::setNumThreads(1);
    const int images = argc > 1 ? std::stoi(argv[1]) : 200;
    const std::string level = argc > 3 ? argv[3] : "";
    const std::string only = argc > 2 ? argv[2] : "";
    for (const auto kind :
         {plant::MarkerKind::kQr, plant::MarkerKind::kAprilTag, plant::MarkerKind::kLandmark}) {
    if (!only.empty() && only != plant::to_string(kind)) continue;
        if (level.empty() || level == "clean") run(kind, "clean", &ImageConditions::clean, images);
        if (level.empty() || level == "nominal") run(kind, "nominal", &ImageConditions::nominal, images);
        if (level.empty() || level == "hard") run(kind, "hard", &ImageConditions::hard, images);
    }
}
