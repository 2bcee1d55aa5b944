#pragma once

#include <map>
#include <string>

/// What the headers of a request carry as proof of who sends it.
namespace pulseline::api::access {

constexpr const char* kCookie = "pulseline_session";
constexpr const char* kSecureCookie = "__Host-pulseline_session";  // over TLS

struct Credentials {
    bool has_bearer = false;  // an Authorization header was sent, usable or not
    std::string bearer;
    std::string session;  // value of the session cookie
};
Credentials credentials(const std::map<std::string, std::string>& headers);
/// The token of an Authorization header's value; empty when it is no bearer token.
std::string bearer_token(const std::string& authorization);

/// Values of Set-Cookie.
std::string session_cookie(const std::string& token, bool secure, long max_age_s);
std::string expired_cookie(bool secure);

}  // namespace pulseline::api::access
