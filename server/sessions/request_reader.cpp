#include "server/sessions/request_reader.hpp"

#include <sodium.h>

#include <algorithm>

#include "api/http/wire/problem.hpp"

namespace pulseline::server {

std::string request_id(beast::string_view offered) {
    const auto usable = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_' || c == '.';
    };
    if (!offered.empty() && offered.size() <= 64 && std::ranges::all_of(offered, usable)) {
        return std::string(offered);
    }
    std::array<unsigned char, 12> bytes{};
    randombytes_buf(bytes.data(), bytes.size());
    std::array<char, 25> text{};
    sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
    return text.data();
}

Result<api::Request> to_request(const Limits& limits, const TrustedProxies& proxies,
                                const Parser::value_type& message, const std::string& peer,
                                bool tls) {
    api::Request request;
    request.method = std::string(message.method_string());
    request.peer = peer;
    request.secure = tls;
    request.request_id = request_id(message["X-Request-Id"]);
    std::size_t fields = 0;
    for (const auto& field : message) {
        ++fields;
        std::string name(field.name_string());
        std::ranges::transform(name, name.begin(), [](char c) {
            return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        });
        const auto [at, fresh] = request.headers.emplace(name, std::string(field.value()));
        if (fresh) continue;
        // Two of these could be read as two different requests by two programs.
        for (const char* single : {"host", "authorization", "content-length", "content-type",
                                   "origin", "idempotency-key", "if-match", "last-event-id"}) {
            if (name == single) {
                return fail(Errc::kInvalid, "duplicate_header",
                            "The header " + name + " is there twice; send it once.");
            }
        }
        at->second += name == "cookie" ? "; " : ", ";
        at->second += std::string(field.value());
    }
    if (fields > limits.header_fields) {
        return fail(Errc::kInvalid, "too_many_headers", "Too many headers; send at most 64.");
    }
    if (message.version() == 11 && message.find(http::field::host) == message.end()) {
        return fail(Errc::kInvalid, "host_missing", "HTTP/1.1 needs the header Host.");
    }
    if (message.find(http::field::transfer_encoding) != message.end()) {
        if (message.find(http::field::content_length) != message.end()) {
            return fail(Errc::kInvalid, "ambiguous_length",
                        "Send Content-Length or Transfer-Encoding, not both.");
        }
        // Read as "no body", the body would be the next request: a proxy in front may see it
        // otherwise (RFC 9112, 6.1).
        if (message.version() < 11 ||
            !beast::iequals(request.header("transfer-encoding"), "chunked")) {
            return fail(Errc::kInvalid, "bad_transfer_encoding",
                        "The only transfer coding is chunked, in HTTP/1.1; send Content-Length.");
        }
    }
    if (proxies.contains(peer)) {
        request.secure = request.header("x-forwarded-proto") == "https";
        request.peer = proxies.client(peer, request.header("x-forwarded-for"));
    }
    const auto target = message.target();
    if (!api::parse_target({target.data(), target.size()}, request)) {
        return fail(Errc::kInvalid, "bad_target",
                    "The request target must be a path with valid percent-encoding.");
    }
    return request;
}

std::optional<api::Response> answer_to(const error_code& ec, const api::Request& request,
                                       std::size_t body_limit) {
    if (ec == http::error::body_limit) return api::too_large(request, body_limit);
    if (ec == http::error::header_limit || ec == http::error::buffer_overflow) {
        return api::problem(431,
                            Error{Errc::kInvalid,
                                  {"header_too_large", {}},
                                  "The request's headers are longer than 8 KB; shorten them.",
                                  {}},
                            request);
    }
    if (ec == http::error::end_of_stream || ec == http::error::partial_message ||
        ec.category() != http::make_error_code(http::error::bad_method).category()) {
        return std::nullopt;
    }
    return api::bad_request(request, "malformed_request",
                            "The request is not valid HTTP/1.1: " + ec.message() + ".");
}

}  // namespace pulseline::server
