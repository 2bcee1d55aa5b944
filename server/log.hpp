#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Structured log lines: a fixed event name and named ids, one line each, to standard error.
namespace pulseline::server::log {

using Field = std::pair<std::string_view, std::string>;
using Fields = std::vector<Field>;

void start(bool json);  // once, before threads
void info(std::string_view event, const Fields& fields = {});
void warn(std::string_view event, const Fields& fields = {});
void error(std::string_view event, const Fields& fields = {});
void flush();

/// Control characters, quotes and invalid bytes escaped, so that no input can forge a line.
std::string escaped(std::string_view text);
std::string line(std::string_view event, const Fields& fields, bool json);

}  // namespace pulseline::server::log
