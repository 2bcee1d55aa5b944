#include "api/access/credentials.hpp"

#include <strings.h>

#include <string_view>

namespace pulseline::api::access {
namespace {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

std::string cookie_value(std::string_view header, std::string_view name) {
    while (!header.empty()) {
        const auto end = header.find(';');
        const std::string_view pair = trimmed(header.substr(0, end));
        const auto equals = pair.find('=');
        if (equals != std::string_view::npos && pair.substr(0, equals) == name) {
            return std::string(pair.substr(equals + 1));
        }
        if (end == std::string_view::npos) break;
        header.remove_prefix(end + 1);
    }
    return {};
}

}  // namespace

std::string bearer_token(const std::string& authorization) {
    constexpr std::string_view kScheme = "bearer ";
    if (authorization.size() <= kScheme.size() ||
        ::strncasecmp(authorization.data(), kScheme.data(), kScheme.size()) != 0) {
        return {};
    }
    return std::string(trimmed(std::string_view(authorization).substr(kScheme.size())));
}

Credentials credentials(const std::map<std::string, std::string>& headers) {
    Credentials found;
    if (const auto it = headers.find("authorization"); it != headers.end()) {
        found.has_bearer = true;
        found.bearer = bearer_token(it->second);
    }
    if (const auto it = headers.find("cookie"); it != headers.end()) {
        // The __Host- name cannot be planted by a neighbouring host, so it goes first.
        found.session = cookie_value(it->second, kSecureCookie);
        if (found.session.empty()) found.session = cookie_value(it->second, kCookie);
    }
    return found;
}

std::string session_cookie(const std::string& token, bool secure, long max_age_s) {
    return std::string(secure ? kSecureCookie : kCookie) + "=" + token +
           "; Path=/; HttpOnly; SameSite=Strict; Max-Age=" + std::to_string(max_age_s) +
           (secure ? "; Secure" : "");
}

std::string expired_cookie(bool secure) { return session_cookie("", secure, 0); }

}  // namespace pulseline::api::access
