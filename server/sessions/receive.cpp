#include "server/sessions/receive.hpp"

#include <linux/sockios.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "api/http/wire/problem.hpp"

namespace pulseline::server {
namespace {

using Steady = std::chrono::steady_clock;

// A body may begin this much later than its head.
constexpr auto kBodyStart = std::chrono::seconds(2);

/// How the reading of a request's head ended.
struct Incoming {
    error_code ec;
    bool nothing = false;  // ended between two requests
    Steady::time_point begin;
};

/// Bytes that the other side has not taken yet.
int unread(ByteStream& stream) {
    int bytes = 0;
    ::ioctl(stream.lowest().socket().native_handle(), SIOCOUTQ, &bytes);
    return bytes;
}

net::awaitable<Incoming> read_head(Context& context, ByteStream& stream, beast::flat_buffer& buffer,
                                   Parser& parser, bool first) {
    const Limits& limits = context.options.limits;
    auto& socket = stream.lowest();
    Incoming in;
    in.begin = Steady::now();
    if (buffer.size() == 0) {
        // Between requests a client may wait longer than within one, but not to read an answer.
        auto wait = limits.keep_alive;
        if (first) wait = limits.header_time;
        const bool behind = !first && unread(stream) > 0;
        if (behind) wait = std::min(wait, limits.write_time);
        end_abruptly(stream, behind);
        socket.expires_after(wait);
        bool ended = false;
        StopList::Entry stop(context.stops, [&] {
            ended = true;
            socket.cancel();
        });
        const auto n = co_await stream.async_read_some(buffer.prepare(4096), into(in.ec));
        buffer.commit(n);
        if (in.ec || ended) {
            in.nothing = true;
            co_return in;
        }
        if (!first) in.begin = Steady::now();
    }
    end_abruptly(stream, true);
    // One deadline for all of it: each byte may come late, not every byte.
    socket.expires_at(in.begin + limits.header_time);
    co_await http::async_read_header(stream, buffer, parser, into(in.ec));
    co_return in;
}

/// What the head alone decides about the body that follows it.
struct BodyRule {
    std::optional<api::Response> refusal;  // nothing of the body is read
    std::size_t most_bytes = 0;
    Quota::Slot slot;  // held while the body is in memory
};

/// A stranger may send what a sign-in needs; who may ask a question that holds images gets room for
/// them. Whoever would be refused is refused before anything of the body is kept.
BodyRule body_rule(Context& context, api::Request request, const Parser& parser) {
    const Limits& limits = context.options.limits;
    BodyRule rule;
    request.identity = context.access.identify(request.headers, context.clock.now());
    const auto known = api::match(request);
    if (known.route || request.path.rfind("/api/", 0) == 0) {
        auto admitted = api::admit(request, context.policy);
        rule.refusal = std::move(admitted.refusal);
    }
    const bool stranger = request.identity.kind == api::access::Identity::Kind::kAnonymous;
    rule.most_bytes = stranger ? limits.stranger_body_bytes : limits.body_bytes;
    if (!stranger && known.route) {
        rule.most_bytes = std::max(rule.most_bytes, known.route->body_bytes);
    }
    const auto length = parser.content_length();
    if (!rule.refusal && length.value_or(0) > rule.most_bytes) {
        rule.refusal = api::too_large(request, rule.most_bytes);
    }
    if (rule.refusal || stranger) return rule;
    rule.slot = context.bodies.take(request.identity.name,
                                    length ? static_cast<std::size_t>(*length) : rule.most_bytes);
    if (!rule.slot) rule.refusal = api::problem(not_run(Lane::Taken::kShareIsUsed), request);
    return rule;
}

/// Reads the body, which must come in time and at a rate that is no siege.
net::awaitable<error_code> read_body(Context& context, ByteStream& stream,
                                     beast::flat_buffer& buffer, Parser& parser,
                                     Steady::time_point begin) {
    const Limits& limits = context.options.limits;
    auto& socket = stream.lowest();
    error_code ec;
    if (beast::iequals(parser.get()[http::field::expect], "100-continue")) {
        static constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
        co_await net::async_write(stream, net::buffer(kContinue), into(ec));
        if (ec) co_return ec;
    }
    const auto body_begin = Steady::now();
    std::size_t read = 0;
    while (!ec && !parser.is_done()) {
        const auto paid = std::chrono::milliseconds(1000 * read / limits.body_bytes_per_second);
        socket.expires_at(std::min(begin + limits.request_time, body_begin + kBodyStart + paid));
        read += co_await http::async_read_some(stream, buffer, parser, into(ec));
    }
    co_return ec;
}

/// A request of which no more is known than that it cannot be answered.
api::Request unreadable(const Parser::value_type& message, const std::string& peer, bool tls) {
    api::Request partial;
    partial.peer = peer;
    partial.secure = tls;
    partial.method = message.method() == http::verb::head ? "HEAD" : "GET";
    partial.request_id = request_id(message["X-Request-Id"]);
    return partial;
}

}  // namespace

void end_abruptly(ByteStream& stream, bool abruptly) {
    error_code ec;
    stream.lowest().socket().set_option(net::socket_base::linger(abruptly, 0), ec);
}

net::awaitable<Received> receive(Context& context, ByteStream& stream, beast::flat_buffer& buffer,
                                 Parser& parser, const std::string& peer, bool first) {
    const bool tls = stream.is_tls();
    parser.header_limit(static_cast<std::uint32_t>(context.options.limits.header_bytes));
    // body_rule() knows once it is known who asks for what. Not none: Beast 1.74 takes any length
    // for more than none.
    parser.body_limit(std::numeric_limits<std::uint64_t>::max());
    Received received;
    auto in = co_await read_head(context, stream, buffer, parser, first);
    if (in.nothing) {
        received.ended = true;
        co_return received;
    }
    received.request = unreadable(parser.get(), peer, tls);
    bool understood = false;
    std::size_t most_bytes = 0;
    if (!in.ec) {
        auto read = to_request(context.options.limits, context.proxies, parser.get(), peer, tls);
        understood = read.has_value();
        if (read) {
            received.request = std::move(*read);
        } else {
            received.refusal =
                api::bad_request(received.request, read.error().reason.code, read.error().what);
        }
    }
    if (understood && !parser.is_done()) {
        auto rule = body_rule(context, received.request, parser);
        most_bytes = rule.most_bytes;
        received.refusal = std::move(rule.refusal);
        received.slot = std::move(rule.slot);
        if (!received.refusal) {
            parser.body_limit(most_bytes);
            in.ec = co_await read_body(context, stream, buffer, parser, in.begin);
        }
    }
    if (in.ec) {
        received.refusal = answer_to(in.ec, received.request, most_bytes);
        received.ended = !received.refusal;
    }
    co_return received;
}

}  // namespace pulseline::server
