#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "core/control/motion_compensation.hpp"

namespace pulseline::agent {

/// What a vehicle has learned of its small moves, and that it has begun to take over or set down a
/// load, kept from one start of its program to the next: <folder>/<vehicle>.moves.json and
/// .transfer.json.
class LearnedMoves {
public:
    /// The folder is made if need be.
    LearnedMoves(const std::filesystem::path& folder, const std::string& vehicle);

    /// A new vehicle's when nothing is kept. Fails with bad_learned_moves {file} when what is kept
    /// cannot be used.
    [[nodiscard]] Result<control::MotionCompensation> load() const;
    /// Whole or not at all. Fails with file_unwritable {file}.
    [[nodiscard]] Status save(const control::MotionCompensation& compensation) const;

    /// Of a transfer that had been begun: kg, as LoadHandling::begun_kg. One that cannot be read
    /// was begun with a load that nobody knows.
    std::optional<double> begun_transfer_kg() const;
    /// Whole or not at all; nullopt: there is none any more. Fails with file_unwritable {file}.
    [[nodiscard]] Status keep_transfer(const std::optional<double>& begun_kg) const;

private:
    std::filesystem::path file_;
    std::filesystem::path transfer_file_;
};

}  // namespace pulseline::agent
