#pragma once

#include <compare>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace pulseline {

/// Identifier of a plant element as the plant file writes it ("st01", "tp-01"). The tag keeps a
/// station's key from passing for a vehicle's.
template <class Tag>
class Key {
public:
    Key() = default;
    explicit Key(std::string value) : value_(std::move(value)) {}

    const std::string& str() const { return value_; }
    bool empty() const { return value_.empty(); }
    friend auto operator<=>(const Key&, const Key&) = default;

private:
    std::string value_;
};

}  // namespace pulseline

template <class Tag>
struct std::hash<pulseline::Key<Tag>> {
    std::size_t operator()(const pulseline::Key<Tag>& key) const noexcept {
        return std::hash<std::string>{}(key.str());
    }
};
