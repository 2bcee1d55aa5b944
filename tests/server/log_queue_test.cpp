#include "server/base/log_queue.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

namespace pulseline::server::log {
namespace {

TEST(LogQueue, NobodyWaitsForAReaderThatStallsAndItsLossIsTold) {
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    auto* queue = new LogQueue(pipe[1], 100'000);  // never destroyed, as the server's own

    // Ten times what pipe and queue hold: one that wrote here would hang for ever.
    for (int i = 0; i < 20'000; ++i)
        queue->push("line " + std::to_string(i) + std::string(80, '.') + "\n");
    EXPECT_GT(queue->dropped(), 10'000u);
    EXPECT_FALSE(queue->flush(std::chrono::milliseconds(50)));

    std::string text;
    std::array<char, 65536> some{};
    while (text.find("line 19999") == std::string::npos || text.back() != '\n') {
        const auto n = ::read(pipe[0], some.data(), some.size());
        ASSERT_GT(n, 0);
        text.append(some.data(), static_cast<std::size_t>(n));
    }
    EXPECT_TRUE(queue->flush(std::chrono::seconds(10)));
    // Told in one line or, where the writer was slow to fill the pipe, in several.
    const std::string told = "log_lines_dropped lines=";
    std::uint64_t lost = 0;
    for (auto at = text.find(told); at != std::string::npos; at = text.find(told, at + 1)) {
        lost += std::stoull(text.substr(at + told.size()));
    }
    EXPECT_EQ(lost, queue->dropped());
}

TEST(LogQueue, WritesInOrderAndWhole) {
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    auto* queue = new LogQueue(pipe[1]);

    queue->push("one\n");
    queue->push("two\n");
    ASSERT_TRUE(queue->flush(std::chrono::seconds(10)));

    std::array<char, 64> text{};
    EXPECT_EQ(::read(pipe[0], text.data(), text.size()), 8);
    EXPECT_STREQ(text.data(), "one\ntwo\n");
}

}  // namespace
}  // namespace pulseline::server::log
