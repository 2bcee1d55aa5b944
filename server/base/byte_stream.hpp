#pragma once

#include <boost/container/static_vector.hpp>
#include <memory>

#include "server/base/net.hpp"

namespace pulseline::server {

/// A connection, plain or over TLS, as Asio and Beast take one. It is one type for both, so that
/// what is built on it is compiled once. Its operations end on the thread of its io_context.
class ByteStream {
public:
    using executor_type = net::any_io_executor;
    /// As beast::tcp_stream, and can be told how many bytes a second it takes.
    using Timed = beast::basic_stream<tcp, executor_type, beast::simple_rate_policy>;

    explicit ByteStream(tcp::socket socket);
    /// Speaks TLS once its handshake has ended well.
    ByteStream(tcp::socket socket, ssl::context& tls);
    ByteStream(ByteStream&&) noexcept;
    ByteStream& operator=(ByteStream&&) noexcept;
    ~ByteStream();

    executor_type get_executor();
    bool is_tls() const;
    /// The connection below TLS: deadlines, limits of speed, the socket's options.
    Timed& lowest();

    // With TLS only:
    /// The name that is asked for and, with `verify`, that the certificate must be of.
    void expect_host(const std::string& name, bool verify);
    net::awaitable<error_code> handshake(ssl::stream_base::handshake_type side);
    net::awaitable<void> say_goodbye();

    /// Asio's AsyncReadStream and AsyncWriteStream.
    template <class Buffers, class Token>
    auto async_read_some(const Buffers& buffers, Token&& token) {
        return net::async_initiate<Token, void(error_code, std::size_t)>(
            [](auto handler, Transport* transport, Parts<net::mutable_buffer> parts) {
                start_read(*transport, parts, Once<error_code, std::size_t>(std::move(handler)));
            },
            token, transport_.get(), parts_of<net::mutable_buffer>(buffers));
    }
    template <class Buffers, class Token>
    auto async_write_some(const Buffers& buffers, Token&& token) {
        return net::async_initiate<Token, void(error_code, std::size_t)>(
            [](auto handler, Transport* transport, Parts<net::const_buffer> parts) {
                start_write(*transport, parts, Once<error_code, std::size_t>(std::move(handler)));
            },
            token, transport_.get(), parts_of<net::const_buffer>(buffers));
    }

    /// Beast's ways to end a connection below a WebSocket.
    friend void beast_close_socket(ByteStream& stream) { stream.lowest().close(); }
    template <class Handler>
    friend void async_teardown(beast::role_type role, ByteStream& stream, Handler&& handler) {
        start_teardown(*stream.transport_, role, Once<error_code>(std::forward<Handler>(handler)));
    }

private:
    /// A handler of any type, to be called once.
    template <class... Arguments>
    class Once {
    public:
        template <class Handler>
        explicit Once(Handler handler) : held_(new Held<Handler>(std::move(handler))) {}
        void operator()(Arguments... arguments) { held_.release()->call(arguments...); }

    private:
        struct Base {
            virtual ~Base() = default;
            virtual void call(Arguments... arguments) = 0;
        };
        template <class Handler>
        struct Held : Base {
            explicit Held(Handler h) : handler(std::move(h)) {}
            void call(Arguments... arguments) override {
                // As Asio does: the memory is free before the handler starts the next operation.
                Handler mine(std::move(handler));
                delete this;
                mine(arguments...);
            }
            Handler handler;
        };
        std::unique_ptr<Base> held_;
    };

    /// What one operation moves at most; the caller comes again with the rest.
    template <class Buffer>
    using Parts = boost::container::static_vector<Buffer, 8>;
    template <class Buffer, class Buffers>
    static Parts<Buffer> parts_of(const Buffers& buffers) {
        Parts<Buffer> parts;
        const auto end = net::buffer_sequence_end(buffers);
        for (auto at = net::buffer_sequence_begin(buffers); at != end; ++at) {
            if (parts.size() == parts.capacity()) break;
            if (Buffer(*at).size() > 0) parts.push_back(Buffer(*at));
        }
        return parts;
    }

    struct Transport;
    template <class Stream>
    struct TransportOver;
    static void start_read(Transport&, const Parts<net::mutable_buffer>&,
                           Once<error_code, std::size_t>);
    static void start_write(Transport&, const Parts<net::const_buffer>&,
                            Once<error_code, std::size_t>);
    static void start_teardown(Transport&, beast::role_type, Once<error_code>);

    std::unique_ptr<Transport> transport_;
};

}  // namespace pulseline::server
