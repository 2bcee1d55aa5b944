#include "server/agent/machine_link.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

namespace pulseline::agent {
namespace {

using Steady = std::chrono::steady_clock;

constexpr std::size_t kReadAtOnce = std::size_t{64} * 1024;
constexpr std::string_view kScheme = "tcp://";

tl::unexpected<Error> line_lost(const std::string& what) {
    return fail(Errc::kConflict, "machine_lost", "The line to the machine broke: " + what + ".", {},
                {{"what", what}});
}

tl::unexpected<Error> not_reached(const MachineAddress& address, const std::string& what) {
    return fail(
        Errc::kNotFound, "machine_not_reached",
        "The machine at " + address.host + ":" + address.port + " is not reached: " + what + ".",
        {}, {{"what", what}});
}

/// Whether it can be read (or written) before the time is over.
bool ready(int socket, short events, MachineLink::Duration timeout) {
    pollfd asked{socket, events, 0};
    const timespec wait{
        static_cast<time_t>(timeout.count() / 1'000'000),
        static_cast<long>(std::max<std::int64_t>(0, timeout.count() % 1'000'000) * 1000)};
    return ::ppoll(&asked, 1, &wait, nullptr) > 0;
}

class Socket {
public:
    explicit Socket(int descriptor) : descriptor_(descriptor) {}
    Socket(Socket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    Socket& operator=(Socket&&) = delete;
    ~Socket() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    int get() const { return descriptor_; }

private:
    int descriptor_;
};

/// Connected, or why not.
Result<Socket> connect_to(const addrinfo& address, MachineLink::Duration timeout) {
    Socket socket(::socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (socket.get() < 0) return line_lost(std::strerror(errno));
    if (::connect(socket.get(), address.ai_addr, address.ai_addrlen) != 0) {
        if (errno != EINPROGRESS) return line_lost(std::strerror(errno));
        if (!ready(socket.get(), POLLOUT, timeout)) return line_lost("no answer");
        int error = 0;
        socklen_t size = sizeof error;
        ::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
        if (error != 0) return line_lost(std::strerror(error));
    }
    const int on = 1;  // a set point waits for no other
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    return socket;
}

}  // namespace

Result<MachineAddress> parse_machine(const std::string& url) {
    const auto colon = url.rfind(':');
    const bool whole = url.rfind(kScheme, 0) == 0 && colon > kScheme.size() &&
                       colon != std::string::npos && colon + 1 < url.size();
    if (!whole) {
        return fail(Errc::kInvalid, "bad_machine",
                    "machine \"" + url + "\" must be tcp://HOST:PORT");
    }
    return MachineAddress{url.substr(kScheme.size(), colon - kScheme.size()),
                          url.substr(colon + 1)};
}

struct MachineLink::Impl {
    Socket socket;
    std::string read = {};  // and not yet a whole frame
};

MachineLink::MachineLink(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MachineLink::MachineLink(MachineLink&&) noexcept = default;
MachineLink& MachineLink::operator=(MachineLink&&) noexcept = default;
MachineLink::~MachineLink() = default;

Result<MachineLink> MachineLink::open(const MachineAddress& address, Duration timeout) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (const int error =
            ::getaddrinfo(address.host.c_str(), address.port.c_str(), &wanted, &found)) {
        return not_reached(address, ::gai_strerror(error));
    }
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> all(found, &::freeaddrinfo);
    std::string why = "it has no address";
    for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
        auto socket = connect_to(*one, timeout);
        if (socket) return MachineLink(std::make_unique<Impl>(Impl{std::move(*socket)}));
        why = std::get<std::string>(socket.error().reason.params.front().value);
    }
    return not_reached(address, why);
}

Status MachineLink::send(const machine::Frame& frame) {
    const std::string bytes = machine::encode(frame);
    std::string_view left = bytes;
    while (!left.empty()) {
        const auto sent = ::send(impl_->socket.get(), left.data(), left.size(), MSG_NOSIGNAL);
        if (sent > 0) {
            left.remove_prefix(static_cast<std::size_t>(sent));
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            // A machine that takes nothing for so long has stopped reading.
            if (!ready(impl_->socket.get(), POLLOUT, std::chrono::milliseconds(100))) {
                return line_lost("it takes nothing");
            }
        } else if (errno != EINTR) {
            return line_lost(std::strerror(errno));
        }
    }
    return {};
}

Result<machine::Frame> MachineLink::receive(Duration timeout) {
    const auto until = Steady::now() + timeout;
    for (;;) {
        const auto size = machine::frame_size(impl_->read);
        if (!size) return fail(size.error());
        if (*size && impl_->read.size() >= **size) {
            auto frame = machine::decode(std::string_view(impl_->read).substr(0, **size));
            impl_->read.erase(0, **size);
            return frame;
        }
        // What came while this program was not let run has come in time.
        const auto left =
            std::max(Duration{}, std::chrono::duration_cast<Duration>(until - Steady::now()));
        if (!ready(impl_->socket.get(), POLLIN, left)) {
            return fail(Errc::kConflict, "machine_silent", "The machine does not answer.");
        }
        const auto before = impl_->read.size();
        impl_->read.resize(before + kReadAtOnce);
        const auto got = ::recv(impl_->socket.get(), impl_->read.data() + before, kReadAtOnce, 0);
        impl_->read.resize(before + static_cast<std::size_t>(std::max<ssize_t>(0, got)));
        if (got == 0) return line_lost("it has closed");
        if (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
            return line_lost(std::strerror(errno));
        }
    }
}

}  // namespace pulseline::agent
