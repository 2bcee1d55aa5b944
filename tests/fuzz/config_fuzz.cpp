// Any text as the server's configuration file.
#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "server/config_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace pulseline;
    const int file = memfd_create("config", 0);
    if (file < 0) return 0;
    if (write(file, data, size) == static_cast<ssize_t>(size)) {
        server::Options options;
        (void)server::read_config_file("/proc/self/fd/" + std::to_string(file), {}, options);
    }
    close(file);
    return 0;
}
