#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace pulseline::load {

/// One non-blocking connection of a load client: HTTP answers and, after an upgrade, WebSocket
/// messages. It has its own few lines of WebSocket because a thousand vehicles at ten messages a
/// second have to cost the machine less than the server under test: the mask is zero, so that a
/// message is sent as it stands. Pings are answered. Text only; control frames are not split.
class Peer {
public:
    using Message = std::function<void(std::string_view)>;
    struct Answer {
        int status = 0;
        std::string_view body;
    };

    /// Connects to a port of this machine. Throws std::runtime_error when the socket cannot be
    /// made.
    explicit Peer(std::uint16_t port);
    ~Peer();
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;

    int socket() const { return socket_; }
    bool open() const { return open_; }    // the upgrade was accepted
    bool ended() const { return ended_; }  // by the other side, or broken
    bool writes_wait() const { return !out_.empty(); }

    void ask_upgrade(const std::string& path, const std::string& headers);
    void send_raw(std::string_view bytes);
    void send_text(std::string_view text);

    /// Reads what is there. `message` gets each text message, `answer` each HTTP answer; views are
    /// good during the call.
    void read(const Message& message, const std::function<void(const Answer&)>& answer);
    void flush();

private:
    void send_frame(std::uint8_t opcode, std::string_view payload);
    bool take_answer(const std::function<void(const Answer&)>& answer);
    bool take_message(const Message& message);

    int socket_ = -1;
    bool upgrading_ = false;
    bool open_ = false;
    bool ended_ = false;
    std::string in_;
    std::size_t taken_ = 0;  // of in_
    std::string out_;
    std::string whole_;  // parts of a split message
};

}  // namespace pulseline::load
