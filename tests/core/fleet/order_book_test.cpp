#include "core/fleet/state/order_book.hpp"

#include <gtest/gtest.h>

#include "core/base/id.hpp"
#include "core/fleet/state/fields.hpp"

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
    EXPECT_EQ(book.with_client_id("mes-7"), order.id);
    EXPECT_EQ(book.with_client_id("mes-8"), std::nullopt);
}

TEST(OrderBook, ForgetsOnlyWhatEndedBefore) {
    OrderBook book;
    JobOrder& old = book.add(order_of(1, "old"));
    JobOrder& young = book.add(order_of(2, "young"));
    const auto open = book.add(order_of(3)).id;
    const auto old_id = old.id;
    end(book, old, kStart);
    end(book, young, kStart + std::chrono::seconds(10));

    book.tidy(kStart + std::chrono::seconds(10));

    EXPECT_EQ(book.find(old_id), nullptr);
    EXPECT_EQ(book.with_client_id("old"), std::nullopt);
    EXPECT_EQ(book.find(young.id), &young);
    EXPECT_NE(book.find(open), nullptr);
}

std::string bytes_of(const JobOrder& order) {
    journal::Writer writer;
    writer.put(order);
    return writer.take();
}

/// Ends so many orders, a millisecond apart.
std::vector<JobOrderId> end_many(OrderBook& book, std::size_t count) {
    std::vector<JobOrderId> ids;
    for (std::size_t i = 0; i < count; ++i) {
        const auto ms = static_cast<std::int64_t>(i);
        JobOrder& order = book.add(order_of(ms, "mes-" + std::to_string(i)));
        ids.push_back(order.id);
        end(book, order, order.created);
        book.tidy(kStart);
    }
    return ids;
}

TEST(OrderBook, WhatEndedAWhileAgoIsPackedAndStaysKnown) {
    OrderBook book;
    JobOrder full = order_of(-1, "mes-full");
    full.wanted_vehicle = kVehicle;
    full.created_by = "a person with a long name, longer than a short string";
    full.due = kStart;
    full.after = {{order_of(-2).id, 7, JobState::kEnded}};
    full.steps.resize(3);
    full.steps[1].after = {{"lowerParking", {{"height_m", 0.25}}}};
    full.reason = {"cancelled_by_person", {{"actor", "op"}}};
    JobOrder& kept = book.add(full);
    end(book, kept, kStart + std::chrono::hours(1));
    const JobOrder ended = kept;
    end_many(book, OrderBook::kMostLoose);

    EXPECT_EQ(std::as_const(book).find(ended.id), nullptr) << "packed";
    EXPECT_TRUE(book.knows(ended.id));
    EXPECT_EQ(book.with_client_id("mes-full"), ended.id);
    ASSERT_TRUE(book.look_up(ended.id));
    EXPECT_EQ(bytes_of(*book.look_up(ended.id)), bytes_of(ended));

    JobOrder* found = book.find(ended.id);
    ASSERT_NE(found, nullptr);
    found->removed = true;
    end_many(book, OrderBook::kMostLoose);
    EXPECT_EQ(std::as_const(book).find(ended.id), nullptr) << "packed again";
    EXPECT_TRUE(book.look_up(ended.id)->removed) << "what was changed is not lost";
}

TEST(OrderBook, APackedOrderIsForgottenInTime) {
    OrderBook book;
    const auto ids = end_many(book, OrderBook::kMostLoose + 10);

    book.tidy(kStart + std::chrono::milliseconds(5));

    EXPECT_FALSE(book.knows(ids[4]));
    EXPECT_EQ(book.with_client_id("mes-4"), std::nullopt);
    EXPECT_TRUE(book.knows(ids[5]));
    EXPECT_EQ(book.with_client_id("mes-5"), ids[5]);
}

TEST(OrderBook, KnowsNoMoreThanSoManyEndedOnes) {
    OrderBook book;
    const auto ids = end_many(book, OrderBook::kMostEnded + 3);

    EXPECT_FALSE(book.knows(ids[2]));
    EXPECT_EQ(book.with_client_id("mes-2"), std::nullopt);
    EXPECT_TRUE(book.knows(ids[3]));
    EXPECT_EQ(book.newest_first(2).front().id, ids.back());
}

}  // namespace
}  // namespace pulseline::fleet
