#include "db/access/access_store.hpp"

#include <gtest/gtest.h>

namespace pulseline::db {
namespace {

using access::Role;

Time at(std::int64_t s) { return time_from_ns(s * 1'000'000'000); }

class AccessStoreTest : public testing::Test {
protected:
    Database database_{":memory:"};
    AccessStore store_{database_};

    void SetUp() override {
        store_.put(access::User{"ann", Role::kEngineer, "$argon2id$x", false, at(1)});
    }
};

TEST_F(AccessStoreTest, UserIsReplacedByNameAndKeepsItsSessions) {
    store_.put(access::Session{"hash", "csrf", "ann", at(1), at(100)});
    store_.put(access::User{"ann", Role::kAdmin, "$argon2id$y", true, at(1)});
    const auto users = store_.users();

    ASSERT_EQ(users.size(), 1u);
    EXPECT_EQ(users[0].role, Role::kAdmin);
    EXPECT_TRUE(users[0].disabled);
    EXPECT_EQ(users[0].created, at(1));
    EXPECT_EQ(store_.sessions().size(), 1u);
}

TEST_F(AccessStoreTest, SessionsGoWhenRemoved) {
    store_.put(access::Session{"a", "csrf", "ann", at(1), at(10)});
    store_.put(access::Session{"b", "csrf", "ann", at(2), at(100)});
    store_.put(access::Session{"c", "csrf", "ann", at(20), at(100)});
    store_.put(access::Session{"d", "csrf", "ann", at(20), at(100)});
    store_.remove_sessions({"b"});
    EXPECT_EQ(store_.sessions().size(), 3u);
    store_.remove_sessions({"a", "gone", "d"});
    const auto sessions = store_.sessions();

    ASSERT_EQ(sessions.size(), 1u);
    EXPECT_EQ(sessions[0].token_sha256, "c");
    EXPECT_EQ(sessions[0].expires, at(100));
}

TEST_F(AccessStoreTest, RemembersWhenASessionWasUsed) {
    store_.put(access::Session{"a", "csrf", "ann", at(1), at(100), at(1)});
    store_.put_use("a", at(40));
    store_.put_use("gone", at(40));
    const auto sessions = store_.sessions();

    ASSERT_EQ(sessions.size(), 1u);
    EXPECT_EQ(sessions[0].used, at(40));
}

TEST_F(AccessStoreTest, SessionOfNobodyIsRefused) {
    EXPECT_THROW(store_.put(access::Session{"a", "csrf", "bob", at(1), at(10)}), Error);
}

TEST_F(AccessStoreTest, TokensOfProgramsAndVehiclesComeBack) {
    access::Token api;
    api.id = "t1";
    api.token_sha256 = "h1";
    api.note = "MES";
    api.role = Role::kOperator;
    api.scope = "api";
    access::Token vehicle;
    vehicle.id = "t2";
    vehicle.token_sha256 = "h2";
    vehicle.vehicle_manufacturer = "pulseline";
    vehicle.vehicle_serial = "TP-01";
    store_.put(api);
    store_.put(vehicle);
    api.revoked = true;
    store_.put(api);
    const auto tokens = store_.tokens();

    ASSERT_EQ(tokens.size(), 2u);
    EXPECT_EQ(tokens[0].role, Role::kOperator);
    EXPECT_TRUE(tokens[0].revoked);
    EXPECT_EQ(tokens[1].role, std::nullopt);
    EXPECT_EQ(tokens[1].vehicle_serial, "TP-01");
}

}  // namespace
}  // namespace pulseline::db
