#include "core/fleet/state/codec.hpp"

namespace pulseline::fleet::journal {

tl::unexpected<Error> broken(const char* why) {
    return fail(Errc::kInvalid, "journal_broken",
                std::string("The stored journal cannot be read: ") + why + ".", {},
                {{"why", std::string(why)}});
}

std::uint64_t checksum(std::string_view bytes) {
    std::uint64_t hash = 0xcbf29ce484222325ULL ^ bytes.size();
    const auto take = [&](std::uint64_t word) {
        hash = (hash ^ word) * 0x100000001b3ULL;
        hash ^= hash >> 29;
    };
    for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
        std::uint64_t word = 0;
        for (int i = 0; i < 8; ++i) {
            word |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(bytes[i])) << (8 * i);
        }
        take(word);
    }
    for (const char c : bytes) take(static_cast<std::uint8_t>(c));
    return hash;
}

}  // namespace pulseline::fleet::journal
