#include "tests/server/tcp_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>

namespace pulseline::server::testing {

TcpClient::TcpClient(std::uint16_t port, const char* from, int receive_buffer_bytes)
    : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (receive_buffer_bytes > 0) {
        setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes,
                   sizeof receive_buffer_bytes);
    }
    if (from) {
        sockaddr_in own{};
        own.sin_family = AF_INET;
        inet_pton(AF_INET, from, &own.sin_addr);
        if (bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) {
            throw std::runtime_error("cannot bind");
        }
    }
    const timeval limit{10, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
        throw std::runtime_error("cannot connect");
    }
}

TcpClient::~TcpClient() { ::close(socket_); }

void TcpClient::send(const std::string& bytes) {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
        const auto n = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (n <= 0) return;  // the server closed; the answer says why
        sent += static_cast<std::size_t>(n);
    }
}

std::size_t TcpClient::send_for(const std::string& bytes, double seconds) {
    const auto begin = std::chrono::steady_clock::now();
    std::size_t sent = 0;
    for (;;) {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
        if (passed.count() >= seconds) return sent;
        const std::size_t from = sent % bytes.size();
        const auto n =
            ::send(socket_, bytes.data() + from, bytes.size() - from, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (n > 0) {
            sent += static_cast<std::size_t>(n);
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            pollfd ready{socket_, POLLOUT, 0};
            ::poll(&ready, 1, 100);
        } else {
            return sent;
        }
    }
}

bool TcpClient::fill() {
    std::array<char, 16384> chunk{};
    const auto n = ::recv(socket_, chunk.data(), chunk.size(), 0);
    if (n <= 0) {
        // Giving up after 10 s is not an end.
        ended_ = n == 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
        return false;
    }
    buffer_.append(chunk.data(), static_cast<std::size_t>(n));
    return true;
}

std::string TcpClient::read_until(const std::string& end) {
    std::size_t at = std::string::npos;
    while ((at = buffer_.find(end)) == std::string::npos && fill()) {
    }
    const auto size = at == std::string::npos ? buffer_.size() : at + end.size();
    std::string text = buffer_.substr(0, size);
    buffer_.erase(0, size);
    return text;
}

HttpAnswer TcpClient::read_answer(bool head_only) {
    const std::string head = read_until("\r\n\r\n");
    HttpAnswer answer;
    if (head.size() < 12) return answer;
    answer.status = std::stoi(head.substr(9, 3));
    std::size_t line = head.find("\r\n") + 2;
    while (line < head.size()) {
        const auto end = head.find("\r\n", line);
        const auto colon = head.find(": ", line);
        if (end == line || colon == std::string::npos || colon > end) break;
        std::string name = head.substr(line, colon - line);
        std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
        answer.headers[name] = head.substr(colon + 2, end - colon - 2);
        line = end + 2;
    }
    if (head_only || answer.status == 204 || answer.status == 304) return answer;
    const auto length = answer.headers.find("content-length");
    if (length == answer.headers.end()) return answer;
    const auto size = static_cast<std::size_t>(std::stoul(length->second));
    while (buffer_.size() < size && fill()) {
    }
    answer.body = buffer_.substr(0, size);
    buffer_.erase(0, size);
    return answer;
}

bool TcpClient::at_end() {
    while (fill()) {
    }
    return ended_;
}

HttpAnswer request(std::uint16_t port, const std::string& method, const std::string& path,
                   const std::map<std::string, std::string>& headers, const std::string& body,
                   const char* from) {
    TcpClient client(port, from);
    std::string text = method + " " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\n";
    for (const auto& [name, value] : headers) text += name + ": " + value + "\r\n";
    if (!body.empty()) text += "Content-Type: application/json\r\n";
    text += "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
    client.send(text);
    return client.read_answer(method == "HEAD");
}

}  // namespace pulseline::server::testing
