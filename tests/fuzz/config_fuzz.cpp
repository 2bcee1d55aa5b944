// Any text as a configuration file.
#include <string>

#include "server/base/config_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    pulseline::server::Options options;
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    (void)pulseline::server::read_config("server.toml", bytes, {}, options);
    return 0;
}
