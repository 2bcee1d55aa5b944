#include "api/json/parse_quickly.hpp"

#include <simdjson.h>

#include <string>

namespace pulseline::json {
namespace {

using simdjson::dom::element_type;

/// simdjson keeps buffers of the longest text's size for each thread.
constexpr std::size_t kLongest = 64 * 1024;

/// Copies what simdjson read; false at the first breach of a limit.
class Copy {
public:
    explicit Copy(JsonLimits limits) : limits_(limits) {}

    bool value(const simdjson::dom::element& from, Json& to, int depth) {
        if (++nodes_ > limits_.max_nodes) return false;
        switch (from.type()) {
            case element_type::OBJECT:
                return depth < limits_.max_depth && object(from, to, depth + 1);
            case element_type::ARRAY:
                return depth < limits_.max_depth && array(from, to, depth + 1);
            case element_type::STRING:
                to = std::string(std::string_view(from));
                return true;
            case element_type::INT64:
                // As nlohmann has it: what has no sign is unsigned.
                if (const std::int64_t number(from); number < 0) {
                    to = number;
                } else {
                    to = static_cast<std::uint64_t>(number);
                }
                return true;
            case element_type::UINT64:
                to = std::uint64_t(from);
                return true;
            case element_type::DOUBLE:
                to = double(from);
                return true;
            case element_type::BOOL:
                to = bool(from);
                return true;
            case element_type::NULL_VALUE:
                return true;
        }
        return false;
    }

private:
    bool object(const simdjson::dom::object& from, Json& to, int depth) {
        to = Json::object();
        auto& members = to.get_ref<Json::object_t&>();
        for (const auto& [key, value_of_key] : from) {
            const auto [member, is_new] = members.try_emplace(std::string(key));
            if (!is_new || !value(value_of_key, member->second, depth)) return false;
        }
        return true;
    }
    bool array(const simdjson::dom::array& from, Json& to, int depth) {
        to = Json::array();
        auto& items = to.get_ref<Json::array_t&>();
        for (const auto item : from) {
            if (!value(item, items.emplace_back(), depth)) return false;
        }
        return true;
    }

    JsonLimits limits_;
    std::size_t nodes_ = 0;
};

}  // namespace

std::optional<Json> parse_quickly(std::string_view text, JsonLimits limits) {
    if (text.size() > kLongest) return std::nullopt;
    thread_local simdjson::dom::parser parser(kLongest);
    simdjson::dom::element root;
    if (parser.parse(text.data(), text.size()).get(root) != simdjson::SUCCESS) return std::nullopt;
    Json value;
    if (!Copy(limits).value(root, value, 0)) return std::nullopt;
    return value;
}

}  // namespace pulseline::json
