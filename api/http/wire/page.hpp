#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/wire/common_json.hpp"
#include "core/base/id.hpp"

/// Cursor pages: newest first, each page names the item it ended with, so inserts shift nothing.
namespace pulseline::api {

constexpr int kDefaultPage = 50;
constexpr int kLargestPage = 500;

/// Plain decimal digits within the range, nothing else.
std::optional<std::int64_t> parse_integer(std::string_view text, std::int64_t min,
                                          std::int64_t max);

std::string cursor_of(const Uuid& last);
std::optional<Uuid> uuid_of_cursor(std::string_view cursor);

/// `items` has up to limit + 1 of them: the one too many only says that there are more.
template <class Item, class ToJson>
Json page_json(std::vector<Item> items, int limit, const ToJson& to_json) {
    const auto most = static_cast<std::size_t>(limit);
    Json page = Json::object();
    if (items.size() > most) {
        items.resize(most);
        page["next_cursor"] = cursor_of(items.back().id.uuid());
    }
    page["items"] = list_json(items, to_json);
    return page;
}

}  // namespace pulseline::api
