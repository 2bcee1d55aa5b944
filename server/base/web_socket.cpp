#include "server/base/web_socket.hpp"

namespace pulseline::server {
namespace {

constexpr std::size_t kMostBodyKept = 300;

WebSocket::Control control_of(websocket::frame_type kind) {
    switch (kind) {
        case websocket::frame_type::ping:
            return WebSocket::Control::kPing;
        case websocket::frame_type::pong:
            return WebSocket::Control::kPong;
        case websocket::frame_type::close:
            break;
    }
    return WebSocket::Control::kClose;
}

}  // namespace

struct WebSocket::Impl {
    Impl(ByteStream stream, std::size_t most_bytes)
        : socket(std::move(stream)), buffer(most_bytes + kRoom) {}
    /// A frame that is too long is seen as such and not as a full buffer.
    static constexpr std::size_t kRoom = 4096;

    websocket::stream<ByteStream> socket;
    beast::flat_buffer buffer;
};

WebSocket::WebSocket(ByteStream stream, const Settings& settings)
    : impl_(std::make_unique<Impl>(std::move(stream), settings.most_bytes)) {
    impl_->socket.next_layer().lowest().expires_never();  // the WebSocket keeps its own time
    impl_->socket.set_option(
        websocket::stream_base::timeout{settings.opening, settings.idle, settings.pings});
    impl_->socket.read_message_max(settings.most_bytes);
    impl_->socket.auto_fragment(false);
}

WebSocket::~WebSocket() = default;

net::awaitable<error_code> WebSocket::accept(const Upgrade& upgrade, const Headers& headers) {
    impl_->socket.set_option(
        websocket::stream_base::decorator([&](websocket::response_type& response) {
            response.erase(http::field::server);
            for (const auto& [name, value] : headers) response.set(name, value);
        }));
    error_code ec;
    co_await impl_->socket.async_accept(upgrade, into(ec));
    impl_->socket.set_option(websocket::stream_base::decorator([](websocket::response_type&) {}));
    co_return ec;
}

net::awaitable<WebSocket::Opened> WebSocket::open(const std::string& host, const std::string& path,
                                                  const Headers& headers) {
    impl_->socket.set_option(
        websocket::stream_base::decorator([&](websocket::request_type& request) {
            for (const auto& [name, value] : headers) request.set(name, value);
        }));
    Opened opened;
    websocket::response_type response;
    co_await impl_->socket.async_handshake(response, host, path, into(opened.ec));
    impl_->socket.set_option(websocket::stream_base::decorator([](websocket::request_type&) {}));
    if (opened.ec == websocket::error::upgrade_declined) {
        opened.status = response.result_int();
        opened.body = response.body().substr(0, kMostBodyKept);
    }
    opened.subprotocol = std::string(response[http::field::sec_websocket_protocol]);
    co_return opened;
}

net::awaitable<error_code> WebSocket::read() {
    impl_->buffer.clear();
    error_code ec;
    co_await impl_->socket.async_read(impl_->buffer, into(ec));
    co_return ec;
}

std::string_view WebSocket::message() const {
    return {static_cast<const char*>(impl_->buffer.cdata().data()), impl_->buffer.size()};
}

bool WebSocket::message_is_text() const { return impl_->socket.got_text(); }

void WebSocket::drop_message() {
    impl_->buffer.clear();
    impl_->buffer.shrink_to_fit();
}

net::awaitable<error_code> WebSocket::write(std::string_view message, bool is_text) {
    impl_->socket.text(is_text);
    error_code ec;
    co_await impl_->socket.async_write(net::buffer(message), into(ec));
    co_return ec;
}

net::awaitable<error_code> WebSocket::write_piece(std::string_view piece, bool is_last) {
    impl_->socket.text(true);
    error_code ec;
    co_await impl_->socket.async_write_some(is_last, net::buffer(piece), into(ec));
    co_return ec;
}

net::awaitable<error_code> WebSocket::ping(const char* mark) {
    error_code ec;
    co_await impl_->socket.async_ping(mark, into(ec));
    co_return ec;
}

void WebSocket::on_control(std::function<void(Control, std::string_view)> call) {
    if (!call) return impl_->socket.control_callback();
    impl_->socket.control_callback(
        [call = std::move(call)](websocket::frame_type kind, beast::string_view payload) {
            call(control_of(kind), {payload.data(), payload.size()});
        });
}

net::awaitable<error_code> WebSocket::close(std::uint16_t code, const char* reason) {
    error_code ec;
    co_await impl_->socket.async_close(
        websocket::close_reason(static_cast<websocket::close_code>(code), reason), into(ec));
    co_return ec;
}

std::uint16_t WebSocket::close_code() const { return impl_->socket.reason().code; }

std::string WebSocket::close_reason() const {
    const auto& reason = impl_->socket.reason().reason;
    return {reason.data(), reason.size()};
}

ByteStream& WebSocket::stream() { return impl_->socket.next_layer(); }

}  // namespace pulseline::server
