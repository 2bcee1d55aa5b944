#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/plant/plant.hpp"

namespace pulseline::server::cli {

constexpr int kLocateDone = 0;  // found or not
constexpr int kLocateUnreadable = 2;

struct LocateInput {
    std::string camera_file;
    std::optional<plant::MarkerKind> kind;  // nothing: all kinds
    std::vector<std::string> images;
    bool json = false;
};

/// Prints one line per accepted marker, or one with the reason per image without any.
/// kLocateUnreadable when the camera file or an image cannot be read; the other images
/// are still looked at.
int locate(const LocateInput& input, std::ostream& out);

/// `pulseline locate`.
void add_locate_command(CLI::App& app, int& exit_code);

}  // namespace pulseline::server::cli
