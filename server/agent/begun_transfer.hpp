#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace pulseline::agent {

/// That a vehicle has begun to take over or set down a load, and has not ended it, kept from one
/// start of its program to the next: <folder>/<vehicle>.transfer.json, or no such file. A part of
/// the load may hang beside it then.
class BegunTransfer {
public:
    /// The folder is made if need be.
    BegunTransfer(const std::filesystem::path& folder, const std::string& vehicle);

    /// What the load weighs, kg, or 0 where nobody knows, as onboard::LoadHandling::begun_kg; of a
    /// file that cannot be read, too: better to ask once too often.
    std::optional<double> load() const;
    /// Whole or not at all; nullopt: it has ended. Fails with file_unwritable {file}.
    [[nodiscard]] Status save(const std::optional<double>& load_kg) const;

private:
    std::filesystem::path file_;
};

}  // namespace pulseline::agent
