#include <gtest/gtest.h>

#include "tests/core/traffic/traffic_floor.hpp"

namespace pulseline::traffic {
namespace {

class Restart : public ::testing::Test {
protected:
    Restart() {
        a = hall.add("A", 0, 0);
        b = hall.add("B", 6, 0);
        c = hall.add("C", 3, 1);
        EXPECT_TRUE(hall.send(a, {{5, 0}, {1, 0}}));
        EXPECT_TRUE(hall.send(b, {{2, 0}}));
        EXPECT_TRUE(hall.send(c, {{4, 0}}));
        hall.traffic.extend(a, 2, at(0));
        EXPECT_TRUE(hall.traffic.passed(a, 1, at(6)));
        hall.traffic.close({Floor::tile(4, 0)}, at(7));
        hall.traffic.halt(c, at(8));
        hall.watch();
        hall.now_s = 10;
    }
    Hall hall{{"r.....r", "r  r   "}};
    VehicleIndex a = 0, b = 0, c = 0;
};

TEST_F(Restart, GivesTheSameStateAndTheSameFuture) {
    const auto record = hall.traffic.record();
    auto rebuilt = Traffic::rebuild(record, {hall.floor.graph});
    ASSERT_TRUE(rebuilt);
    EXPECT_EQ(rebuilt->record(), record);
    EXPECT_EQ(rebuilt->held_tiles(a), hall.traffic.held_tiles(a));

    for (Traffic* traffic : {&hall.traffic, &*rebuilt}) {
        traffic->resume(c, at(20));
        traffic->reopen(0, at(21));
        traffic->improve(at(30), 3);
        Task task;
        task.visits = {{hall.floor.place(1, 0), 5}};
        EXPECT_TRUE(traffic->admit(c, task, at(31)));
        for (const VehicleIndex v : {a, b, c}) traffic->extend(v, 3, at(32));
    }
    EXPECT_EQ(rebuilt->record(), hall.traffic.record());
}

TEST_F(Restart, ARecordWithTwoHoldersIsRefused) {
    auto record = hall.traffic.record();
    record.vehicles[b].stand = record.vehicles[a].stand;
    const auto rebuilt = Traffic::rebuild(record, {hall.floor.graph});
    ASSERT_FALSE(rebuilt);
    EXPECT_EQ(rebuilt.error().reason.code, "traffic_record_broken");
}

TEST_F(Restart, ARecordWithWrongCountersIsRefused) {
    auto record = hall.traffic.record();
    record.vehicles[a].released = record.vehicles[a].passed + 99;
    EXPECT_FALSE(Traffic::rebuild(record, {hall.floor.graph}));
    record = hall.traffic.record();
    record.vehicles[a].graph = 7;
    EXPECT_FALSE(Traffic::rebuild(record, {hall.floor.graph}));
}

TEST_F(Restart, ANewMonitorLearnsTheWholeState) {
    Monitor fresh;
    EXPECT_TRUE(fresh.apply(hall.traffic.all_as_changes()).empty());
    EXPECT_TRUE(fresh.check_all().empty());
    EXPECT_TRUE(fresh.check_footprint(a, {Floor::tile(1, 0), Floor::tile(2, 0)}).empty());
    EXPECT_FALSE(fresh.check_footprint(a, {Floor::tile(0, 0)}).empty());
}

}  // namespace
}  // namespace pulseline::traffic
