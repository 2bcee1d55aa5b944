#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/time.hpp"

namespace pulseline {

/// 128 bits of a UUID (RFC 9562), printed in lower case.
struct Uuid {
    std::array<std::uint8_t, 16> bytes{};
    friend auto operator<=>(const Uuid&, const Uuid&) = default;
};
std::string to_string(const Uuid& uuid);
std::optional<Uuid> parse_uuid(std::string_view text);

/// A UUID that will not pass for another kind's.
template <class Tag>
class Id {
public:
    Id() = default;
    explicit Id(Uuid uuid) : uuid_(uuid) {}
    static std::optional<Id> parse(std::string_view text) {
        const auto uuid = parse_uuid(text);
        return uuid ? std::optional<Id>(Id(*uuid)) : std::nullopt;
    }

    const Uuid& uuid() const { return uuid_; }
    std::string str() const { return to_string(uuid_); }
    bool empty() const { return uuid_ == Uuid{}; }
    friend auto operator<=>(const Id&, const Id&) = default;

private:
    Uuid uuid_;
};

/// Makes UUIDv7 (time-ordered) from the core's time and a seeded generator, so that a replay with
/// the same seed makes the same ids. Not for secrets.
class IdSource {
public:
    explicit IdSource(std::uint64_t seed) : state_(seed) {}
    Uuid next(Time now);

    /// Shows a visitor all members, for snapshots.
    template <class V, class Self>
    static void members(V& visit, Self& self) {
        auto& [state, last_ms, counter] = self;
        visit(state, last_ms, counter);
    }

private:
    std::uint64_t random();

    std::uint64_t state_;
    std::int64_t last_ms_ = 0;
    std::uint32_t counter_ = 0;
};

}  // namespace pulseline

template <class Tag>
struct std::hash<pulseline::Id<Tag>> {
    std::size_t operator()(const pulseline::Id<Tag>& id) const noexcept {
        const auto& b = id.uuid().bytes;
        return std::hash<std::string_view>{}({reinterpret_cast<const char*>(b.data()), b.size()});
    }
};
