#include "server/runtime/published.hpp"

#include <gtest/gtest.h>

namespace pulseline::server {
namespace {

std::vector<std::size_t> sizes(const fleet::Records& records) {
    return std::apply([](const auto&... lists) { return std::vector{lists.size()...}; },
                      fleet::lists_of(records));
}

/// While the store is busy, what comes meanwhile is stored together: all of it, of whatever kind.
TEST(Published, NothingIsLeftOutOfWhatIsStoredTogether) {
    fleet::Records one;
    EXPECT_TRUE(one.empty());
    std::apply([](auto&... lists) { (lists.emplace_back(), ...); }, fleet::lists_of(one));
    EXPECT_FALSE(one.empty());
    fleet::Records merged;
    append(merged, one);
    EXPECT_EQ(sizes(merged), std::vector<std::size_t>(sizes(one).size(), 1));
    append(merged, one);
    EXPECT_EQ(sizes(merged), std::vector<std::size_t>(sizes(one).size(), 2));
}

/// Of each kind alone, too, there is something to store.
TEST(Published, OneOfAnyKindIsSomethingToStore) {
    const auto count = sizes(fleet::Records{}).size();
    for (std::size_t i = 0; i < count; ++i) {
        fleet::Records records;
        std::size_t at = 0;
        std::apply(
            [&](auto&... lists) { ((at++ == i ? void(lists.emplace_back()) : void()), ...); },
            fleet::lists_of(records));
        EXPECT_FALSE(records.empty()) << "list " << i;
    }
}

}  // namespace
}  // namespace pulseline::server
