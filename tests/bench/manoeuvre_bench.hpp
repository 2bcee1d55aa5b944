#pragma once

#include <nlohmann/json_fwd.hpp>

namespace pulseline::bench {

/// Free manoeuvres of the platform on the queries of the reference file: solved, time, and length
/// against the best known. Prints a table; `passed` becomes false when a figure demanded is missed.
nlohmann::json measure_manoeuvres(bool& passed);

}  // namespace pulseline::bench
