#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/id.hpp"
#include "core/base/key.hpp"
#include "core/base/result.hpp"
#include "core/base/time.hpp"

/// The compact binary form of what the journal keeps. Little endian; integers as varints (signed
/// ones zigzag), doubles as their eight bytes, texts and lists behind their length, lists of
/// numbers as differences. Structs are the sequence of their members (fields.hpp). Bytes are read
/// by the same program version that wrote them; snapshot.hpp and entry.hpp say how others are told
/// apart.
namespace pulseline::fleet::journal {

/// What a byte string of ours may be wrong in; no byte makes the reader do anything but refuse.
tl::unexpected<Error> broken(const char* why);
/// FNV-1a in words of 64 bits, mixed: finds what disks and hands do to bytes, not what an enemy
/// does.
std::uint64_t checksum(std::string_view bytes);

/// The last enumerator, so that a reader can refuse numbers behind it.
template <class E>
struct Last;

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
concept MapLike = requires {
    typename T::mapped_type;
};
template <class T>
concept SetLike = requires {
    typename T::key_type;
}
&&!MapLike<T>;
/// Lists of whole numbers are mostly sorted.
template <class T>
concept NumberList =
    std::same_as<T, std::vector<std::uint64_t>> || std::same_as<T, std::vector<std::uint32_t>>;

class Writer {
public:
    void byte(std::uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
    void number(std::uint64_t value) {
        for (; value >= 0x80; value >>= 7) byte(static_cast<std::uint8_t>(value | 0x80));
        byte(static_cast<std::uint8_t>(value));
    }
    void difference(std::int64_t value) {
        number((static_cast<std::uint64_t>(value) << 1) ^
               static_cast<std::uint64_t>(value < 0 ? -1 : 0));
    }
    void fixed(std::uint64_t value, int size = 8) {
        char bytes[8];
        for (int i = 0; i < size; ++i) bytes[i] = static_cast<char>(value >> (8 * i));
        bytes_.append(bytes, static_cast<std::size_t>(size));
    }
    void reserve(std::size_t size) { bytes_.reserve(size); }
    void raw(std::string_view bytes) { bytes_.append(bytes); }

    /// As a visitor of fields(): writes all of them.
    template <class... T>
    void operator()(const T&... values) {
        (put(values), ...);
    }
    template <class T>
    void put(const T& value);

    const std::string& bytes() const { return bytes_; }
    std::size_t size() const { return bytes_.size(); }
    std::string take() { return std::exchange(bytes_, {}); }
    void clear() { bytes_.clear(); }

private:
    std::string bytes_;
};

/// Reads what Writer wrote. After the first fault every read gives zeros and ok() is false.
class Reader {
public:
    explicit Reader(std::string_view bytes) : left_(bytes) {}

    bool ok() const { return why_ == nullptr; }
    const char* why() const { return why_; }
    bool at_end() const { return left_.empty(); }
    std::size_t left() const { return left_.size(); }
    void refuse(const char* why) {
        if (!why_) why_ = why;
        left_ = {};
    }

    std::uint8_t byte() {
        if (left_.empty()) {
            refuse("the bytes end too soon");
            return 0;
        }
        const auto value = static_cast<std::uint8_t>(left_.front());
        left_.remove_prefix(1);
        return value;
    }
    std::uint64_t number() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            const std::uint8_t part = byte();
            if (shift == 63 && part > 1) break;
            value |= static_cast<std::uint64_t>(part & 0x7f) << shift;
            if (part < 0x80) return value;
        }
        refuse("a number is too long");
        return 0;
    }
    std::int64_t difference() {
        const std::uint64_t value = number();
        return static_cast<std::int64_t>((value >> 1) ^ (~(value & 1) + 1));
    }
    std::uint64_t fixed(int size = 8) {
        std::uint64_t value = 0;
        for (int i = 0; i < size; ++i) value |= static_cast<std::uint64_t>(byte()) << (8 * i);
        return value;
    }
    /// Every element takes a byte at least, so a length that lies cannot ask for memory.
    std::size_t length() {
        const std::uint64_t count = number();
        if (count <= left_.size()) return static_cast<std::size_t>(count);
        refuse("a length is larger than what is left");
        return 0;
    }
    std::string_view raw(std::size_t size) {
        if (size > left_.size()) {
            refuse("the bytes end too soon");
            return {};
        }
        const auto bytes = left_.substr(0, size);
        left_.remove_prefix(size);
        return bytes;
    }

    /// As a visitor of fields(): reads all of them.
    template <class... T>
    void operator()(T&... values) {
        (get(values), ...);
    }
    template <class T>
    void get(T& value);

private:
    template <class T>
    void get_number(T& value);

    std::string_view left_;
    const char* why_ = nullptr;
};

template <class Tag>
void write(Writer& out, const Key<Tag>& key) {
    out.put(key.str());
}
template <class Tag>
void read(Reader& in, Key<Tag>& key) {
    std::string text;
    in.get(text);
    key = Key<Tag>(std::move(text));
}
template <class Tag>
void write(Writer& out, const Id<Tag>& id) {
    out.byte(id.empty() ? 0 : 1);
    if (id.empty()) return;
    for (const std::uint8_t b : id.uuid().bytes) out.byte(b);
}
template <class Tag>
void read(Reader& in, Id<Tag>& id) {
    const std::uint8_t present = in.byte();
    if (present > 1) in.refuse("neither an id nor none");
    Uuid uuid;
    for (std::size_t i = 0; present == 1 && i < uuid.bytes.size(); ++i) uuid.bytes[i] = in.byte();
    id = Id<Tag>(uuid);
}
inline void write(Writer& out, Time time) { out.difference(to_ns(time)); }
inline void read(Reader& in, Time& time) { time = time_from_ns(in.difference()); }
inline void write(Writer& out, Duration duration) { out.difference(duration.count()); }
inline void read(Reader& in, Duration& duration) { duration = Duration(in.difference()); }
template <class A, class B>
void write(Writer& out, const std::pair<A, B>& pair) {
    out(pair.first, pair.second);
}
template <class A, class B>
void read(Reader& in, std::pair<A, B>& pair) {
    in(pair.first, pair.second);
}
template <class... T>
void write(Writer& out, const std::variant<T...>& value) {
    out.byte(static_cast<std::uint8_t>(value.index()));
    std::visit([&](const auto& held) { out.put(held); }, value);
}
template <class... T>
void read(Reader& in, std::variant<T...>& value) {
    const std::size_t index = in.byte();
    std::size_t at = 0;
    const bool known = ((at++ == index && (in.get(value.template emplace<T>()), true)) || ...);
    if (!known) in.refuse("an unknown alternative");
}

template <class T>
void Writer::put(const T& value) {
    if constexpr (std::same_as<T, bool>) {
        byte(value ? 1 : 0);
    } else if constexpr (std::is_enum_v<T>) {
        number(static_cast<std::uint64_t>(value));
    } else if constexpr (std::signed_integral<T>) {
        difference(value);
    } else if constexpr (std::unsigned_integral<T>) {
        number(value);
    } else if constexpr (std::same_as<T, double>) {
        fixed(std::bit_cast<std::uint64_t>(value));
    } else if constexpr (std::same_as<T, std::string>) {
        number(value.size());
        bytes_ += value;
    } else if constexpr (IsOptional<T>::value) {
        byte(value ? 1 : 0);
        if (value) put(*value);
    } else if constexpr (NumberList<T>) {
        number(value.size());
        std::uint64_t before = 0;
        for (const auto one : value) {
            difference(static_cast<std::int64_t>(one - before));
            before = one;
        }
    } else if constexpr (requires(Writer & out) { write(out, value); }) {
        write(*this, value);
    } else if constexpr (requires { value.begin(); }) {
        number(value.size());
        for (const auto& one : value) put(one);
    } else if constexpr (requires(Writer & out) { T::members(out, value); }) {
        T::members(*this, value);
    } else {
        fields(*this, value);
    }
}

template <class T>
void Reader::get_number(T& value) {
    if constexpr (std::signed_integral<T>) {
        const std::int64_t wide = difference();
        if (!std::in_range<T>(wide)) refuse("a number is too large");
        value = static_cast<T>(wide);
    } else {
        const std::uint64_t wide = number();
        if (!std::in_range<T>(wide)) refuse("a number is too large");
        value = static_cast<T>(wide);
    }
}

template <class T>
void Reader::get(T& value) {
    if constexpr (std::same_as<T, bool>) {
        const std::uint8_t one = byte();
        if (one > 1) refuse("neither true nor false");
        value = one == 1;
    } else if constexpr (std::is_enum_v<T>) {
        const std::uint64_t wide = number();
        if (wide > static_cast<std::uint64_t>(Last<T>::value)) refuse("an unknown enumerator");
        value = ok() ? static_cast<T>(wide) : T{};
    } else if constexpr (std::integral<T>) {
        get_number(value);
    } else if constexpr (std::same_as<T, double>) {
        value = std::bit_cast<double>(fixed());
    } else if constexpr (std::same_as<T, std::string>) {
        value = std::string(raw(length()));
    } else if constexpr (IsOptional<T>::value) {
        const std::uint8_t present = byte();
        if (present > 1) refuse("neither a value nor none");
        value.reset();
        // Not emplace(): clang takes a struct with defaults inside another struct for one that
        // cannot be made without arguments.
        if (present == 1) get(*(value = typename T::value_type{}));
    } else if constexpr (NumberList<T>) {
        value.resize(length());
        std::uint64_t before = 0;
        for (auto& one : value) {
            before += static_cast<std::uint64_t>(difference());
            if (!std::in_range<typename T::value_type>(before)) refuse("a number is too large");
            one = static_cast<typename T::value_type>(before);
        }
    } else if constexpr (requires(Reader & in) { read(in, value); }) {
        read(*this, value);
    } else if constexpr (MapLike<T>) {
        value.clear();
        for (std::size_t left = length(); left > 0 && ok(); --left) {
            typename T::key_type key{};
            get(key);
            if (!value.empty() && !(value.rbegin()->first < key)) refuse("keys out of order");
            get(value.emplace_hint(value.end(), std::move(key), typename T::mapped_type{})->second);
        }
    } else if constexpr (SetLike<T>) {
        value.clear();
        for (std::size_t left = length(); left > 0 && ok(); --left) {
            typename T::key_type key{};
            get(key);
            if (!value.empty() && !(*value.rbegin() < key)) refuse("keys out of order");
            value.emplace_hint(value.end(), std::move(key));
        }
    } else if constexpr (requires { value.emplace_back(); }) {
        value.clear();
        for (std::size_t left = length(); left > 0 && ok(); --left) get(value.emplace_back());
    } else if constexpr (requires(Reader & in) { T::members(in, value); }) {
        T::members(*this, value);
    } else {
        fields(*this, value);
    }
}

}  // namespace pulseline::fleet::journal
