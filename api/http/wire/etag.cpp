#include "api/http/wire/etag.hpp"

#include <string_view>

#include "api/access/secrets.hpp"

namespace pulseline::api {
namespace {

/// Whether a comma-separated list of tags holds this one. Our tags hold no comma.
bool lists(std::string_view list, std::string_view etag, bool weak) {
    while (!list.empty()) {
        const auto end = list.find(',');
        std::string_view one = list.substr(0, end);
        while (!one.empty() && one.front() == ' ') one.remove_prefix(1);
        while (!one.empty() && one.back() == ' ') one.remove_suffix(1);
        if (weak && one.starts_with("W/")) one.remove_prefix(2);
        if (one == "*" || one == etag) return true;
        if (end == std::string_view::npos) return false;
        list.remove_prefix(end + 1);
    }
    return false;
}

}  // namespace

std::string etag_of(std::int64_t revision) { return '"' + std::to_string(revision) + '"'; }

std::string etag_of_content(const std::string& body) {
    return '"' + access::sha256_hex(body).substr(0, 16) + '"';
}

bool if_match_allows(const Request& request, const std::string& etag) {
    const auto it = request.headers.find("if-match");
    return it == request.headers.end() || lists(it->second, etag, false);
}

bool if_none_match_has(const Request& request, const std::string& etag) {
    const auto it = request.headers.find("if-none-match");
    return it != request.headers.end() && lists(it->second, etag, true);
}

}  // namespace pulseline::api
