#include "server/base/keep_running.hpp"

#include <gtest/gtest.h>

#include <new>

namespace pulseline::server {
namespace {

TEST(KeepRunning, ALoopThatThrowsRunsAgainAndItsPauseIsSeen) {
    net::io_context io;
    int begun = 0;
    int pausing = 0;
    const auto loop = [&]() -> net::awaitable<void> {
        if (++begun < 3) throw std::bad_alloc();
        co_return;
    };
    bool over = false;
    net::co_spawn(io, keep_running("test", io, pausing, loop), [&](const std::exception_ptr& e) {
        EXPECT_FALSE(e);
        over = true;
    });

    while (io.poll_one() > 0) {
    }
    EXPECT_EQ(begun, 1);
    EXPECT_EQ(pausing, 1);
    io.run();

    EXPECT_TRUE(over);
    EXPECT_EQ(begun, 3);
    EXPECT_EQ(pausing, 0);
}

}  // namespace
}  // namespace pulseline::server
