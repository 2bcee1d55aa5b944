#include "api/machine/frames.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

namespace pulseline::machine {
namespace {

constexpr std::size_t kLength = 4;  // bytes of a frame's length
constexpr std::size_t kLongestText = 1024;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

tl::unexpected<Error> broken(const char* why) {
    return fail(Errc::kInvalid, "machine_frame_broken",
                std::string("A frame of the machine cannot be read: ") + why + ".", {},
                {{"why", why}});
}

/// Shows each member of a frame to a visitor, the same way for reading and writing.
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Hello::Axis>
void members(V& visit, F& f) {
    visit(f.name);
    visit(f.position_gain_per_s);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Hello>
void members(V& visit, F& f) {
    visit(f.version);
    if (f.version != kVersion) return visit.nothing_more();
    visit(f.cycle_s);
    visit(f.watchdog_s);
    visit(f.axes);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Description>
void members(V& visit, F& f) {
    visit(f.version);
    if (f.version != kVersion) return visit.nothing_more();
    visit(f.maker);
    visit(f.dead_cycles);
    visit(f.wheels);
    visit(f.brackets);
    visit(f.feet);
    visit(f.cameras);
    visit(f.scanners);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, SetPoints::Wheel>
void members(V& visit, F& f) {
    visit(f.speed_mps);
    visit(f.angle_rad);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, SetPoints>
void members(V& visit, F& f) {
    visit(f.cycle);
    visit(f.mode, Mode::kRoll);
    visit(f.wheels);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Feedback::Wheel>
void members(V& visit, F& f) {
    visit(f.speed_mps);
    visit(f.angle_rad);
    visit(f.steered_to_rad);
    visit(f.temperature_c);
    visit(f.fault);
    visit(f.lagging);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Feedback::Bracket>
void members(V& visit, F& f) {
    visit(f.height_m);
    visit(f.force_a_n);
    visit(f.force_b_n);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Feedback::Foot>
void members(V& visit, F& f) {
    visit(f.extension_m);
    visit(f.force_n);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Feedback>
void members(V& visit, F& f) {
    visit(f.cycle);
    visit(f.settled);
    visit(f.moving_lifts);
    visit(f.charging);
    visit(f.stopped);
    visit(f.slip_share);
    visit(f.battery_percent);
    visit(f.wheels);
    visit(f.brackets);
    visit(f.feet);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Lift>
void members(V& visit, F& f) {
    visit(f.id);
    visit(f.what, Lift::What::kStopCharging);
    visit(f.one);
    visit(f.height_m);
    visit(f.speed_mps);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, LiftEnded>
void members(V& visit, F& f) {
    visit(f.id);
    visit(f.outcome, LiftEnded::Outcome::kRefused);
    visit(f.why);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, StopLifts>
void members(V&, F&) {}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, SwitchOff>
void members(V& visit, F& f) { visit(f.wheel); }
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Expose>
void members(V& visit, F& f) {
    visit(f.id);
    visit(f.camera);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Picture>
void members(V& visit, F& f) {
    visit(f.id);
    visit(f.camera);
    visit(f.age_s);
    visit(f.width_px);
    visit(f.height_px);
    visit.bytes(f.grey, std::size_t{f.width_px} * f.height_px);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Refused>
void members(V& visit, F& f) { visit(f.why); }

template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Look>
void members(V& visit, F& f) { visit(f.id); }
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Scans::Scan>
void members(V& visit, F& f) {
    visit(f.first_rad);
    visit(f.step_rad);
    visit(f.blind);
    visit.ranges(f.ranges_m);
}
template <class V, class F>
requires std::same_as<std::remove_const_t<F>, Scans>
void members(V& visit, F& f) {
    visit(f.id);
    visit(f.scans);
}

class Writer {
public:
    explicit Writer(std::string& out) : out_(out) {}

    template <std::unsigned_integral T>
    requires(!std::same_as<T, bool>) void operator()(T number) {
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            out_.push_back(
                static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i) & 0xFFU));
        }
    }
    void operator()(bool flag) { (*this)(static_cast<std::uint8_t>(flag ? 1 : 0)); }
    void operator()(double number) { (*this)(std::bit_cast<std::uint64_t>(number)); }
    template <class E>
    void operator()(E value, E) {
        (*this)(static_cast<std::uint8_t>(value));
    }
    /// None is written as what is no number, or no part.
    void operator()(const std::optional<double>& number) { (*this)(number.value_or(kNone)); }
    void operator()(const std::optional<std::uint8_t>& part) {
        (*this)(part.value_or(std::uint8_t{0xFF}));
    }
    void operator()(const std::string& text) {
        assert(text.size() <= kLongestText);
        (*this)(static_cast<std::uint16_t>(text.size()));
        out_ += text;
    }
    template <class T>
    void operator()(const std::vector<T>& list) {
        assert(list.size() <= kMostParts);
        (*this)(static_cast<std::uint8_t>(list.size()));
        for (const T& one : list) {
            if constexpr (std::same_as<T, std::string>) {
                (*this)(one);
            } else {
                members(*this, one);
            }
        }
    }
    void nothing_more() {}
    void bytes(const std::string& bytes, std::size_t count) {
        assert(bytes.size() == count);
        out_ += bytes.substr(0, count);
    }
    void ranges(const std::vector<float>& ranges_m) {
        assert(ranges_m.size() <= kMostRays);
        (*this)(static_cast<std::uint16_t>(ranges_m.size()));
        for (const float range_m : ranges_m) (*this)(std::bit_cast<std::uint32_t>(range_m));
    }

private:
    std::string& out_;
};

class Reader {
public:
    explicit Reader(std::string_view bytes) : left_(bytes) {}
    const char* wrong() const { return wrong_; }
    bool at_end() const { return left_.empty(); }

    template <std::unsigned_integral T>
    requires(!std::same_as<T, bool>) void operator()(T& number) {
        std::uint64_t value = 0;
        const auto bytes = take(sizeof(T));
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            value |= std::uint64_t{static_cast<std::uint8_t>(bytes[i])} << (8 * i);
        }
        number = static_cast<T>(value);
    }
    void operator()(bool& flag) {
        std::uint8_t byte = 0;
        (*this)(byte);
        if (byte > 1) refuse("a flag that is neither set nor not");
        flag = byte == 1;
    }
    void operator()(double& number) {
        number = raw_double();
        if (!std::isfinite(number)) refuse("a number that is none");
    }
    template <class E>
    void operator()(E& value, E last) {
        std::uint8_t byte = 0;
        (*this)(byte);
        if (byte > static_cast<std::uint8_t>(last)) refuse("an unknown kind");
        value = static_cast<E>(byte);
    }
    void operator()(std::optional<double>& number) {
        const double read = raw_double();
        number.reset();
        if (std::isnan(read)) return;
        if (!std::isfinite(read)) refuse("a number that is none");
        number = read;
    }
    void operator()(std::optional<std::uint8_t>& part) {
        std::uint8_t byte = 0;
        (*this)(byte);
        part.reset();
        if (byte != 0xFF) part = byte;
    }
    void operator()(std::string& text) {
        std::uint16_t size = 0;
        (*this)(size);
        if (size > kLongestText) return refuse("a text that is too long");
        text = take(size);
    }
    template <class T>
    void operator()(std::vector<T>& list) {
        std::uint8_t count = 0;
        (*this)(count);
        if (count > kMostParts) return refuse("too many parts");
        list.assign(count, T{});
        for (T& one : list) {
            if (wrong_ != nullptr) return;
            if constexpr (std::same_as<T, std::string>) {
                (*this)(one);
            } else {
                members(*this, one);
            }
        }
    }
    void bytes(std::string& bytes, std::size_t count) { bytes = take(count); }
    /// Of another version, which has other members behind its number.
    void nothing_more() { left_ = {}; }
    void ranges(std::vector<float>& ranges_m) {
        std::uint16_t count = 0;
        (*this)(count);
        if (count > kMostRays) return refuse("too many rays");
        ranges_m.assign(count, 0.0F);
        for (float& range_m : ranges_m) {
            std::uint32_t bits = 0;
            (*this)(bits);
            range_m = std::bit_cast<float>(bits);
            if (!std::isfinite(range_m) || range_m < 0) return refuse("a range that is none");
        }
    }

private:
    void refuse(const char* why) {
        if (wrong_ == nullptr) wrong_ = why;
    }
    double raw_double() {
        std::uint64_t bits = 0;
        (*this)(bits);
        return std::bit_cast<double>(bits);
    }
    /// Nothing, and it is wrong, where fewer are left.
    std::string_view take(std::size_t count) {
        if (wrong_ == nullptr && left_.size() < count) refuse("it ends too soon");
        if (wrong_ != nullptr) return {};
        const auto taken = left_.substr(0, count);
        left_.remove_prefix(count);
        return taken;
    }

    std::string_view left_;
    const char* wrong_ = nullptr;
};

template <std::size_t I = 0>
Result<Frame> read_as(std::size_t type, Reader& in) {
    if constexpr (I < std::variant_size_v<Frame>) {
        if (type != I) return read_as<I + 1>(type, in);
        std::variant_alternative_t<I, Frame> frame;
        members(in, frame);
        if (in.wrong() != nullptr) return broken(in.wrong());
        if (!in.at_end()) return broken("more follows than it has members");
        return Frame(std::move(frame));
    } else {
        return broken("an unknown type");
    }
}

}  // namespace

std::string encode(const Frame& frame) {
    std::string out(kLength, '\0');
    Writer write(out);
    write(static_cast<std::uint8_t>(frame.index()));
    std::visit([&](const auto& one) { members(write, one); }, frame);
    assert(out.size() - kLength <= kLargestFrame);
    std::string length;
    Writer write_length(length);
    write_length(static_cast<std::uint32_t>(out.size() - kLength));
    return out.replace(0, kLength, length);
}

Result<std::optional<std::size_t>> frame_size(std::string_view bytes) {
    if (bytes.size() < kLength) return std::nullopt;
    std::uint32_t length = 0;
    Reader(bytes.substr(0, kLength))(length);
    if (length > kLargestFrame) {
        return fail(Errc::kInvalid, "machine_frame_too_long",
                    "A frame of the machine is longer than any can be.", {},
                    {{"bytes", std::int64_t{length}}});
    }
    return std::optional<std::size_t>(kLength + length);
}

Result<Frame> decode(std::string_view frame) {
    const auto size = frame_size(frame);
    if (!size) return fail(size.error());
    if (!*size || **size != frame.size()) return broken("it is not of its length");
    Reader in(frame.substr(kLength));
    std::uint8_t type = 0;
    in(type);
    if (in.wrong() != nullptr) return broken(in.wrong());
    return read_as(type, in);
}

}  // namespace pulseline::machine
