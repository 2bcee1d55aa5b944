#include "tests/server/ws_client.hpp"

#include <deque>
#include <nlohmann/json.hpp>

#include "server/base/net.hpp"

namespace pulseline::server::testing {

struct WsClient::Impl {
    net::io_context io;
    websocket::stream<beast::tcp_stream> socket{io};
    http::response<http::string_body> answer;
    bool open = false;
    std::deque<std::string> changes;  // of the last frame that joined several

    /// Runs one asynchronous operation to its end, at most 10 s.
    error_code finish(std::function<void(std::function<void(error_code)>)> start) {
        error_code result = net::error::timed_out;
        start([&result](error_code ec) { result = ec; });
        io.restart();
        io.run_for(std::chrono::seconds(10));
        if (!io.stopped()) {
            beast::get_lowest_layer(socket).close();
            io.run();
        }
        return result;
    }
};

WsClient::WsClient(std::uint16_t port, const std::string& path,
                   const std::map<std::string, std::string>& headers)
    : impl_(std::make_unique<Impl>()) {
    auto& socket = impl_->socket;
    beast::get_lowest_layer(socket).socket().connect({net::ip::address_v4::loopback(), port});
    socket.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
        for (const auto& [name, value] : headers) request.set(name, value);
    }));
    const auto ec = impl_->finish([&](auto done) {
        socket.async_handshake(impl_->answer, "127.0.0.1:" + std::to_string(port), path,
                               std::move(done));
    });
    impl_->open = !ec;
}

WsClient::~WsClient() = default;

int WsClient::status() const {
    return impl_->open ? 101 : static_cast<int>(impl_->answer.result_int());
}
std::string WsClient::problem() const { return impl_->answer.body(); }

void WsClient::send(const std::string& text) {
    impl_->socket.text(true);
    impl_->finish([&](auto done) {
        impl_->socket.async_write(net::buffer(text),
                                  [done](error_code ec, std::size_t) { done(ec); });
    });
}

void WsClient::send_binary(const std::string& bytes) {
    impl_->socket.binary(true);
    impl_->finish([&](auto done) {
        impl_->socket.async_write(net::buffer(bytes),
                                  [done](error_code ec, std::size_t) { done(ec); });
    });
}

std::optional<std::string> WsClient::read() {
    auto& changes = impl_->changes;
    while (changes.empty()) {
        const auto text = read_message();
        if (!text || !text->starts_with(R"({"type":"changes")")) return text;
        const auto frame = nlohmann::ordered_json::parse(*text);
        for (const auto& change : frame["changes"]) {
            changes.push_back(change.dump());
        }
    }
    const std::string change = std::move(changes.front());
    changes.pop_front();
    return change;
}

std::optional<std::string> WsClient::read_message() {
    beast::flat_buffer buffer;
    const auto ec = impl_->finish([&](auto done) {
        impl_->socket.async_read(buffer, [done](error_code e, std::size_t) { done(e); });
    });
    if (ec) return std::nullopt;
    return beast::buffers_to_string(buffer.data());
}

std::optional<std::string> WsClient::read_until(const std::string& part) {
    while (auto text = read()) {
        if (text->find(part) != std::string::npos) return text;
    }
    return std::nullopt;
}

int WsClient::close_code() {
    while (read()) {
    }
    return impl_->socket.reason().code;
}

void WsClient::cut() { beast::get_lowest_layer(impl_->socket).close(); }

}  // namespace pulseline::server::testing
