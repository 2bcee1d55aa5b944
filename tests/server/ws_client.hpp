#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace pulseline::server::testing {

/// A WebSocket client for tests; reads give up after 10 s.
class WsClient {
public:
    /// Connects; status() says how the server answered the upgrade.
    WsClient(std::uint16_t port, const std::string& path,
             const std::map<std::string, std::string>& headers);
    ~WsClient();

    int status() const;  // 101: open
    std::string problem() const;
    void send(const std::string& text);
    void send_binary(const std::string& bytes);
    /// Next message, of a stream's frame of several changes each one; nothing when the socket
    /// ended.
    std::optional<std::string> read();
    /// Reads on to a message that holds `part`.
    std::optional<std::string> read_until(const std::string& part);
    /// Reads to the end; the close code, 0 when there was none.
    int close_code();
    /// Ends the TCP connection without a word.
    void cut();

private:
    std::optional<std::string> read_message();

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace pulseline::server::testing
