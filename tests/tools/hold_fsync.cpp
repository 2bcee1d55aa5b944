// A disk that hangs, for the real server: preloaded, it holds every fsync for as long as the file
// named by PULSELINE_HOLD_FSYNC exists.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>

namespace {

void wait_while_held() {
    const char* file = std::getenv("PULSELINE_HOLD_FSYNC");
    while (file && ::access(file, F_OK) == 0) ::usleep(5000);
}

template <class F>
F real(const char* name) {
    return reinterpret_cast<F>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int fsync(int descriptor) {
    wait_while_held();
    static const auto call = real<int (*)(int)>("fsync");
    return call(descriptor);
}

int fdatasync(int descriptor) {
    wait_while_held();
    static const auto call = real<int (*)(int)>("fdatasync");
    return call(descriptor);
}
}
