#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace pulseline::server::testing {

struct HttpAnswer {
    int status = 0;                              // 0: the connection ended without an answer
    std::map<std::string, std::string> headers;  // names in lower case
    std::string body;
};

/// A plain socket that says exactly what a test tells it to. Reads give up after 10 s.
class TcpClient {
public:
    /// `from`: another address of the loopback; `receive_buffer_bytes` 0: the system's own.
    explicit TcpClient(std::uint16_t port, const char* from = nullptr,
                       int receive_buffer_bytes = 0);
    ~TcpClient();
    TcpClient(const TcpClient&) = delete;
    TcpClient& operator=(const TcpClient&) = delete;

    void send(const std::string& bytes);
    /// As many times as the other side takes it within that time; gives the number of bytes.
    std::size_t send_for(const std::string& bytes, double seconds);
    /// Up to and with `end`; what there is when the connection ends.
    std::string read_until(const std::string& end);
    HttpAnswer read_answer(bool head_only = false);
    /// Reads to the end; true when the other side closed, false when it keeps the connection.
    bool at_end();

private:
    bool fill();
    int socket_ = -1;
    std::string buffer_;
    bool ended_ = false;
};

/// One request on a connection of its own.
HttpAnswer request(std::uint16_t port, const std::string& method, const std::string& path,
                   const std::map<std::string, std::string>& headers = {},
                   const std::string& body = {}, const char* from = nullptr);

}  // namespace pulseline::server::testing
