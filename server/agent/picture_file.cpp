#include "server/agent/picture_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "api/localization/image_bytes.hpp"

namespace pulseline::agent {
namespace {

using namespace std::chrono_literals;
using Clock = PictureSource::Clock;

// A file system's dates go by the kernel's tick, 4 ms mostly, and a camera's program needs a few
// to bring a picture there unless it dates it itself.
constexpr double kDateSigma_s = 5e-3;
// Of a date behind now: more than a tick is another clock, by which nobody knows what is new.
constexpr auto kAhead = 20ms;

class OpenFile {
public:
    // One that is no file, a pipe say, must not be waited for.
    explicit OpenFile(const std::string& path)
        : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    bool is_open() const { return descriptor_ >= 0; }
    struct stat status() const {
        struct stat told {};
        ::fstat(descriptor_, &told);
        return told;
    }
    /// As many bytes as it has, at most.
    std::string read(std::size_t size) const {
        std::string bytes(size, '\0');
        std::size_t got = 0;
        while (got < size) {
            const auto more = ::read(descriptor_, bytes.data() + got, size - got);
            if (more < 0 && errno == EINTR) continue;
            if (more <= 0) break;
            got += static_cast<std::size_t>(more);
        }
        bytes.resize(got);
        return bytes;
    }

private:
    int descriptor_;
};

bool same(const timespec& a, const timespec& b) {
    return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

/// Of a date by the wall clock, which alone a file has.
Clock::duration age_of(const timespec& date) {
    const auto then = std::chrono::seconds(date.tv_sec) + std::chrono::nanoseconds(date.tv_nsec);
    return std::chrono::system_clock::now().time_since_epoch() - then;
}

}  // namespace

Result<std::optional<PictureSource::Taken>> PictureFile::newest(Clock::time_point from) {
    const OpenFile file(path_);
    if (!file.is_open()) return camera_silent(camera_, path_ + ": " + std::strerror(errno));
    const auto status = file.status();
    if (!S_ISREG(status.st_mode)) return camera_silent(camera_, path_ + " is no file");
    const auto age = age_of(status.st_mtim);
    if (age < -kAhead) {
        return camera_silent(camera_, path_ + " is dated in the future; set the clocks alike");
    }
    const auto exposed = Clock::now() - std::max(age, Clock::duration::zero());
    if (exposed < from || same(status.st_mtim, given_)) return std::nullopt;
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size > api::localization::kMostImageBytes) {
        return bad_image(camera_, path_ + " is too large");
    }
    const std::string bytes = file.read(size);
    const auto read = file.status();
    if (read.st_size != status.st_size || !same(read.st_mtim, status.st_mtim)) {
        return bad_image(camera_, path_ +
                                      " changes while it is read; write it beside that name and "
                                      "rename it");
    }
    auto grey = api::localization::decode_grey(bytes, path_);
    if (!grey) return bad_image(camera_, grey.error().what);
    if (const auto sized = has_size(grey->size(), camera_); !sized) return fail(sized.error());
    given_ = status.st_mtim;
    return Taken{std::move(*grey), exposed, kDateSigma_s};
}

}  // namespace pulseline::agent
