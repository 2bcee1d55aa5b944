// Any bytes as what a client sends on one connection: requests one behind the other, read by the
// parser and the limits of a session as far as its route is known. The first byte says where the
// bytes are cut: in two pieces they must be the same requests as in one, or a proxy in front could
// see others than we do.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/router.hpp"
#include "server/sessions/request_reader.hpp"

namespace {

using namespace pulseline;

/// What a handler would get of it, in one line.
std::string line_of(api::Request request) {
    request.identity.kind = api::access::Identity::Kind::kToken;  // nothing is refused for who asks
    request.identity.role = access::Role::kAdmin;
    const auto admitted = api::admit(request, {{"https://hall.example"}});
    const auto status = admitted.refusal ? admitted.refusal->status : 200;
    return request.method + " " + request.path + " " + std::to_string(status) + " " + request.peer +
           " " + request.body;
}

std::vector<std::string> read_all(const std::vector<std::string_view>& pieces) {
    static const server::Limits limits;
    static const auto proxies = server::TrustedProxies::parse({"10.0.0.0/8"}).value();
    std::vector<std::string> read;
    server::beast::flat_buffer buffer;
    auto piece = pieces.begin();
    for (bool keep = true; keep;) {
        server::Parser parser;
        parser.header_limit(static_cast<std::uint32_t>(limits.header_bytes));
        parser.body_limit(std::numeric_limits<std::uint64_t>::max());
        api::Request request;
        bool headed = false;
        server::error_code ec;
        bool hungry = false;
        while (!ec && !parser.is_done()) {
            if (hungry || buffer.size() == 0) {
                if (piece == pieces.end()) return read;
                buffer.commit(server::net::buffer_copy(buffer.prepare(piece->size()),
                                                       server::net::buffer(*piece)));
                ++piece;
            }
            buffer.consume(parser.put(buffer.data(), ec));
            hungry = ec == server::http::error::need_more;
            if (hungry) ec = {};
            if (ec || headed || !parser.is_header_done()) continue;
            auto understood = server::to_request(limits, proxies, parser.get(), "10.0.0.1", true);
            if (!understood) {
                read.push_back(understood.error().reason.code);
                return read;
            }
            request = std::move(*understood);
            headed = true;
            parser.body_limit(limits.stranger_body_bytes);
        }
        if (ec) {  // how it ends may depend on the cut: half a head is told from a wrong one later
            api::Request unreadable;
            unreadable.request_id = server::request_id(parser.get()["X-Request-Id"]);
            (void)server::answer_to(ec, unreadable, limits.stranger_body_bytes);
            return read;
        }
        keep = parser.get().keep_alive() && !server::websocket::is_upgrade(parser.get());
        request.body = parser.release().body();
        read.push_back(line_of(std::move(request)));
    }
    return read;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    if (size < 1) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data + 1), size - 1);
    const auto cut = std::min<std::size_t>(data[0], bytes.size());
    const auto whole = read_all({bytes});
    const auto in_two = read_all({bytes.substr(0, cut), bytes.substr(cut)});
    if (whole == in_two) return 0;
    for (const auto& line : whole) std::fprintf(stderr, "whole: %s\n", line.c_str());
    for (const auto& line : in_two) std::fprintf(stderr, "cut:   %s\n", line.c_str());
    std::abort();
}
