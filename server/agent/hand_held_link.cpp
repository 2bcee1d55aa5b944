#include "server/agent/hand_held_link.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/read_until.hpp>
#include <utility>

#include "server/agent/hand_held.hpp"
#include "server/base/log.hpp"

namespace pulseline::agent {

using namespace server;
using Local = net::local::stream_protocol;

namespace {

constexpr std::size_t kMostLine = 4096;

}  // namespace

struct HandHeldLink::Impl {
    Impl(net::io_context& io, std::string p, std::vector<Vehicle*> v)
        : acceptor(io), control(io), path(std::move(p)), vehicles(std::move(v)) {}

    net::awaitable<void> serve() {
        std::string buffer;
        for (;;) {
            error_code ec;
            const std::size_t size = co_await net::async_read_until(
                control, net::dynamic_buffer(buffer, kMostLine), '\n', into(ec));
            if (ec) break;
            const std::string line = buffer.substr(0, size);
            buffer.erase(0, size);
            const std::string answer = answer_hand_held(vehicles, line);
            co_await net::async_write(control, net::buffer(answer), into(ec));
            if (ec) break;
        }
        error_code ignored;
        control.close(ignored);
    }

    Local::acceptor acceptor;
    Local::socket control;
    std::string path;
    std::vector<Vehicle*> vehicles;
};

HandHeldLink::HandHeldLink(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

HandHeldLink::~HandHeldLink() { ::unlink(impl_->path.c_str()); }

Result<std::unique_ptr<HandHeldLink>> HandHeldLink::open(net::io_context& io,
                                                         const std::string& path,
                                                         std::vector<Vehicle*> vehicles) {
    auto impl = std::make_unique<Impl>(io, path, std::move(vehicles));
    const auto refuse = [&](const std::string& why) {
        return fail(Errc::kInvalid, "socket_not_made",
                    "cannot make the socket --hand-held " + path + ": " + why, {},
                    {{"path", path}});
    };
    struct stat there {};
    if (::stat(path.c_str(), &there) == 0) {
        if (!S_ISSOCK(there.st_mode)) return refuse("another file is there");
        ::unlink(path.c_str());
    }
    if (path.size() >= sizeof(sockaddr_un::sun_path)) return refuse("the name is too long");
    error_code ec;
    impl->acceptor.open(Local(), ec);
    const mode_t before = ::umask(0177);
    if (!ec) impl->acceptor.bind(Local::endpoint(path), ec);
    ::umask(before);
    if (!ec) impl->acceptor.listen(1, ec);
    if (ec) return refuse(ec.message());
    return std::unique_ptr<HandHeldLink>(new HandHeldLink(std::move(impl)));
}

net::awaitable<void> HandHeldLink::run() {
    for (;;) {
        error_code ec;
        co_await impl_->acceptor.async_accept(impl_->control, into(ec));
        if (ec) co_return;
        server::log::info("hand_held.connected");
        co_await impl_->serve();
        server::log::info("hand_held.gone");
    }
}

void HandHeldLink::stop() {
    error_code ignored;
    impl_->acceptor.close(ignored);
    impl_->control.close(ignored);
}

}  // namespace pulseline::agent
