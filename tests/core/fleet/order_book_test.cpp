#include "core/fleet/order_book.hpp"

#include <gtest/gtest.h>

#include "core/base/id.hpp"

namespace pulseline::fleet {
namespace {

const plant::VehicleId kVehicle("V1");
const Time kStart = time_from_ns(1'800'000'000'000'000'000);

JobOrder order_of(std::int64_t ms, const std::string& client = {}) {
    static IdSource ids(1);
    JobOrder order;
    order.created = kStart + std::chrono::milliseconds(ms);
    order.id = JobOrderId(ids.next(order.created));
    order.client_order_id = client;
    return order;
}

void end(OrderBook& book, JobOrder& order, Time at) {
    order.state = JobState::kEnded;
    order.ended = at;
    book.close(order);
}

TEST(OrderBook, OpenOrdersAreOldestFirst) {
    OrderBook book;
    const JobOrder first = order_of(1);
    const JobOrder second = order_of(2);
    book.add(second);
    book.add(first);

    EXPECT_EQ(std::vector(book.open().begin(), book.open().end()),
              (std::vector{first.id, second.id}));
    EXPECT_EQ(book.newest_first(1).front().id, second.id);
}

TEST(OrderBook, AVehicleHasItsOpenOrderOnly) {
    OrderBook book;
    JobOrder& order = book.add(order_of(1));
    EXPECT_EQ(book.of(kVehicle), nullptr);

    book.assign(order, kVehicle);
    EXPECT_EQ(book.of(kVehicle), &order);

    end(book, order, kStart);
    EXPECT_EQ(book.of(kVehicle), nullptr);
    EXPECT_TRUE(book.open().empty());
    EXPECT_EQ(book.find(order.id), &order) << "an ended order is still known";
}

TEST(OrderBook, ARestoredOrderIsFoundByVehicleAndClientName) {
    JobOrder order = order_of(1, "mes-7");
    order.assigned_vehicle = kVehicle;
    OrderBook book;
    book.add(order);

    ASSERT_NE(book.of(kVehicle), nullptr);
    EXPECT_EQ(book.of(kVehicle)->id, order.id);
    ASSERT_NE(book.with_client_id("mes-7"), nullptr);
    EXPECT_EQ(book.with_client_id("mes-8"), nullptr);
}

TEST(OrderBook, ForgetsOnlyWhatEndedBefore) {
    OrderBook book;
    JobOrder& old = book.add(order_of(1, "old"));
    JobOrder& young = book.add(order_of(2, "young"));
    const auto open = book.add(order_of(3)).id;
    const auto old_id = old.id;
    end(book, old, kStart);
    end(book, young, kStart + std::chrono::seconds(10));

    book.forget_ended_before(kStart + std::chrono::seconds(10));

    EXPECT_EQ(book.find(old_id), nullptr);
    EXPECT_EQ(book.with_client_id("old"), nullptr);
    EXPECT_EQ(book.find(young.id), &young);
    EXPECT_NE(book.find(open), nullptr);
}

}  // namespace
}  // namespace pulseline::fleet
