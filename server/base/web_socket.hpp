#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "server/base/byte_stream.hpp"

namespace pulseline::server {

/// A request that asks to become a WebSocket, and what came behind it.
using Upgrade = http::request<http::string_body>;

/// A WebSocket over a ByteStream. Beast's own type costs each source that names it half a minute;
/// it is compiled behind this one, once. At most one read, one write and one ping at a time.
class WebSocket {
public:
    struct Settings {
        std::size_t most_bytes = 0;                  // of a message that comes in
        std::chrono::steady_clock::duration idle{};  // without a byte until the link counts as dead
        bool pings = false;                          // sends pings of its own at half of `idle`
        std::chrono::steady_clock::duration opening = std::chrono::seconds(10);
    };
    using Headers = std::map<std::string, std::string>;
    enum class Control { kPing, kPong, kClose };

    WebSocket(ByteStream stream, const Settings& settings);
    ~WebSocket();

    /// The server's side: answers with `headers` beside what the protocol asks for.
    net::awaitable<error_code> accept(const Upgrade& upgrade, const Headers& headers);

    struct Opened {
        error_code ec;
        unsigned status = 0;      // of an answer that is no WebSocket's
        std::string body;         // its beginning
        std::string subprotocol;  // that the server took
    };
    /// The client's side.
    net::awaitable<Opened> open(const std::string& host, const std::string& path,
                                const Headers& headers);

    /// Reads a whole message, which is there until the next one is asked for.
    net::awaitable<error_code> read();
    std::string_view message() const;
    bool message_is_text() const;
    /// Gives the message's memory back: between two messages a silent link needs none.
    void drop_message();

    net::awaitable<error_code> write(std::string_view message, bool is_text = true);
    /// A piece of a text message.
    net::awaitable<error_code> write_piece(std::string_view piece, bool is_last);
    net::awaitable<error_code> ping(const char* mark = "");
    /// Called when a ping, a pong or a close comes in while read() waits.
    void on_control(std::function<void(Control, std::string_view payload)> call);

    /// Says goodbye; ends with the other side's answer or with cancel().
    net::awaitable<error_code> close(std::uint16_t code, const char* reason);
    /// Why the other side closed.
    std::uint16_t close_code() const;
    std::string close_reason() const;

    ByteStream& stream();
    /// All that waits ends with an error.
    void cancel() { stream().lowest().cancel(); }
    void close_now() { stream().lowest().close(); }

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace pulseline::server
