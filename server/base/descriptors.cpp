#include "server/base/descriptors.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

namespace pulseline::server {
namespace {

int open_spare() { return ::open("/dev/null", O_RDONLY | O_CLOEXEC); }

}  // namespace

std::size_t raise_descriptor_limit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return 0;
    const auto before = limit.rlim_cur;
    limit.rlim_cur = limit.rlim_max;
    if (setrlimit(RLIMIT_NOFILE, &limit) != 0) return static_cast<std::size_t>(before);
    return static_cast<std::size_t>(limit.rlim_cur);
}

SpareDescriptor::SpareDescriptor() : file_(open_spare()) {}

SpareDescriptor::~SpareDescriptor() {
    if (file_ >= 0) ::close(file_);
}

int SpareDescriptor::refuse_waiting(tcp::acceptor& acceptor, int most) {
    int refused = 0;
    // The acceptor may block when no connection waits: it is asked in between.
    error_code ec;
    acceptor.native_non_blocking(true, ec);
    while (refused < most && file_ >= 0) {
        ::close(file_);
        file_ = -1;
        const int taken =
            ::accept4(acceptor.native_handle(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
        if (taken >= 0) {
            ::close(taken);
            ++refused;
        }
        file_ = open_spare();
        if (taken < 0) break;
    }
    if (file_ < 0) file_ = open_spare();
    return refused;
}

}  // namespace pulseline::server
