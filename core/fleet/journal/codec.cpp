#include "core/fleet/journal/codec.hpp"

namespace pulseline::fleet::journal {

tl::unexpected<Error> broken(const char* why) {
    return fail(Errc::kInvalid, "journal_broken",
                std::string("The stored journal cannot be read: ") + why + ".", {},
                {{"why", std::string(why)}});
}

std::uint64_t checksum(std::string_view bytes) {
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char c : bytes) {
        hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3ULL;
    }
    return hash;
}

}  // namespace pulseline::fleet::journal
