#include "server/log.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace pulseline::server::log {
namespace {

bool as_json = false;

spdlog::logger& logger() {
    static const auto instance = [] {
        auto made = spdlog::stderr_logger_mt("pulseline");
        made->flush_on(spdlog::level::warn);
        return made;
    }();
    return *instance;
}

void write(spdlog::level::level_enum level, std::string_view event, const Fields& fields) {
    auto& out = logger();
    if (out.should_log(level)) out.log(level, "{}", line(event, fields, as_json));
}

bool plain(std::string_view text) {
    return !text.empty() && text.find_first_of(" =\"\\") == std::string_view::npos;
}

}  // namespace

void start(bool json) {
    as_json = json;
    logger().set_pattern(json ? R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l",%v})"
                              : "%Y-%m-%dT%H:%M:%S.%eZ %l %v",
                         spdlog::pattern_time_type::utc);
    spdlog::flush_every(std::chrono::seconds(1));
}

void info(std::string_view event, const Fields& fields) {
    write(spdlog::level::info, event, fields);
}
void warn(std::string_view event, const Fields& fields) {
    write(spdlog::level::warn, event, fields);
}
void error(std::string_view event, const Fields& fields) {
    write(spdlog::level::err, event, fields);
}
void flush() { logger().flush(); }

std::string escaped(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (byte < 0x20 || byte >= 0x7f) {
            // One form for all that is not printable ASCII: JSON readers and people both cope.
            out += fmt::format("\\u{:04x}", byte);
        } else {
            out += c;
        }
    }
    return out;
}

std::string line(std::string_view event, const Fields& fields, bool json) {
    std::string out = json ? fmt::format("\"event\":\"{}\"", escaped(event)) : escaped(event);
    for (const auto& [name, value] : fields) {
        if (value.empty()) continue;
        const std::string safe = escaped(value);
        if (json) {
            out += fmt::format(",\"{}\":\"{}\"", name, safe);
        } else if (plain(safe)) {
            out += fmt::format(" {}={}", name, safe);
        } else {
            out += fmt::format(" {}=\"{}\"", name, safe);
        }
    }
    return out;
}

}  // namespace pulseline::server::log
