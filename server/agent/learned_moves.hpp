#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.hpp"
#include "core/control/motion_compensation.hpp"

namespace pulseline::agent {

/// What a vehicle has learned of its small moves, kept from one start of its program to the next:
/// <folder>/<vehicle>.moves.json.
class LearnedMoves {
public:
    /// The folder is made if need be.
    LearnedMoves(const std::filesystem::path& folder, const std::string& vehicle);

    /// A new vehicle's when nothing is kept. Fails with bad_learned_moves {file} when what is kept
    /// cannot be used.
    [[nodiscard]] Result<control::MotionCompensation> load() const;
    /// Whole or not at all. Fails with file_unwritable {file}.
    [[nodiscard]] Status save(const control::MotionCompensation& compensation) const;

private:
    std::filesystem::path file_;
};

}  // namespace pulseline::agent
