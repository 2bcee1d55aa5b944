#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <string>
#include <vector>

namespace pulseline::server::cli {

struct Chessboard {
    std::string corners = "9x7";  // inner ones, columns x rows
    double square_m = 0;
};

struct LensInput {
    Chessboard board;
    std::vector<std::string> images;
    std::string out;        // camera file
    std::string residuals;  // picture; empty: none
};

struct MountingInput {
    std::string camera_file;  // with the lens
    /// The mounting as drawn: x_m, y_m, heading_deg of the foot in the body frame, height_m.
    std::vector<double> start;
    std::string image;
    // What lies on the floor: a board, or the codes of a list.
    Chessboard board;
    /// Of the board in the body frame: first inner corner x_m, y_m, direction of its rows in
    /// degrees; the next rows lie to the right of that.
    std::vector<double> board_at;
    /// kind,payload,size_m,x_m,y_m,up_rad as `pulseline markers sheet` writes it; empty: the board.
    std::string codes_file;
    /// The vehicle's pose in the frame of that list: x_m, y_m, heading_deg.
    std::vector<double> body_at{0, 0, 0};
    /// The picture was taken with the load on: what is found becomes the camera file's `loaded`.
    bool loaded = false;
    std::string out;
    std::string residuals;
};

/// Writes the camera file and, where wanted, the picture of residuals; nothing when the pictures do
/// not determine the camera. Returns the exit code.
int calibrate_lens(const LensInput& input, std::ostream& out);
int calibrate_mounting(const MountingInput& input, std::ostream& out);

/// `pulseline calibrate`.
void add_calibrate_command(CLI::App& app, int& exit_code);

}  // namespace pulseline::server::cli
