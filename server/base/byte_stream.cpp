#include "server/base/byte_stream.hpp"

#include <openssl/ssl.h>

#include <boost/asio/ssl/host_name_verification.hpp>

namespace pulseline::server {

struct ByteStream::Transport {
    virtual ~Transport() = default;
    virtual Timed& lowest() = 0;
    virtual bool is_tls() const = 0;
    virtual void expect_host(const std::string& name, bool verify) = 0;
    virtual void read(const Parts<net::mutable_buffer>&, Once<error_code, std::size_t>) = 0;
    virtual void write(const Parts<net::const_buffer>&, Once<error_code, std::size_t>) = 0;
    virtual void teardown(beast::role_type, Once<error_code>) = 0;
    virtual net::awaitable<error_code> handshake(ssl::stream_base::handshake_type) = 0;
    virtual net::awaitable<void> say_goodbye() = 0;
};

template <class Stream>
struct ByteStream::TransportOver : Transport {
    template <class... Arguments>
    explicit TransportOver(Arguments&&... arguments)
        : stream(std::forward<Arguments>(arguments)...) {}

    static constexpr bool kTls = !std::is_same_v<Stream, Timed>;

    Timed& lowest() override { return beast::get_lowest_layer(stream); }
    bool is_tls() const override { return kTls; }
    void expect_host(const std::string& name, bool verify) override {
        if constexpr (kTls) {
            SSL_set_tlsext_host_name(stream.native_handle(), name.c_str());
            if (verify) stream.set_verify_callback(ssl::host_name_verification(name));
        }
    }
    void read(const Parts<net::mutable_buffer>& parts,
              Once<error_code, std::size_t> done) override {
        stream.async_read_some(parts, std::move(done));
    }
    void write(const Parts<net::const_buffer>& parts, Once<error_code, std::size_t> done) override {
        stream.async_write_some(parts, std::move(done));
    }
    void teardown(beast::role_type role, Once<error_code> done) override {
        using websocket::async_teardown;
        async_teardown(role, stream, std::move(done));
    }
    net::awaitable<error_code> handshake(ssl::stream_base::handshake_type side) override {
        error_code ec;
        if constexpr (kTls) co_await stream.async_handshake(side, into(ec));
        co_return ec;
    }
    net::awaitable<void> say_goodbye() override {
        error_code ignored;
        if constexpr (kTls) co_await stream.async_shutdown(into(ignored));
        co_return;
    }

    Stream stream;
};

ByteStream::ByteStream(tcp::socket socket)
    : transport_(std::make_unique<TransportOver<Timed>>(std::move(socket))) {}

ByteStream::ByteStream(tcp::socket socket, ssl::context& tls)
    : transport_(std::make_unique<TransportOver<beast::ssl_stream<Timed>>>(Timed(std::move(socket)),
                                                                           tls)) {}

ByteStream::ByteStream(ByteStream&&) noexcept = default;
ByteStream& ByteStream::operator=(ByteStream&&) noexcept = default;
ByteStream::~ByteStream() = default;

ByteStream::executor_type ByteStream::get_executor() { return transport_->lowest().get_executor(); }
bool ByteStream::is_tls() const { return transport_->is_tls(); }
ByteStream::Timed& ByteStream::lowest() { return transport_->lowest(); }
void ByteStream::expect_host(const std::string& name, bool verify) {
    transport_->expect_host(name, verify);
}

net::awaitable<error_code> ByteStream::handshake(ssl::stream_base::handshake_type side) {
    return transport_->handshake(side);
}
net::awaitable<void> ByteStream::say_goodbye() { return transport_->say_goodbye(); }

void ByteStream::start_read(Transport& transport, const Parts<net::mutable_buffer>& parts,
                            Once<error_code, std::size_t> done) {
    transport.read(parts, std::move(done));
}
void ByteStream::start_write(Transport& transport, const Parts<net::const_buffer>& parts,
                             Once<error_code, std::size_t> done) {
    transport.write(parts, std::move(done));
}
void ByteStream::start_teardown(Transport& transport, beast::role_type role,
                                Once<error_code> done) {
    transport.teardown(role, std::move(done));
}

}  // namespace pulseline::server
