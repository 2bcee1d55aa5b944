#include "server/stream/stream_hub.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "server/base/camera_store.hpp"
#include "tests/server/test_server.hpp"

namespace pulseline::server::testing {
namespace {

struct StreamHubTest : ::testing::Test {
    struct StillClock : Clock {
        Time now() const override { return time_from_ns(1'800'000'000'000'000'000); }
    };
    plant::Plant plant = small_plant();
    CameraStore images;
    StillClock clock;
    Metrics metrics;
    StreamHub hub{plant, images, clock, metrics};
    std::vector<std::function<void(Result<events::Snapshot>)>> asked;
    std::vector<std::pair<std::function<std::string()>, std::function<void(Frame)>>> writing;
    std::vector<StreamClient> clients{40};
    int woken = 0;

    void SetUp() override {
        hub.connect({[this](auto done) { asked.push_back(std::move(done)); },
                     [this](auto write, auto done) {
                         writing.emplace_back(std::move(write), std::move(done));
                     }});
        for (auto& client : clients) {
            client.wake = [this] { ++woken; };
            hub.add(client);
        }
    }
    void TearDown() override {
        for (auto& client : clients) hub.remove(client);
    }
    void give_everybody_a_turn() {
        for (unsigned i = 0; i < StreamHub::kBeats; ++i) hub.beat();
    }
    /// The first has its snapshot and nothing else to write.
    void show_the_first() {
        hub.subscribe(clients[0]);
        asked[0](events::Snapshot{});
        write_next();
        ASSERT_NE(hub.next(clients[0])->find("\"snapshot\""), std::string::npos);
        woken = 0;
    }
    void write_next() {
        auto [write, done] = std::move(writing.back());
        writing.pop_back();
        done(std::make_shared<const std::string>(write()));
    }
};

TEST_F(StreamHubTest, FortyDashboardsAtOnceShareOneSnapshotWrittenElsewhere) {
    for (auto& client : clients) hub.subscribe(client);

    ASSERT_EQ(asked.size(), 1u);
    asked[0](events::Snapshot{});
    ASSERT_EQ(writing.size(), 1u);
    EXPECT_EQ(hub.next(clients[0]), nullptr);  // nobody writes it here
    write_next();

    const Frame frame = hub.next(clients[0]);
    ASSERT_TRUE(frame);
    for (std::size_t i = 1; i < clients.size(); ++i) EXPECT_EQ(hub.next(clients[i]), frame);
    EXPECT_EQ(asked.size(), 1u);
}

TEST_F(StreamHubTest, WhatChangesWhileItIsWrittenComesBehindIt) {
    hub.subscribe(clients[0]);
    asked[0](events::Snapshot{});
    Published batch;
    batch.fleet = fleet::FleetView{};
    hub.publish(batch);
    EXPECT_EQ(hub.next(clients[0]), nullptr);

    write_next();

    EXPECT_NE(hub.next(clients[0])->find("\"snapshot\""), std::string::npos);
    EXPECT_NE(hub.next(clients[0])->find("\"fleet\""), std::string::npos);
    EXPECT_EQ(hub.next(clients[0]), nullptr);
}

TEST_F(StreamHubTest, ChangesWaitForTheClientsTurnAndThoseAfterItForTheNext) {
    show_the_first();
    Published batch;
    batch.fleet = fleet::FleetView{};

    hub.publish(batch);
    EXPECT_EQ(hub.next(clients[0]), nullptr);
    EXPECT_EQ(woken, 0);
    give_everybody_a_turn();
    EXPECT_EQ(woken, 1);
    hub.publish(batch);

    EXPECT_TRUE(hub.next(clients[0]));
    EXPECT_EQ(hub.next(clients[0]), nullptr);
    give_everybody_a_turn();
    EXPECT_TRUE(hub.next(clients[0]));
    EXPECT_EQ(hub.next(clients[0]), nullptr);
    give_everybody_a_turn();
    EXPECT_EQ(woken, 2);  // nothing to write
}

TEST_F(StreamHubTest, TheTurnsAreOfEqualSize) {
    for (auto& client : clients) hub.subscribe(client);
    asked[0](events::Snapshot{});
    write_next();
    for (auto& client : clients) EXPECT_TRUE(hub.next(client));
    Published batch;
    batch.fleet = fleet::FleetView{};
    hub.publish(batch);

    for (unsigned i = 0; i < StreamHub::kBeats; ++i) {
        woken = 0;
        hub.beat();
        EXPECT_EQ(woken, 40 / static_cast<int>(StreamHub::kBeats));
    }
}

TEST_F(StreamHubTest, MuchAtOnceIsWrittenAtOnce) {
    show_the_first();
    Published batch;
    batch.fleet = fleet::FleetView{};

    for (std::size_t i = 1; i < StreamClient::kMaxFrames / 2; ++i) hub.publish(batch);
    EXPECT_EQ(woken, 0);
    hub.publish(batch);

    EXPECT_EQ(woken, 1);
    EXPECT_TRUE(hub.next(clients[0]));
}

TEST_F(StreamHubTest, WhoComesMeanwhileSharesTheNextOne) {
    hub.subscribe(clients[0]);
    asked[0](events::Snapshot{});
    hub.subscribe(clients[1]);
    hub.subscribe(clients[2]);
    EXPECT_EQ(asked.size(), 1u);

    write_next();

    ASSERT_EQ(asked.size(), 2u);
    asked[1](events::Snapshot{});
    write_next();
    EXPECT_EQ(hub.next(clients[1]), hub.next(clients[2]));
}

/// A batch with changes of so many vehicles.
Published changed(int vehicles) {
    Published batch;
    for (int i = 0; i < vehicles; ++i) {
        fleet::VehicleView view;
        view.id = plant::VehicleId("V" + std::to_string(i));
        batch.outputs.vehicles.push_back(view);
    }
    return batch;
}

TEST_F(StreamHubTest, AThousandVehiclesThatWaitAreNoReasonToSendSomebodyAway) {
    show_the_first();

    for (int i = 0; i < 3; ++i) hub.publish(changed(2000));
    Published fleet;
    fleet.fleet = fleet::FleetView{};
    for (std::size_t i = 0; i < StreamClient::kMaxFrames; ++i) hub.publish(fleet);
    EXPECT_FALSE(clients[0].overflowed);

    hub.publish(fleet);
    EXPECT_TRUE(clients[0].overflowed);
}

TEST_F(StreamHubTest, ChangesThatWaitTogetherAreOneFrameThatDashboardsShare) {
    hub.subscribe(clients[0]);
    hub.subscribe(clients[1]);
    asked[0](events::Snapshot{});
    write_next();
    for (int i = 0; i < 2; ++i) hub.next(clients[i]);
    auto batch = changed(2);
    batch.fleet = fleet::FleetView{};

    hub.publish(batch);
    give_everybody_a_turn();

    const Frame frame = hub.next(clients[0]);
    const auto json = nlohmann::json::parse(*frame);
    EXPECT_EQ(json["type"], "changes");
    std::string types;
    for (const auto& change : json["changes"]) types += change["type"].get<std::string>() + " ";
    EXPECT_EQ(types, "vehicle vehicle fleet ");
    EXPECT_EQ(hub.next(clients[1]), frame);
    EXPECT_EQ(hub.next(clients[0]), nullptr);
    EXPECT_EQ(clients[0].frames + clients[0].bytes, 0u);
}

TEST_F(StreamHubTest, PosesDoNotWaitUntilEveryChangeIsWritten) {
    show_the_first();
    hub.publish(changed(1000));
    hub.poses().put(plant.vehicles[0].id, {1, 2, 0}, 0.5, clock.now());
    give_everybody_a_turn();

    const auto first = nlohmann::json::parse(*hub.next(clients[0]))["changes"];
    EXPECT_LT(first.size(), 500u);
    EXPECT_EQ(first.back()["type"], "poses");
    std::size_t vehicles = first.size() - 1;
    while (const Frame frame = hub.next(clients[0])) {
        const auto json = nlohmann::json::parse(*frame);
        for (const auto& change : json["changes"]) EXPECT_EQ(change["type"], "vehicle");
        vehicles += json["changes"].size();
    }
    EXPECT_EQ(vehicles, 1000u);
}

TEST_F(StreamHubTest, PosesAloneAreTheirOwnFrame) {
    show_the_first();
    hub.poses().put(plant.vehicles[0].id, {1, 2, 0}, 0.5, clock.now());
    give_everybody_a_turn();

    EXPECT_EQ(nlohmann::json::parse(*hub.next(clients[0]))["type"], "poses");
    EXPECT_EQ(hub.next(clients[0]), nullptr);
}

TEST_F(StreamHubTest, WithoutASnapshotTheyAreSentAway) {
    hub.subscribe(clients[0]);

    asked[0](fail(Errc::kUnavailable, "store_unavailable", "not now"));

    EXPECT_TRUE(clients[0].refused);
    EXPECT_FALSE(clients[1].refused);
}

}  // namespace
}  // namespace pulseline::server::testing
