#include "api/json/parse.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "api/json/parse_quickly.hpp"

namespace pulseline::json {
namespace {

constexpr int kOutOfRange = 406;  // nlohmann's id of a number too large for a double
constexpr std::size_t kShownKey = 64;

struct Position {
    std::int64_t line = 1;
    std::int64_t column = 1;
};

Position position_of(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const std::size_t newline = before.rfind('\n');
    const std::size_t line_start = newline == std::string_view::npos ? 0 : newline + 1;
    return {1 + std::count(before.begin(), before.end(), '\n'),
            static_cast<std::int64_t>(std::max<std::size_t>(1, before.size() - line_start))};
}

tl::unexpected<Error> fail_at(std::string code, std::string_view text, std::size_t offset,
                              const std::string& what) {
    const Position at = position_of(text, offset);
    return fail(
        Errc::kInvalid, std::move(code),
        "Line " + std::to_string(at.line) + ", column " + std::to_string(at.column) + ": " + what,
        {}, {{"line", at.line}, {"column", at.column}});
}

/// Cut at a character boundary: the key may be anything an outsider sends.
std::string shortened(const std::string& key) {
    std::size_t size = std::min(key.size(), kShownKey);
    while (size > 0 && size < key.size() &&
           (static_cast<unsigned char>(key[size]) & 0xC0) == 0x80) {
        --size;
    }
    return key.substr(0, size);
}

/// Builds the value from SAX events and stops at the first breach of a limit.
class Builder : public nlohmann::json_sax<Json> {
public:
    explicit Builder(JsonLimits limits) : limits_(limits) {}

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t& text) override {
        // An integer beyond 64 bits would silently lose its last digits.
        const bool integer = text.find_first_of(".eE") == std::string::npos;
        if (!std::isfinite(value) || integer) {
            bad_number_ = true;
            return false;
        }
        return add(value);
    }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& value) override {
        const auto [member, is_new] = open_.back()->emplace(std::move(value), nullptr);
        if (!is_new) {
            const std::string key = shortened(member.key());
            error_ =
                Error{Errc::kInvalid,
                      {"json_duplicate_key", {{"key", key}}},
                      "The key \"" + key + "\" stands twice in one object; remove one of them.",
                      {}};
            return false;
        }
        member_ = &*member;
        return true;
    }
    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::json::exception& exception) override {
        failed_at_ = position;
        bad_number_ = exception.id == kOutOfRange;
        return false;
    }

    Result<Json> take(bool accepted, std::string_view text) {
        if (error_) return fail(*error_);
        if (accepted) return std::move(root_);
        if (bad_number_) {
            if (!failed_at_) {
                return fail(
                    Errc::kInvalid, "json_number",
                    "An integer does not fit into 64 bits; write it smaller or as a string.");
            }
            return fail_at("json_number", text, *failed_at_,
                           "a number is too large; write a finite one.");
        }
        return fail_at("json_syntax", text, failed_at_.value_or(text.size()),
                       "this is not valid JSON (RFC 8259) in UTF-8.");
    }

private:
    bool refuse(const char* code, std::int64_t limit, const std::string& what) {
        error_ = Error{Errc::kInvalid, {code, {{"limit", limit}}}, what, {}};
        return false;
    }

    Json* place(Json value) {
        if (++nodes_ > limits_.max_nodes) {
            refuse(
                "json_too_large", static_cast<std::int64_t>(limits_.max_nodes),
                "More than " + std::to_string(limits_.max_nodes) + " values; send less at once.");
            return nullptr;
        }
        if (open_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        Json& parent = *open_.back();
        if (parent.is_array()) {
            parent.push_back(std::move(value));
            return &parent.back();
        }
        *member_ = std::move(value);
        return member_;
    }
    bool add(Json value) { return place(std::move(value)) != nullptr; }
    bool open(Json container) {
        if (open_.size() >= static_cast<std::size_t>(limits_.max_depth)) {
            return refuse("json_too_deep", limits_.max_depth,
                          "Nested deeper than " + std::to_string(limits_.max_depth) +
                              " levels; send a flatter document.");
        }
        Json* placed = place(std::move(container));
        if (placed == nullptr) return false;
        open_.push_back(placed);  // stays valid: only the innermost container grows
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }

    JsonLimits limits_;
    Json root_;
    std::vector<Json*> open_;
    Json* member_ = nullptr;  // of the innermost object, whose value comes next
    std::size_t nodes_ = 0;
    bool bad_number_ = false;
    std::optional<std::size_t> failed_at_;
    std::optional<Error> error_;
};

}  // namespace

Result<Json> parse_json(std::string_view text, JsonLimits limits) {
    // nlohmann takes a NUL byte for the end of the text and would ignore what follows.
    const std::size_t nul = text.find('\0');
    if (nul != std::string_view::npos) {
        return fail_at("json_syntax", text, nul + 1, "a NUL byte is not valid JSON.");
    }
    if (auto value = parse_quickly(text, limits)) return *std::move(value);
    Builder builder(limits);  // tells what is wrong and where
    const bool accepted = Json::sax_parse(text.data(), text.data() + text.size(), &builder);
    return builder.take(accepted, text);
}

}  // namespace pulseline::json
