#include "server/base/config_file.hpp"

#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

// Some assertions of toml++ 3.3 do not hold for a mere slip of the pen ("[|limits]"): that is an
// error of the file, and not the end of the process.
[[noreturn]] static void no_toml() {
    throw std::logic_error("this is no TOML; look at keys and names in brackets");
}
#define TOML_ASSERT(holds) (static_cast<bool>(holds) ? void() : no_toml())
#include <toml++/toml.h>

namespace pulseline::server {
namespace {

// Far more than all keys need; tables nested ten thousand deep would need too much stack.
constexpr std::size_t kMostBytes = 16 * 1024;

using Setter = std::function<bool(const toml::node&)>;

Setter text(std::string& to) {
    return [&to](const toml::node& node) {
        const auto value = node.value_exact<std::string>();
        if (value) to = *value;
        return value.has_value();
    };
}
Setter boolean(bool& to) {
    return [&to](const toml::node& node) {
        const auto value = node.value_exact<bool>();
        if (value) to = *value;
        return value.has_value();
    };
}
Setter texts(std::vector<std::string>& to) {
    return [&to](const toml::node& node) {
        const auto* array = node.as_array();
        if (!array) return false;
        std::vector<std::string> values;
        for (const auto& item : *array) {
            const auto value = item.value_exact<std::string>();
            if (!value) return false;
            values.push_back(*value);
        }
        to = std::move(values);
        return true;
    };
}
template <class T>
Setter count(T& to, std::int64_t least = 1) {
    return [&to, least](const toml::node& node) {
        const auto value = node.value_exact<std::int64_t>();
        if (!value || *value < least || *value > 1'000'000'000) return false;
        to = static_cast<T>(*value);
        return true;
    };
}

std::string at(const std::string& path, const toml::source_region& region) {
    std::ostringstream out;
    out << path << ":" << region.begin.line;
    return out.str();
}

/// The text without its comment lines, which may hold what they like. toml++ 3.3 aborts on a
/// control character, and letters beyond ASCII that stand outside of quotes are undefined behaviour
/// there: neither may reach it.
Result<std::string> plain_text(const std::string& path, const std::string& text) {
    std::istringstream lines(text);
    std::string plain;
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (number == 1 && line.starts_with("\xEF\xBB\xBF"))
            line.erase(0, 3);  // some editors' mark
        const auto first = line.find_first_not_of(" \t");
        if (first != std::string::npos && line[first] == '#') line.clear();
        for (const char c : line) {
            const auto byte = static_cast<unsigned char>(c);
            const bool control = (byte < 0x20 && c != '\t' && c != '\r') || byte == 0x7F;
            if (!control && byte < 0x80) continue;
            return fail(
                Errc::kInvalid, "config_unreadable",
                path + ":" + std::to_string(number) +
                    (control ? ": there is a control character; remove it"
                             : ": there is a character beyond ASCII; write it as \\u00e4 in "
                               "double quotes, and comments on lines of their own"));
        }
        plain += line + '\n';
    }
    return plain;
}

Status apply(const std::string& path, const toml::table& table, const std::string& prefix,
             const std::map<std::string, Setter>& known, const std::set<std::string>& given) {
    for (const auto& [key, node] : table) {
        const std::string name = prefix + std::string(key.str());
        const auto setter = known.find(name);
        if (setter == known.end()) {
            return fail(Errc::kInvalid, "unknown_config_key",
                        at(path, node.source()) + ": unknown key \"" + name +
                            "\"; remove it or correct its spelling",
                        name);
        }
        if (given.contains(name)) continue;
        if (!setter->second(node)) {
            return fail(Errc::kInvalid, "wrong_config_value",
                        at(path, node.source()) + ": \"" + name +
                            "\" has a value of the wrong kind; see `pulseline serve --help`",
                        name);
        }
    }
    return {};
}

}  // namespace

Status read_config_file(const std::string& path, const std::set<std::string>& given,
                        Options& options) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes(kMostBytes + 1, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file.is_open() || file.bad()) {
        return fail(Errc::kInvalid, "config_unreadable",
                    path + ": this file cannot be read; name a file that this user may read");
    }
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return read_config(path, bytes, given, options);
}

Status read_config(const std::string& path, const std::string& bytes,
                   const std::set<std::string>& given, Options& options) {
    if (bytes.size() > kMostBytes) {
        return fail(Errc::kInvalid, "config_unreadable",
                    path + ": this file is too long; a configuration has at most 16 KB");
    }
    const auto plain = plain_text(path, bytes);
    if (!plain) return fail(plain.error());
    toml::table table;
    try {
        table = toml::parse(std::string_view(*plain), std::string_view(path));
    } catch (const toml::parse_error& e) {
        return fail(Errc::kInvalid, "config_unreadable",
                    at(path, e.source()) + ": " + std::string(e.description()));
    } catch (const std::logic_error& e) {
        return fail(Errc::kInvalid, "config_unreadable", path + ": " + e.what());
    }
    Limits& limits = options.limits;
    const std::map<std::string, Setter> limit_keys = {
        {"limits.body_bytes", count(limits.body_bytes)},
        {"limits.bodies_of_one_bytes", count(limits.bodies_of_one_bytes)},
        {"limits.bodies_bytes", count(limits.bodies_bytes)},
        {"limits.connections", count(limits.connections)},
        {"limits.connections_per_peer", count(limits.connections_per_peer)},
        {"limits.streams_per_user", count(limits.streams_per_user)},
        {"limits.requests_per_connection", count(limits.requests_per_connection)},
        {"limits.vehicle_outbox", count(limits.vehicle_outbox)},
    };
    if (const auto* section = table["limits"].as_table()) {
        if (auto done = apply(path, *section, "limits.", limit_keys, given); !done) return done;
        table.erase("limits");
    }
    const std::map<std::string, Setter> keys = {
        // Not fewer than the journal may refer to.
        {"events_kept", count(options.events_kept, 100'000)},
        {"events_kept_days", count(options.events_kept_days, 7)},
        {"db", text(options.database)},
        {"plant", text(options.plant_file)},
        {"listen", text(options.listen)},
        {"tls_cert", text(options.tls_cert)},
        {"tls_key", text(options.tls_key)},
        {"tls_self_signed", boolean(options.tls_self_signed)},
        {"behind_proxy", texts(options.behind_proxy)},
        {"allow_origins", texts(options.allow_origins)},
        {"log_json", boolean(options.log_json)},
    };
    return apply(path, table, "", keys, given);
}

}  // namespace pulseline::server
