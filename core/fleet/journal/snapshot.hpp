#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.hpp"

/// A fleet's whole state as bytes (Fleet::snapshot, Fleet::from_snapshot). What the plant alone
/// decides is not in it: the leg planner, the classes' places, ways and move graphs, the monitor's
/// own book.
namespace pulseline::fleet::journal {

/// Of the bytes' meaning, to be raised with every change of a struct they hold and of what the
/// fleet does with it. A snapshot of another format is passed over.
constexpr std::int64_t kFormat = 19;

/// Bytes with their checksum in front.
std::string sealed(std::string_view bytes);
/// The bytes behind a checksum that fits. Errors: journal_broken {why}.
Result<std::string_view> unsealed(std::string_view bytes);

}  // namespace pulseline::fleet::journal
