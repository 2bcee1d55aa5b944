// Detection, accuracy and time of every marker reader on rendered images, level by level
// (core/vision/README.md), beside the libraries and the papers' pipelines on the same images, on
// one core. usage: bench_vision [images per kind and level, default 1000] [kind] [level]
// [--own] [--benchmark_out=FILE]
// --own leaves the comparators out
#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "core/plant/marker_geometry.hpp"
#include "core/simulation/world/floor_camera.hpp"
#include "tests/bench/vision_methods.hpp"

namespace {

using namespace pulseline;
using plant::MarkerKind;
using simulation::FloorCode;
using simulation::ImageConditions;

/// Processor time of the process and its children: other work on the machine does not count.
double cpu_ms() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    rusage children{};
    getrusage(RUSAGE_CHILDREN, &children);
    return static_cast<double>(t.tv_sec + children.ru_utime.tv_sec) * 1e3 +
           static_cast<double>(t.tv_nsec) * 1e-6 +
           static_cast<double>(children.ru_utime.tv_usec) * 1e-3;
}
double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

struct Level {
    std::string_view name;
    ImageConditions (*sample)(std::mt19937_64&);
};

/// Nominal, and smeared as under the fastest vehicle of the demo plants: 1.67 m/s while a flash of
/// 0.2 ms lights the floor, at 7,292 px/m.
ImageConditions driving(std::mt19937_64& random) {
    ImageConditions conditions = ImageConditions::nominal(random);
    conditions.motion_blur_px = 2.44;
    conditions.motion_direction_rad = std::uniform_real_distribution<double>(0, kPi)(random);
    return conditions;
}
constexpr std::array<Level, 4> kLevels{{{"clean", &ImageConditions::clean},
                                        {"nominal", &ImageConditions::nominal},
                                        {"hard", &ImageConditions::hard},
                                        {"driving", &driving}}};
// A camera under way exposes for a code that the border cuts by at most so much.
constexpr double kCut_m = 0.01;

// One sigma of what odometry expects; the reader searches three times as far.
constexpr double kOdometry_m = 0.005;
constexpr double kOdometry_rad = 0.006;

/// One image and the truth about it.
struct View {
    plant::Camera camera;
    std::string payload;
    cv::Mat image;
    vision::Pixel centre;
    double angle_rad = 0;
    vision::ExpectedMarker expected;
    double render_ms = 0;
};

View make_view(MarkerKind kind, const Level& level, int number, std::mt19937_64& random) {
    const auto uniform = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    const bool clean = level.name == "clean";
    const ImageConditions conditions = level.sample(random);
    View view;
    view.camera.k1 = clean ? 0 : simulation::sample_k1(random);
    const bool any = !clean && uniform(0, 1) < 0.5;
    const double turn =
        any ? uniform(-kPi, kPi)
            : kPi / 2 * static_cast<double>(random() % 4) + radians(uniform(-3.4, 3.4));
    // The whole marker is in view, but under way; its offset fills what the view allows.
    const double size = plant::usual_size_m(kind);
    const double half = kind == MarkerKind::kLandmark
                            ? size / 2
                            : size / 2 * (std::abs(std::cos(turn)) + std::abs(std::sin(turn)));
    const double beyond = level.name == "driving" ? kCut_m : -0.001;
    const double room_x = 0.0855 - half + beyond;
    const double room_y = 0.0680 - half + beyond;
    const geometry::Pose2 camera_from_code{uniform(-room_x, room_x), uniform(-room_y, room_y),
                                           turn};
    const geometry::Pose2 body{uniform(-40, 40), uniform(-40, 40), uniform(-kPi, kPi)};
    view.payload =
        kind == MarkerKind::kQr
            ? fmt::format("ST{:02}-{}", 1 + number % 99, number % 2 == 0 ? 'F' : 'B')
            : std::to_string(kind == MarkerKind::kAprilTag ? number % 587 : 1 + number % 254);
    const std::vector<FloorCode> codes{{view.payload, body * camera_from_code, size, false, kind}};
    const double begin = cpu_ms();
    view.image = simulation::render_floor(view.camera, body, codes, conditions);
    view.render_ms = cpu_ms() - begin;
    view.centre = simulation::FloorProjection(view.camera, conditions)
                      .image_from_floor(camera_from_code.position());
    view.angle_rad = kPi / 2 - turn;
    std::mt19937_64 of_odometry(static_cast<std::uint64_t>(number));
    std::normal_distribution<double> normal;
    view.expected.body_from_marker =
        view.camera.body_from_camera * camera_from_code *
        geometry::Pose2{kOdometry_m * normal(of_odometry), kOdometry_m * normal(of_odometry),
                        kOdometry_rad * normal(of_odometry)};
    return view;
}

struct Tally {
    int images = 0, right = 0, wrong = 0, lies = 0, angles = 0, with_sigma = 0;
    double centre2 = 0, angle2 = 0, worst_px = 0, bias_u = 0, bias_v = 0, chi2 = 0;
    std::vector<double> ms;
    std::map<std::string, int> refused;

    void add(const bench::Outcome& outcome, const View& view, double took_ms) {
        ++images;
        ms.push_back(took_ms);
        if (!outcome.found) {
            ++refused[outcome.refused];
            return;
        }
        const bench::Found& found = *outcome.found;
        const double du = found.centre.u - view.centre.u;
        const double dv = found.centre.v - view.centre.v;
        const double off = std::hypot(du, dv);
        constexpr double kLie_mm = 0.2;
        lies += off * 1e3 / vision::pixels_per_metre(view.camera) > kLie_mm;
        if (!found.payload.empty() && found.payload != view.payload) {
            ++wrong;
            return;
        }
        constexpr double kNotIt_px = 25;  // something else was taken for the marker
        if (off > kNotIt_px) {
            ++refused["elsewhere"];
            return;
        }
        ++right;
        double da = wrap(found.angle_rad - view.angle_rad);
        if (found.turns_by_quarters) da -= kPi / 2 * std::round(da / (kPi / 2));
        centre2 += du * du + dv * dv;
        angle2 += da * da;
        bias_u += du;
        bias_v += dv;
        worst_px = std::max(worst_px, off);
        if (found.sigma_px > 0) {
            ++with_sigma;
            chi2 += (du * du + dv * dv) / (2 * found.sigma_px * found.sigma_px);
        }
    }
    nlohmann::json json() const {
        const double n = std::max(1, right);
        return {{"images", images},
                {"right", right},
                {"wrong_payload", wrong},
                {"errors_over_0_2_mm", lies},
                {"centre_rms_px", std::sqrt(centre2 / n)},
                {"centre_worst_px", worst_px},
                {"bias_px", {bias_u / n, bias_v / n}},
                {"angle_rms_deg", degrees(std::sqrt(angle2 / n))},
                {"chi2_per_axis", with_sigma > 0 ? chi2 / with_sigma : 0},
                {"ms_median", quantile(ms, 0.5)},
                {"ms_p95", quantile(ms, 0.95)},
                {"ms_p99", quantile(ms, 0.99)},
                {"refused", refused}};
    }
    void print(std::string_view kind, std::string_view level, std::string_view name) const {
        const double n = std::max(1, right);
        fmt::print(
            "{:9} {:8} {:23} right {:5}/{} wrong {} >0.2mm {:3}  centre rms {:.4f} worst {:.3f} px "
            "angle rms {:.4f} deg{}  ms p50 {:.2f} p95 {:.2f} p99 {:.2f}\n",
            kind, level, name, right, images, wrong, lies, std::sqrt(centre2 / n), worst_px,
            degrees(std::sqrt(angle2 / n)),
            with_sigma > 0 ? fmt::format(" chi2 {:.2f}", chi2 / with_sigma) : "", quantile(ms, 0.5),
            quantile(ms, 0.95), quantile(ms, 0.99));
        for (const auto& [reason, count] : refused)
            if (name == "pulseline") fmt::print("{:43}refused {}: {}\n", "", reason, count);
        std::fflush(stdout);
    }
};

nlohmann::json run(MarkerKind kind, const Level& level, int images, bool own_only) {
    std::mt19937_64 random{2026};
    auto methods = bench::methods(kind);
    if (own_only) methods.resize(1);
    std::vector<Tally> tallies(methods.size());
    Tally expected;
    std::vector<double> render_ms;
    for (int i = 0; i < images; ++i) {
        const View view = make_view(kind, level, i, random);
        render_ms.push_back(view.render_ms);
        for (std::size_t m = 0; m < methods.size(); ++m) {
            const double begin = cpu_ms();
            const auto outcome = methods[m].run(view.image, view.camera);
            tallies[m].add(outcome, view, cpu_ms() - begin);
        }
        const double begin = cpu_ms();
        vision::ReaderOptions options;
        options.expected = view.expected;
        const auto outcome = bench::read_ours(kind, view.image, view.camera, options);
        expected.add(outcome, view, cpu_ms() - begin);
    }
    nlohmann::json out{{"kind", plant::to_string(kind)},
                       {"level", level.name},
                       {"render_ms_median", quantile(render_ms, 0.5)},
                       {"render_ms_p95", quantile(render_ms, 0.95)}};
    for (std::size_t m = 0; m < methods.size(); ++m) {
        tallies[m].print(plant::to_string(kind), level.name, methods[m].name);
        out["methods"][methods[m].name] = tallies[m].json();
    }
    expected.print(plant::to_string(kind), level.name, "pulseline, expected");
    out["methods"]["pulseline, expected"] = expected.json();
    fmt::print("{:9} {:8} rendering one image: ms p50 {:.1f} p95 {:.1f}\n", plant::to_string(kind),
               level.name, quantile(render_ms, 0.5), quantile(render_ms, 0.95));
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    cv::setNumThreads(1);
    int images = 1000;
    bool own_only = false;
    std::string kind_only, level_only, file;
    for (int i = 1; i < argc; ++i) {
        const std::string arg = argv[i];
        if (arg.starts_with("--benchmark_out=")) {
            file = arg.substr(arg.find('=') + 1);
        } else if (arg == "--own") {
            own_only = true;
        } else if (arg.starts_with("--")) {
            continue;  // ./dev bench passes Google Benchmark's options to every program
        } else if (!arg.empty() && arg.find_first_not_of("0123456789") == std::string::npos) {
            images = std::stoi(arg);
        } else if (std::ranges::find(kLevels, arg, &Level::name) != kLevels.end()) {
            level_only = arg;
        } else {
            kind_only = arg;
        }
    }
    nlohmann::json results = nlohmann::json::array();
    for (const auto kind : {MarkerKind::kQr, MarkerKind::kAprilTag, MarkerKind::kLandmark})
        for (const Level& level : kLevels)
            if ((kind_only.empty() || kind_only == plant::to_string(kind)) &&
                (level_only.empty() || level_only == level.name))
                results.push_back(run(kind, level, images, own_only));
    if (!file.empty()) std::ofstream(file) << results.dump(2) << "\n";
}
