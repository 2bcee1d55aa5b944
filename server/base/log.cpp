#include "server/base/log.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <ctime>

#include "server/base/log_queue.hpp"

namespace pulseline::server::log {
namespace {

constexpr auto kLongestFlush = std::chrono::seconds(1);

bool as_json = false;

/// Its thread may hang in a write when the process ends.
LogQueue& queue() {
    static auto* const instance = new LogQueue(STDERR_FILENO);
    return *instance;
}

/// What was logged before the end is written, if anybody reads it.
struct AtExit {
    ~AtExit() { flush(); }
};

void write(Level level, std::string_view event, const Fields& fields) {
    static const AtExit at_exit;
    queue().push(whole_line(level, event, fields));
}

const char* name_of(Level level) {
    switch (level) {
        case Level::kInfo:
            return "info";
        case Level::kWarn:
            return "warning";
        case Level::kError:
            return "error";
    }
    return "error";
}

std::string time_of_day() {
    const auto now =
        std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
    const auto whole = std::chrono::floor<std::chrono::seconds>(now);
    const std::time_t seconds = std::chrono::system_clock::to_time_t(whole);
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", utc.tm_year + 1900,
                       utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec,
                       (now - whole).count());
}

bool plain(std::string_view text) {
    return !text.empty() && text.find_first_of(" =\"\\") == std::string_view::npos;
}

}  // namespace

void start(bool json) { as_json = json; }

void info(std::string_view event, const Fields& fields) { write(Level::kInfo, event, fields); }
void warn(std::string_view event, const Fields& fields) { write(Level::kWarn, event, fields); }
void error(std::string_view event, const Fields& fields) { write(Level::kError, event, fields); }
bool flush() { return queue().flush(kLongestFlush); }
std::uint64_t dropped() { return queue().dropped(); }

std::string whole_line(Level level, std::string_view event, const Fields& fields) {
    const std::string text = line(event, fields, as_json);
    return as_json ? fmt::format("{{\"time\":\"{}\",\"level\":\"{}\",{}}}\n", time_of_day(),
                                 name_of(level), text)
                   : fmt::format("{} {} {}\n", time_of_day(), name_of(level), text);
}

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
