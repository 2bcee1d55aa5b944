#include "tests/tools/load/peer.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace pulseline::load {
namespace {

constexpr std::uint8_t kText = 1;
constexpr std::uint8_t kPing = 9;
constexpr std::uint8_t kPong = 10;
constexpr std::uint8_t kClose = 8;

std::uint64_t big_endian(std::string_view bytes) {
    std::uint64_t value = 0;
    for (const char byte : bytes) value = value << 8 | static_cast<std::uint8_t>(byte);
    return value;
}

std::size_t content_length(std::string_view head) {
    for (const std::string_view name : {"Content-Length: ", "content-length: "}) {
        const auto at = head.find(name);
        if (at == std::string_view::npos) continue;
        std::size_t length = 0;
        std::from_chars(head.data() + at + name.size(), head.data() + head.size(), length);
        return length;
    }
    return 0;
}

}  // namespace

Peer::Peer(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (socket_ < 0) throw std::runtime_error(std::string("socket: ") + std::strerror(errno));
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) {
        const std::string why = std::strerror(errno);
        ::close(socket_);
        throw std::runtime_error("connect: " + why);
    }
    const int on = 1;
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    ::fcntl(socket_, F_SETFL, ::fcntl(socket_, F_GETFL) | O_NONBLOCK);
}

Peer::~Peer() { ::close(socket_); }

void Peer::ask_upgrade(const std::string& path, const std::string& headers) {
    upgrading_ = true;
    send_raw("GET " + path +
             " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
             "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\n" +
             headers + "\r\n");
}

void Peer::send_raw(std::string_view bytes) {
    out_ += bytes;
    flush();
}

void Peer::send_text(std::string_view text) { send_frame(kText, text); }

void Peer::send_frame(std::uint8_t opcode, std::string_view payload) {
    out_ += static_cast<char>(0x80 | opcode);
    if (payload.size() < 126) {
        out_ += static_cast<char>(0x80 | payload.size());
    } else if (payload.size() < 65536) {
        out_ += static_cast<char>(0x80 | 126);
        out_ += static_cast<char>(payload.size() >> 8);
        out_ += static_cast<char>(payload.size() & 255);
    } else {
        throw std::invalid_argument("a message of the load client is under 64 KB");
    }
    out_.append(4, '\0');  // the mask
    out_ += payload;
    flush();
}

void Peer::flush() {
    while (!out_.empty() && !ended_) {
        const auto sent = ::send(socket_, out_.data(), out_.size(), MSG_NOSIGNAL);
        if (sent > 0) {
            out_.erase(0, static_cast<std::size_t>(sent));
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            return;
        } else if (errno != EINTR) {
            ended_ = true;
        }
    }
}

void Peer::read(const Message& message, const std::function<void(const Answer&)>& answer) {
    std::array<char, 65536> bytes;
    for (;;) {
        const auto got = ::recv(socket_, bytes.data(), bytes.size(), 0);
        if (got > 0) {
            in_.append(bytes.data(), static_cast<std::size_t>(got));
            if (static_cast<std::size_t>(got) < bytes.size()) break;
        } else if (got < 0 && errno == EINTR) {
            continue;
        } else {
            ended_ = ended_ || got == 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
            break;
        }
    }
    while (open_ ? take_message(message) : take_answer(answer)) {
    }
    in_.erase(0, std::exchange(taken_, 0));
}

bool Peer::take_answer(const std::function<void(const Answer&)>& answer) {
    const std::string_view rest = std::string_view(in_).substr(taken_);
    const auto end = rest.find("\r\n\r\n");
    if (end == std::string_view::npos) return false;
    const std::string_view head = rest.substr(0, end);
    int status = 0;
    if (head.size() > 12) std::from_chars(head.data() + 9, head.data() + 12, status);
    const std::size_t length = status == 101 ? 0 : content_length(head);
    if (rest.size() < end + 4 + length) return false;
    taken_ += end + 4 + length;
    open_ = upgrading_ && status == 101;
    answer({status, rest.substr(end + 4, length)});
    return true;
}

bool Peer::take_message(const Message& message) {
    const std::string_view rest = std::string_view(in_).substr(taken_);
    if (rest.size() < 2) return false;
    const auto first = static_cast<std::uint8_t>(rest[0]);
    std::size_t length = static_cast<std::uint8_t>(rest[1]) & 127;
    std::size_t head = 2;
    if (length >= 126) {
        const std::size_t more = length == 126 ? 2 : 8;
        if (rest.size() < head + more) return false;
        length = big_endian(rest.substr(head, more));
        head += more;
    }
    if (rest.size() < head + length) return false;
    taken_ += head + length;
    const std::string_view payload = rest.substr(head, length);
    const std::uint8_t opcode = first & 15;
    if (opcode == kPing) {
        send_frame(kPong, payload);
    } else if (opcode == kClose) {
        ended_ = true;
    } else if (opcode <= 2) {
        const bool last = (first & 0x80) != 0;
        if (last && whole_.empty()) {
            message(payload);
        } else {
            whole_ += payload;
            if (last) message(std::exchange(whole_, {}));
        }
    }
    return true;
}

}  // namespace pulseline::load
