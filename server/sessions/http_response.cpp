#include "server/sessions/sessions.hpp"

namespace pulseline::server {
namespace {

bool accepts_gzip(const api::Request& request) {
    return request.header("accept-encoding").find("gzip") != std::string::npos;
}

void fill_asset(http::response<http::span_body<const char>>& out, const api::Request& request,
                const Asset& asset) {
    const bool packed = !asset.gzip.empty() && accepts_gzip(request);
    std::string etag(asset.etag);
    if (packed) etag.insert(etag.size() - 1, "-gz");
    out.set(http::field::etag, etag);
    out.set(http::field::vary, "Accept-Encoding");
    out.set(http::field::cache_control,
            asset.immutable ? "public, max-age=31536000, immutable" : "no-cache");
    if (request.header("if-none-match").find(etag) != std::string::npos) {
        out.result(http::status::not_modified);
        return;
    }
    out.set(http::field::content_type,
            beast::string_view(asset.content_type.data(), asset.content_type.size()));
    const auto bytes = packed ? asset.gzip : asset.bytes;
    if (packed) out.set(http::field::content_encoding, "gzip");
    out.body() = {bytes.data(), bytes.size()};
}

}  // namespace

void add_security_headers(http::fields& fields, bool tls) {
    fields.set("Content-Security-Policy",
               "default-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
               "object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'");
    fields.set("X-Content-Type-Options", "nosniff");
    fields.set("Referrer-Policy", "no-referrer");
    fields.set("Cross-Origin-Opener-Policy", "same-origin");
    fields.set("Cross-Origin-Resource-Policy", "same-origin");
    if (tls) fields.set("Strict-Transport-Security", "max-age=31536000");
}

net::awaitable<bool> write_response(Context& context, ByteStream& stream,
                                    const api::Request& request, const api::Response& response,
                                    unsigned version, bool keep_alive, const Asset* asset) {
    http::response<http::span_body<const char>> out;
    out.version(version);
    out.keep_alive(keep_alive);
    out.result(static_cast<unsigned>(response.status));
    add_security_headers(out, request.secure);
    if (!request.request_id.empty()) out.set("X-Request-Id", request.request_id);
    if (asset) {
        fill_asset(out, request, *asset);
    } else {
        if (!response.body.empty()) out.set(http::field::content_type, response.content_type);
        out.set(http::field::cache_control, "no-store");
        for (const auto& [name, value] : response.headers) {
            // set() for names we already wrote, so that a handler may decide about caching.
            if (beast::iequals(name, "cache-control")) {
                out.set(http::field::cache_control, value);
            } else {
                out.insert(name, value);
            }
        }
        out.body() = {response.body.data(), response.body.size()};
    }
    const bool bodyless = response.status == 204 || out.result() == http::status::not_modified;
    if (!bodyless) out.content_length(out.body().size());
    if (bodyless || request.method == "HEAD") out.body() = {};

    stream.lowest().expires_after(context.options.limits.write_time);
    error_code ec;
    http::response_serializer<http::span_body<const char>> serializer(out);
    if (request.method == "HEAD") {
        co_await http::async_write_header(stream, serializer, into(ec));
    } else {
        co_await http::async_write(stream, serializer, into(ec));
    }
    co_return !ec && keep_alive;
}

}  // namespace pulseline::server
