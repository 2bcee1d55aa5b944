#include "api/access/access_control.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "api/access/credentials.hpp"
#include "api/access/secrets.hpp"
#include "tests/api/access/memory_store.hpp"

namespace pulseline::api::access {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;
using Headers = std::map<std::string, std::string>;

constexpr HashCost kCheap{1, 8192};  // libsodium's least: the real cost has its own test
const std::string kPassword = "correct horse";

class AccessControlTest : public testing::Test {
protected:
    AccessControlTest() { restart(); }

    void restart(Time last_stored = {}) {
        access = std::make_unique<AccessControl>(
            store,
            [this](const Change& change) {
                if (disk_full) throw std::runtime_error("disk full");
                api::access::apply(store, change);
            },
            now, last_stored, Limits{}, kCheap);
    }
    SignedIn sign_in(const std::string& name = "mei") {
        auto signed_in = access->sign_in(name, kPassword, "10.0.0.7", now);
        EXPECT_TRUE(signed_in.has_value());
        return signed_in.value_or(SignedIn{});
    }
    Identity with_cookie(const std::string& token) {
        return access->identify({{"cookie", "theme=dark; pulseline_session=" + token}}, now);
    }
    Identity with_bearer(const std::string& secret) {
        return access->identify({{"authorization", "Bearer " + secret}}, now);
    }
    void add_user(const std::string& name, Role role) {
        ASSERT_TRUE(access->create_user(name, role, kPassword, now).has_value());
    }

    MemoryStore store;
    bool disk_full = false;
    Time now = time_from_ns(1'700'000'000'000'000'000);
    std::unique_ptr<AccessControl> access;
};

TEST_F(AccessControlTest, CookieOfASignInIdentifiesTheUserWithRoleAndCsrfToken) {
    add_user("mei", Role::kOperator);

    const SignedIn signed_in = sign_in();
    const Identity identity = with_cookie(signed_in.cookie_token);

    EXPECT_EQ(identity.kind, Identity::Kind::kUser);
    EXPECT_EQ(identity.name, "mei");
    EXPECT_EQ(identity.role, Role::kOperator);
    EXPECT_EQ(identity.csrf_token, signed_in.identity.csrf_token);
    EXPECT_GE(signed_in.cookie_token.size(), 43U);  // 256 bits in base64url
}

TEST_F(AccessControlTest, NoSecretIsStoredInClear) {
    add_user("mei", Role::kOperator);
    const SignedIn signed_in = sign_in();
    const auto api = access->create_api_token(Role::kOperator, "api", "MES", now);
    const auto vehicle = access->create_vehicle_token("comac", "tp-01", "", now);

    ASSERT_EQ(store.sessions().size(), 1U);
    EXPECT_EQ(store.sessions()[0].token_sha256, sha256_hex(signed_in.cookie_token));
    EXPECT_EQ(store.users()[0].password_hash.find(kPassword), std::string::npos);
    EXPECT_EQ(store.users()[0].password_hash.rfind("$argon2id$", 0), 0U);
    EXPECT_EQ(api->secret.rfind("pla_", 0), 0U);
    EXPECT_EQ(vehicle->secret.rfind("plv_", 0), 0U);
    for (const Token& token : store.tokens()) {
        EXPECT_EQ(token.token_sha256.size(), 64U);
        EXPECT_NE(token.token_sha256, sha256_hex(""));
        EXPECT_EQ(api->secret.find(token.id), std::string::npos);
    }
}

TEST_F(AccessControlTest, SessionEndsAfterThirtyIdleMinutesAndUseKeepsIt) {
    add_user("mei", Role::kViewer);
    const std::string cookie = sign_in().cookie_token;

    now += minutes(29);
    EXPECT_EQ(with_cookie(cookie).kind, Identity::Kind::kUser);
    now += minutes(29);
    EXPECT_EQ(with_cookie(cookie).kind, Identity::Kind::kUser);
    now += minutes(30);
    EXPECT_EQ(with_cookie(cookie).kind, Identity::Kind::kAnonymous);
}

TEST_F(AccessControlTest, SessionEndsAfterTwelveHoursHoweverBusy) {
    add_user("mei", Role::kViewer);
    const std::string cookie = sign_in().cookie_token;
    const Time start = now;

    while (now - start < hours(12) - minutes(20)) {
        now += minutes(20);
        ASSERT_EQ(with_cookie(cookie).kind, Identity::Kind::kUser);
    }
    now = start + hours(12);
    EXPECT_EQ(with_cookie(cookie).kind, Identity::Kind::kAnonymous);
}

TEST_F(AccessControlTest, LookingWhetherAStreamMayGoOnIsNoUse) {
    add_user("mei", Role::kViewer);
    const SignedIn signed_in = sign_in();

    now += minutes(20);
    EXPECT_TRUE(access->still_valid(signed_in.identity, now));
    now += minutes(10);
    EXPECT_FALSE(access->still_valid(signed_in.identity, now));
}

TEST_F(AccessControlTest, SignOutEndsTheSessionAtOnceAlsoForOpenStreams) {
    add_user("mei", Role::kViewer);
    const SignedIn signed_in = sign_in();

    access->sign_out(signed_in.identity);

    EXPECT_EQ(with_cookie(signed_in.cookie_token).kind, Identity::Kind::kAnonymous);
    EXPECT_FALSE(access->still_valid(signed_in.identity, now));
    EXPECT_TRUE(store.sessions().empty());
}

TEST_F(AccessControlTest, RestartKeepsSessionsUsersAndTokens) {
    add_user("mei", Role::kEngineer);
    const std::string cookie = sign_in().cookie_token;
    const auto token = access->create_api_token(Role::kViewer, "api", "wall", now);

    restart();

    EXPECT_EQ(with_cookie(cookie).role, Role::kEngineer);
    EXPECT_EQ(with_bearer(token->secret).role, Role::kViewer);
}

TEST_F(AccessControlTest, WrongPasswordUnknownAndDisabledUserLookTheSame) {
    add_user("mei", Role::kViewer);
    add_user("old", Role::kViewer);
    User old = store.users()[1];
    old.disabled = true;
    store.put(old);
    restart();

    const auto wrong = access->sign_in("mei", "something else", "a", now);
    const auto unknown = access->sign_in("nobody", kPassword, "a", now);
    const auto disabled = access->sign_in("old", kPassword, "a", now);

    ASSERT_FALSE(wrong || unknown || disabled);
    EXPECT_EQ(wrong.error().reason, unknown.error().reason);
    EXPECT_EQ(wrong.error().what, unknown.error().what);
    EXPECT_EQ(wrong.error().reason, disabled.error().reason);
    EXPECT_EQ(wrong.error().reason.code, "wrong_credentials");
}

TEST_F(AccessControlTest, DisablingAUserEndsItsSessions) {
    add_user("mei", Role::kViewer);
    const std::string cookie = sign_in().cookie_token;
    User user = store.users()[0];
    user.disabled = true;
    store.put(user);

    restart();

    EXPECT_EQ(with_cookie(cookie).kind, Identity::Kind::kAnonymous);
}

TEST_F(AccessControlTest, SixthAttemptWithinAMinuteWaitsAndNobodyElseDoes) {
    add_user("mei", Role::kViewer);
    for (int i = 0; i < 5; ++i) {
        ASSERT_EQ(access->sign_in("mei", "wrong", "10.0.0.7", now).error().reason.code,
                  "wrong_credentials");
        now += seconds(10);
    }

    const auto sixth = access->sign_in("mei", kPassword, "10.0.0.7", now);
    ASSERT_FALSE(sixth);
    EXPECT_EQ(sixth.error().reason,
              (Reason{"too_many_sign_ins", {{"retry_after_s", std::int64_t{10}}}}));
    EXPECT_TRUE(access->sign_in("mei", kPassword, "10.0.0.8", now).has_value());

    now += seconds(10);
    EXPECT_TRUE(access->sign_in("mei", kPassword, "10.0.0.7", now).has_value());
}

TEST_F(AccessControlTest, ASuccessForgetsEarlierAttempts) {
    add_user("mei", Role::kViewer);
    for (int i = 0; i < 20; ++i) {
        ASSERT_TRUE(access->sign_in("mei", kPassword, "10.0.0.7", now).has_value());
    }
}

TEST_F(AccessControlTest, NothingChangesInMemoryWhenTheStoreFails) {
    add_user("mei", Role::kViewer);
    const SignedIn signed_in = sign_in();
    disk_full = true;

    EXPECT_THROW(access->sign_out(signed_in.identity), std::runtime_error);
    EXPECT_THROW(static_cast<void>(access->create_user("new", Role::kViewer, kPassword, now)),
                 std::runtime_error);
    EXPECT_THROW(static_cast<void>(access->create_api_token(Role::kAdmin, "api", "", now)),
                 std::runtime_error);

    EXPECT_EQ(with_cookie(signed_in.cookie_token).kind, Identity::Kind::kUser);
    EXPECT_EQ(access->users().size(), 1U);
    EXPECT_TRUE(access->tokens().empty());
}

TEST_F(AccessControlTest, NewPasswordEndsEverySessionOfTheUser) {
    add_user("mei", Role::kViewer);
    const std::string first = sign_in().cookie_token;
    const std::string second = sign_in().cookie_token;

    ASSERT_TRUE(access->create_user("mei", Role::kOperator, "another one", now).has_value());

    EXPECT_EQ(with_cookie(first).kind, Identity::Kind::kAnonymous);
    EXPECT_EQ(with_cookie(second).kind, Identity::Kind::kAnonymous);
    EXPECT_FALSE(access->sign_in("mei", kPassword, "x", now).has_value());
    EXPECT_EQ(access->sign_in("mei", "another one", "x", now)->identity.role, Role::kOperator);
}

TEST_F(AccessControlTest, RevokedTokenStopsAtOnce) {
    const auto token = access->create_api_token(Role::kOperator, "api", "MES", now);
    const Identity identity = with_bearer(token->secret);
    ASSERT_EQ(identity.kind, Identity::Kind::kToken);
    ASSERT_EQ(identity.name, "token:" + token->token.id);

    ASSERT_TRUE(access->revoke_token(token->token.id).has_value());

    EXPECT_EQ(with_bearer(token->secret).kind, Identity::Kind::kAnonymous);
    EXPECT_FALSE(access->still_valid(identity, now));
    restart();
    EXPECT_EQ(with_bearer(token->secret).kind, Identity::Kind::kAnonymous);
    EXPECT_EQ(access->revoke_token("nothing").error().code, Errc::kNotFound);
}

TEST_F(AccessControlTest, VehicleTokenOpensItsOwnLinkOnly) {
    const auto vehicle = access->create_vehicle_token("comac", "tp-01", "", now);
    const auto api = access->create_api_token(Role::kAdmin, "api", "", now);
    const std::string header = "Bearer " + vehicle->secret;

    EXPECT_TRUE(access->vehicle_for_token(header, "comac", "tp-01").has_value());
    EXPECT_FALSE(access->vehicle_for_token(header, "comac", "tp-02").has_value());
    EXPECT_FALSE(access->vehicle_for_token(header, "other", "tp-01").has_value());
    EXPECT_FALSE(access->vehicle_for_token("Bearer " + api->secret, "comac", "tp-01").has_value());
    EXPECT_FALSE(access->vehicle_for_token("Bearer " + api->secret, "", "").has_value());
    EXPECT_FALSE(access->vehicle_for_token("", "comac", "tp-01").has_value());
    EXPECT_EQ(with_bearer(vehicle->secret).kind, Identity::Kind::kVehicle);
    EXPECT_FALSE(with_bearer(vehicle->secret).at_least(Role::kViewer));
}

TEST_F(AccessControlTest, AUselessBearerDoesNotFallBackToTheCookie) {
    add_user("mei", Role::kViewer);
    const std::string cookie = sign_in().cookie_token;
    for (const char* authorization :
         {"Bearer wrong", "Basic bWVpOng=", "", "Bearer", "bearer   "}) {
        const Identity identity = access->identify(
            {{"authorization", authorization}, {"cookie", "pulseline_session=" + cookie}}, now);
        EXPECT_EQ(identity.kind, Identity::Kind::kAnonymous) << authorization;
    }
}

TEST_F(AccessControlTest, OddCookieHeadersAreAnonymous) {
    add_user("mei", Role::kViewer);
    const std::string cookie = sign_in().cookie_token;
    for (const std::string& header :
         {std::string("pulseline_session"), std::string("pulseline_session="), std::string(";;;="),
          "xpulseline_session=" + cookie, "pulseline_session=" + cookie + "x",
          "pulseline_session=\"" + cookie + "\"", "PULSELINE_SESSION=" + cookie}) {
        EXPECT_EQ(access->identify({{"cookie", header}}, now).kind, Identity::Kind::kAnonymous)
            << header;
    }
    EXPECT_EQ(access->identify({{"cookie", "__Host-pulseline_session=" + cookie}}, now).name,
              "mei");
}

TEST_F(AccessControlTest, BadNamesAndPasswordsAreRefusedWithTheField) {
    const auto refused = [&](const std::string& name, const std::string& password) {
        const auto user = access->create_user(name, Role::kViewer, password, now);
        return user ? std::string("accepted") : user.error().field;
    };
    EXPECT_EQ(refused("", kPassword), "/name");
    EXPECT_EQ(refused("a b", kPassword), "/name");
    EXPECT_EQ(refused("token:1", kPassword), "/name");  // would look like a program in the journal
    EXPECT_EQ(refused(std::string(65, 'a'), kPassword), "/name");
    EXPECT_EQ(refused("mei", "1234567"), "/password");
    EXPECT_EQ(refused("mei", std::string(129, 'x')), "/password");
    EXPECT_EQ(refused("long.name", "long.name"), "/password");
    EXPECT_EQ(refused("mei", "12345678"), "accepted");
    EXPECT_EQ(refused("zoe", std::string(128, 'x')), "accepted");
}

TEST(Secrets, PasswordHashAtTheShippedCostVerifies) {
    const std::string hash = hash_password("correct horse", HashCost{});

    EXPECT_NE(hash.find("m=65536,t=2"), std::string::npos);
    EXPECT_TRUE(verify_password(hash, "correct horse"));
    EXPECT_FALSE(verify_password(hash, "correct horsf"));
    EXPECT_FALSE(verify_password("", "correct horse"));
    EXPECT_FALSE(verify_password(std::string(500, 'a'), "correct horse"));
}

TEST(Secrets, Sha256AndBase64UrlMatchPublishedVectors) {
    EXPECT_EQ(sha256_hex("abc"),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(base64url("fooba"), "Zm9vYmE");
    EXPECT_EQ(base64url("\xFB\xFF"), "-_8");
    EXPECT_EQ(from_base64url("Zm9vYmE"), "fooba");
    for (const char* bad : {"Zm9vYmE=", "Zm9v YmE", "Zm9+", "Z", "\xC3\xA9"}) {
        EXPECT_EQ(from_base64url(bad), "") << bad;
    }
}

TEST(Cookie, AttributesFitTheConnection) {
    EXPECT_EQ(session_cookie("T", false, 60),
              "pulseline_session=T; Path=/; HttpOnly; SameSite=Strict; Max-Age=60");
    EXPECT_EQ(session_cookie("T", true, 60),
              "__Host-pulseline_session=T; Path=/; HttpOnly; SameSite=Strict; Max-Age=60; Secure");
    EXPECT_NE(expired_cookie(false).find("Max-Age=0"), std::string::npos);
}

TEST_F(AccessControlTest, ASessionLeftAloneDoesNotLiveAgainAfterARestart) {
    add_user("mei", Role::kOperator);
    const SignedIn signed_in = sign_in();

    now += hours(2);
    EXPECT_EQ(with_cookie(signed_in.cookie_token).kind, Identity::Kind::kAnonymous);
    restart();

    EXPECT_EQ(with_cookie(signed_in.cookie_token).kind, Identity::Kind::kAnonymous);
}

TEST_F(AccessControlTest, ASessionOfAClockThatWasAheadEndsWithIt) {
    add_user("mei", Role::kOperator);
    now += hours(24 * 365);
    const SignedIn signed_in = sign_in();

    now -= hours(24 * 365);
    restart();

    EXPECT_EQ(with_cookie(signed_in.cookie_token).kind, Identity::Kind::kAnonymous);
}

TEST_F(AccessControlTest, ASessionInUseGoesOnAfterARestart) {
    add_user("mei", Role::kOperator);
    const SignedIn signed_in = sign_in();
    now += minutes(25);
    with_cookie(signed_in.cookie_token);
    access->save_uses();

    now += minutes(25);
    restart();

    EXPECT_EQ(with_cookie(signed_in.cookie_token).name, "mei");
    EXPECT_EQ(access->signed_in(now), std::vector<std::string>{"mei"});
}

TEST_F(AccessControlTest, WhoWorksStaysSignedInWhenTheClockIsSetBackBetweenTwoStarts) {
    add_user("mei", Role::kOperator);
    const SignedIn signed_in = sign_in();
    const Time stored = now;

    now -= hours(1);
    restart(stored);
    EXPECT_EQ(with_cookie(signed_in.cookie_token).name, "mei");

    // Once more, the clock unchanged: what was taken back has been stored.
    restart(now);
    EXPECT_EQ(with_cookie(signed_in.cookie_token).name, "mei");
    now += minutes(30);
    EXPECT_EQ(with_cookie(signed_in.cookie_token).kind, Identity::Kind::kAnonymous)
        << "idle for as long as ever";
}

TEST_F(AccessControlTest, ASessionThatHadEndedDoesNotLiveAgainWhenTheClockIsSetBack) {
    add_user("mei", Role::kOperator);
    const SignedIn signed_in = sign_in();
    const Time stored = now + minutes(80);

    now += minutes(20);  // an hour before that
    restart(stored);
    EXPECT_EQ(with_cookie(signed_in.cookie_token).kind, Identity::Kind::kAnonymous);

    // Nor at a start that knows of no later time.
    restart();
    EXPECT_EQ(with_cookie(signed_in.cookie_token).kind, Identity::Kind::kAnonymous);
    EXPECT_TRUE(store.sessions().empty());
}

TEST_F(AccessControlTest, ASessionThatHasEndedIsDroppedFromTheStore) {
    add_user("mei", Role::kOperator);
    const SignedIn signed_in = sign_in();
    now += minutes(29);
    access->forget_ended(now);
    EXPECT_EQ(store.sessions().size(), 1U);

    now += minutes(1);
    access->forget_ended(now);
    EXPECT_TRUE(store.sessions().empty());

    now -= hours(1);
    restart();
    EXPECT_EQ(with_cookie(signed_in.cookie_token).kind, Identity::Kind::kAnonymous);
}

TEST_F(AccessControlTest, AUseTellsOfALaterTimeThanWhatAHallWithoutVehiclesStored) {
    add_user("mei", Role::kOperator);
    const Time stored = now;
    now += minutes(40);
    const SignedIn signed_in = sign_in();

    now -= hours(1);
    restart(stored);

    EXPECT_EQ(with_cookie(signed_in.cookie_token).name, "mei");
}

TEST_F(AccessControlTest, ASessionThatEndedMeanwhileIsNotStoredAgainByItsUse) {
    add_user("mei", Role::kOperator);
    const SignedIn signed_in = sign_in();
    now += minutes(5);
    const Identity identity = with_cookie(signed_in.cookie_token);

    store.remove_sessions({identity.session_sha256});
    access->save_uses();

    EXPECT_TRUE(store.sessions().empty());
}

}  // namespace
}  // namespace pulseline::api::access
