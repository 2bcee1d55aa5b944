#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Structured log lines: a fixed event name and named ids, one line each, to standard error.
/// Nobody waits for who reads them: a reader that stalls loses the oldest (log_queue.hpp).
namespace pulseline::server::log {

using Field = std::pair<std::string_view, std::string>;
using Fields = std::vector<Field>;

enum class Level { kInfo, kWarn, kError };

void start(bool json);  // once, before threads
void info(std::string_view event, const Fields& fields = {});
void warn(std::string_view event, const Fields& fields = {});
void error(std::string_view event, const Fields& fields = {});
/// What was logged is written, or nobody has read it for a second: false.
bool flush();
/// Lines dropped because nobody reads them.
std::uint64_t dropped();

/// Control characters, quotes and invalid bytes escaped, so that no input can forge a line.
std::string escaped(std::string_view text);
std::string line(std::string_view event, const Fields& fields, bool json);
std::string whole_line(Level level, std::string_view event, const Fields& fields);

}  // namespace pulseline::server::log
