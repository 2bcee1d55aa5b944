#include "server/cli/calibrate_command.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "api/localization/camera_file.hpp"
#include "api/localization/file_bytes.hpp"
#include "api/localization/image_bytes.hpp"
#include "core/calibration/camera_calibration.hpp"
#include "core/printing/sheet_list.hpp"
#include "core/vision/marker_reader.hpp"
#include "server/cli/exit_code.hpp"
#include "server/cli/output_file.hpp"

namespace pulseline::server::cli {
namespace {

using calibration::FloorPoint;
using calibration::MountingCalibration;
using geometry::Pose2;

constexpr double kMagnify = 200;  // of the arrows in the picture of residuals
constexpr std::size_t kMostListBytes = 1'000'000;

tl::unexpected<Error> wrong(const char* code, std::string what) {
    return fail(Errc::kInvalid, code, std::move(what));
}

struct BoardSize {
    int columns = 0;
    int rows = 0;
};
Result<BoardSize> size_of(const Chessboard& board) {
    BoardSize size;
    char x = 0;
    char rest = 0;
    std::istringstream in(board.corners);
    const bool read = (in >> size.columns >> x >> size.rows) && x == 'x' && !(in >> rest);
    if (!read || size.columns < 3 || size.rows < 3 || size.columns > 100 || size.rows > 100)
        return wrong("bad_board", "--board is its inner corners, such as 9x7.");
    if (!(board.square_m > 0))
        return wrong("bad_board", "--square is the side of a square in metres.");
    return size;
}

Result<Pose2> pose_of(const std::vector<double>& numbers, const char* option) {
    if (numbers.size() < 3)
        return wrong("bad_pose", std::string(option) + " is x_m y_m heading_deg.");
    return Pose2{numbers[0], numbers[1], radians(numbers[2])};
}

Result<calibration::BoardView> board_in(const std::string& file, const cv::Mat& image,
                                        const Chessboard& board) {
    const auto size = size_of(board);
    if (!size) return fail(size.error());
    auto view = calibration::find_chessboard(image, size->columns, size->rows, board.square_m);
    if (!view) view.error().what = file + ": " + view.error().what;
    return view;
}

/// A board looks the same turned by half a turn: of the two readings the one near the drawing.
Result<MountingCalibration> mounting_by_board(const plant::Camera& start, const cv::Mat& image,
                                              const MountingInput& input) {
    const auto at = pose_of(input.board_at, "--board-at");
    if (!at) return fail(at.error());
    const auto view = board_in(input.image, image, input.board);
    if (!view) return fail(view.error());
    std::optional<MountingCalibration> best;
    std::optional<Error> why;
    for (const bool turned : {false, true}) {
        std::vector<FloorPoint> points;
        for (std::size_t i = 0; i < view->size(); ++i) {
            const auto& seen = (*view)[turned ? view->size() - 1 - i : i].image;
            const auto& board = (*view)[i].board;
            points.push_back({seen, *at * geometry::Point2{board.x_m, -board.y_m}});
        }
        auto found = calibration::calibrate_mounting(start, points);
        if (!found) {
            why = found.error();
            continue;
        }
        const double turn = std::abs(
            wrap(found->camera.body_from_camera.heading_rad - start.body_from_camera.heading_rad));
        if (turn < kPi / 2 && (!best || found->rms_px < best->rms_px)) best = std::move(*found);
    }
    if (best) return std::move(*best);
    if (why) return fail(std::move(*why));
    return wrong("far_from_drawing",
                 "The board is turned against --board-at, or the camera against --start.");
}

Result<std::vector<plant::Marker>> read_codes(const std::string& file) {
    const auto bytes = api::localization::read_bytes(file, kMostListBytes);
    if (!bytes) return fail(bytes.error());
    auto codes = printing::read_sheet_list(*bytes);
    if (!codes) codes.error().what = file + ": " + codes.error().what;
    return codes;
}

void add_corners(const plant::Marker& code, const vision::MarkerReading& reading,
                 const Pose2& body_from_list, std::vector<FloorPoint>& points) {
    const Pose2 body_from_code = body_from_list * code.pose;
    const double half_m = code.size_m / 2;
    // Code frame: x up, y to the left; corners from the top left one clockwise.
    const std::array<geometry::Point2, 4> corners{
        {{half_m, half_m}, {half_m, -half_m}, {-half_m, -half_m}, {-half_m, half_m}}};
    for (std::size_t i = 0; i < corners.size(); ++i)
        points.push_back({reading.corners[i], body_from_code * corners[i]});
}

Result<MountingCalibration> mounting_by_codes(const plant::Camera& start, const cv::Mat& image,
                                              const MountingInput& input) {
    const auto body = pose_of(input.body_at, "--body-at");
    if (!body) return fail(body.error());
    const auto codes = read_codes(input.codes_file);
    if (!codes) return fail(codes.error());
    std::vector<FloorPoint> points;
    std::set<std::pair<plant::MarkerKind, double>> kinds;
    for (const plant::Marker& code : *codes) kinds.insert({code.kind, code.size_m});
    for (const auto& [kind, size_m] : kinds) {
        vision::ReaderOptions options;
        options.size_m = size_m;
        // What is being found out must not be what a reading is refused for.
        options.max_scale_error = 0.2;
        options.max_tilt_rad = 0.2;
        const auto first = vision::read_marker(kind, image, start, options);
        if (!first) continue;
        auto readings = vision::read_others(*first, image, start, options);
        readings.push_back(*first);
        for (const auto& reading : readings) {
            for (const plant::Marker& code : *codes) {
                if (code.kind == kind && code.size_m == size_m && code.payload == reading.payload)
                    add_corners(code, reading, inverse(*body), points);
            }
        }
    }
    return calibration::calibrate_mounting(start, points);
}

int refused(const Error& error, std::ostream& out) {
    out << "pulseline: " << error.what << " (" << error.reason.code << ")\n";
    return kFailed;
}

/// Writes `found`; the picture shows the residuals as seen by `camera`.
template <typename Input>
int keep(const plant::Camera& found, const plant::Camera& camera,
         const std::vector<calibration::Residual>& residuals, const Input& input,
         std::ostream& out) {
    const auto& [file, picture] = std::tie(input.out, input.residuals);
    if (!write_file(file, api::localization::encode_camera(found))) {
        out << "pulseline: cannot write " << file << "\n";
        return kFailed;
    }
    out << file << "\n";
    if (picture.empty()) return 0;
    std::vector<unsigned char> png;
    cv::imencode(".png", calibration::residual_picture(camera, residuals, kMagnify), png);
    if (!write_file(picture, std::string(png.begin(), png.end()))) {
        out << "pulseline: cannot write " << picture << "\n";
        return kFailed;
    }
    out << picture << " (errors " << kMagnify << " times)\n";
    return 0;
}

}  // namespace

int calibrate_lens(const LensInput& input, std::ostream& out) {
    std::vector<calibration::BoardView> views;
    cv::Size size;
    for (const std::string& file : input.images) {
        const auto image = api::localization::read_grey_file(file);
        if (!image) return refused(image.error(), out);
        if (!views.empty() && image->size() != size)
            return refused({Errc::kInvalid,
                            {"other_size", {}},
                            file + " has another size than the pictures before it.",
                            {}},
                           out);
        size = image->size();
        auto view = board_in(file, *image, input.board);
        if (!view) return refused(view.error(), out);
        views.push_back(std::move(*view));
    }
    const auto lens = calibration::calibrate_lens(views, size.width, size.height);
    if (!lens) return refused(lens.error(), out);
    const plant::Camera& c = lens->camera;
    out << fmt::format(
        "F {:.2f} px (sigma {:.2f}), principal point ({:.2f}, {:.2f}) px (sigma {:.2f}), k1 {:.5f} "
        "(sigma {:.5f}); rms {:.3f} px over {} corners of {} pictures\n",
        c.f_px, lens->sigma_f_px, c.cu_px, c.cv_px, lens->sigma_centre_px, c.k1, lens->sigma_k1,
        lens->rms_px, lens->residuals.size(), views.size());
    return keep(c, c, lens->residuals, input, out);
}

int calibrate_mounting(const MountingInput& input, std::ostream& out) {
    const auto file = api::localization::read_camera_file(input.camera_file);
    if (!file) return refused(file.error(), out);
    plant::Camera drawn = *file;
    const auto image = api::localization::read_grey_file(input.image);
    if (!image) return refused(image.error(), out);
    if (!vision::is_image_of(*image, drawn))
        return refused({Errc::kInvalid,
                        {"bad_image", {}},
                        input.image + " has not the size that " + input.camera_file + " says.",
                        {}},
                       out);
    const auto start = pose_of(input.start, "--start");
    if (!start || input.start.size() != 4 || !(input.start[3] > 0))
        return refused({Errc::kInvalid,
                        {"bad_pose", {}},
                        "--start is x_m y_m heading_deg height_m as drawn.",
                        {}},
                       out);
    drawn.body_from_camera = *start;
    drawn.height_m = input.start[3];
    const auto mounting = input.codes_file.empty() ? mounting_by_board(drawn, *image, input)
                                                   : mounting_by_codes(drawn, *image, input);
    if (!mounting) return refused(mounting.error(), out);
    const plant::Camera& c = mounting->camera;
    out << fmt::format(
        "foot ({:.5f}, {:.5f}) m (sigma {:.5f}), heading {:.4f} deg (sigma {:.4f}), height {:.5f} "
        "m (sigma {:.5f}), tilt ({:.4f}, {:.4f}) deg (sigma {:.4f}); rms {:.3f} px over {} "
        "points\n",
        c.body_from_camera.x_m, c.body_from_camera.y_m, mounting->sigma_foot_m,
        degrees(c.body_from_camera.heading_rad), degrees(mounting->sigma_heading_rad), c.height_m,
        mounting->sigma_height_m, degrees(c.tilt_u_rad), degrees(c.tilt_v_rad),
        degrees(mounting->sigma_tilt_rad), mounting->rms_px, mounting->residuals.size());
    plant::Camera found = input.loaded ? *file : c;
    if (input.loaded) found.loaded = c;
    return keep(found, c, mounting->residuals, input, out);
}

void add_calibrate_command(CLI::App& app, int& exit_code) {
    auto* calibrate = app.add_subcommand("calibrate", "Calibrate a camera from pictures");
    calibrate->require_subcommand(1);

    const auto lens = std::make_shared<LensInput>();
    auto* of_lens = calibrate->add_subcommand(
        "lens", "F, principal point and k1 from a chessboard held at several tilts");
    of_lens->add_option("--board", lens->board.corners, "Inner corners, columns x rows");
    of_lens->add_option("--square", lens->board.square_m, "Side of a square, metres")->required();
    of_lens->add_option("--out", lens->out, "Camera file to write")->required();
    of_lens->add_option("--residuals", lens->residuals, "Picture of the residuals to write (PNG)");
    of_lens->add_option("IMAGE", lens->images, "Pictures of the board")->required();
    of_lens->callback([lens, &exit_code] { exit_code = calibrate_lens(*lens, std::cout); });

    const auto mounting = std::make_shared<MountingInput>();
    auto* of_mounting = calibrate->add_subcommand(
        "mounting",
        "Foot, heading, height and tilt from a board or codes on the floor; once "
        "unloaded and once loaded");
    of_mounting->add_option("--camera", mounting->camera_file, "Camera file with the lens")
        ->required();
    of_mounting
        ->add_option("--start", mounting->start, "Mounting as drawn: x_m y_m heading_deg height_m")
        ->expected(4)
        ->required();
    of_mounting->add_option("--board", mounting->board.corners, "Inner corners, columns x rows");
    of_mounting->add_option("--square", mounting->board.square_m, "Side of a square, metres");
    auto* board_at =
        of_mounting
            ->add_option("--board-at", mounting->board_at,
                         "First inner corner in the body frame and direction of its row: x_m y_m "
                         "heading_deg")
            ->expected(3);
    auto* codes = of_mounting->add_option("--codes", mounting->codes_file,
                                          "List of codes on the floor (CSV of markers sheet)");
    of_mounting
        ->add_option("--body-at", mounting->body_at,
                     "The vehicle in the frame of that list: x_m y_m heading_deg")
        ->expected(3);
    codes->excludes(board_at);
    of_mounting->add_flag("--loaded", mounting->loaded,
                          "With the load on: kept beside the unloaded mounting of --camera");
    of_mounting->add_option("--out", mounting->out, "Camera file to write")->required();
    of_mounting->add_option("--residuals", mounting->residuals,
                            "Picture of the residuals to write (PNG)");
    of_mounting->add_option("IMAGE", mounting->image, "Picture of the floor")->required();
    of_mounting->callback(
        [mounting, &exit_code] { exit_code = calibrate_mounting(*mounting, std::cout); });
}

}  // namespace pulseline::server::cli
