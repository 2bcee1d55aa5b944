#include "api/http/wire/message.hpp"

#include "api/json/utf8.hpp"

namespace pulseline::api {
namespace {

const std::string kNone;

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

const std::string& find(const std::map<std::string, std::string>& map, std::string_view name) {
    const auto it = map.find(std::string(name));
    return it == map.end() ? kNone : it->second;
}

}  // namespace

const std::string& Request::header(std::string_view lower_case_name) const {
    return find(headers, lower_case_name);
}

const std::string& Request::param(std::string_view name) const { return find(params, name); }

std::optional<std::string> Request::query_value(std::string_view name) const {
    const auto it = query.find(std::string(name));
    if (it == query.end()) return std::nullopt;
    return it->second;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = json::utf8_length(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

std::optional<std::string> percent_decoded(std::string_view text, bool plus_is_space) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        char c = text[i];
        if (c == '%') {
            if (i + 2 >= text.size()) return std::nullopt;
            const int high = hex_value(text[i + 1]);
            const int low = hex_value(text[i + 2]);
            if (high < 0 || low < 0) return std::nullopt;
            c = static_cast<char>(high * 16 + low);
            i += 2;
        } else if (c == '+' && plus_is_space) {
            c = ' ';
        }
        if (c == '\0') return std::nullopt;
        decoded.push_back(c);
    }
    if (!is_utf8(decoded)) return std::nullopt;
    return decoded;
}

bool parse_target(std::string_view target, Request& request) {
    if (target.empty() || target.front() != '/') return false;
    const auto mark = target.find('?');
    request.path = std::string(target.substr(0, mark));
    request.query.clear();
    if (!percent_decoded(request.path, false)) return false;
    if (mark == std::string_view::npos) return true;
    std::string_view rest = target.substr(mark + 1);
    while (!rest.empty()) {
        const auto end = rest.find('&');
        const std::string_view pair = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        if (pair.empty()) continue;
        const auto equals = pair.find('=');
        const auto name = percent_decoded(pair.substr(0, equals), true);
        const auto value = equals == std::string_view::npos
                               ? std::optional<std::string>("")
                               : percent_decoded(pair.substr(equals + 1), true);
        if (!name || !value) return false;
        request.query.emplace(*name, *value);
    }
    return true;
}

}  // namespace pulseline::api
