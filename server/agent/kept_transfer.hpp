#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "core/onboard/load_handling.hpp"

namespace pulseline::agent {

/// That a vehicle has begun to take over or set down a load, and has not ended it, kept from one
/// start of its program to the next: <folder>/<vehicle>.transfer.json, or no such file. A part of
/// the load may hang beside it then.
class KeptTransfer {
public:
    /// The folder is made if need be.
    KeptTransfer(const std::filesystem::path& folder, const std::string& vehicle);

    /// Of a file that cannot be read, one of which nothing is known: better to ask once too often.
    std::optional<onboard::BegunTransfer> load() const;
    /// Whole or not at all; nullopt: it has ended. Fails with file_unwritable {file}.
    [[nodiscard]] Status save(const std::optional<onboard::BegunTransfer>& begun) const;

private:
    std::filesystem::path file_;
};

}  // namespace pulseline::agent
