#include "core/fleet/state/leg_delivery.hpp"

#include <gtest/gtest.h>

namespace pulseline::fleet {
namespace {

using Phase = LegDelivery::Phase;

Time at(int second) { return time_from_ns(second * 1'000'000'000LL); }

TEST(LegDelivery, GoesFromPlannedOverSentToSeen) {
    LegDelivery leg;
    EXPECT_EQ(leg.phase(), Phase::kPlanned);
    leg.sent(0, true, at(1));
    EXPECT_EQ(leg.phase(), Phase::kSent);
    EXPECT_EQ(leg.unconfirmed_since(), at(1));
    EXPECT_TRUE(leg.shown(at(2)));
    EXPECT_FALSE(leg.shown(at(3))) << "for the first time once only";
    EXPECT_EQ(leg.phase(), Phase::kSeen);
    EXPECT_EQ(leg.started(), at(2));
    EXPECT_TRUE(leg.unconfirmed()) << "its id may be shown before its newest update";
    leg.confirmed();
    EXPECT_FALSE(leg.unconfirmed());
    EXPECT_EQ(leg.sends(), 0);
}

TEST(LegDelivery, ALongerBaseIsWaitedForAndSentAgainFromTheSameNode) {
    LegDelivery leg;
    leg.sent(0, true, at(1));
    leg.shown(at(1));
    leg.confirmed();
    leg.sent(3, true, at(4));
    leg.sent(3, true, at(5));
    EXPECT_EQ(leg.phase(), Phase::kSeen);
    EXPECT_EQ(leg.sent_from(), 3U);
    EXPECT_EQ(leg.sends(), 2);
    EXPECT_EQ(leg.unconfirmed_since(), at(5));
    leg.confirmed();
    EXPECT_EQ(leg.started(), at(1));
}

TEST(LegDelivery, SentInVainAPersonLetsItGoOutAnew) {
    LegDelivery leg;
    leg.sent(0, true, at(1));
    leg.unanswered();
    EXPECT_EQ(leg.phase(), Phase::kPlanned);
    EXPECT_EQ(leg.sends(), 1);
    EXPECT_EQ(leg.on_this_connection(), at(1)) << "it may still be on its way";
    leg.sent_anew();
    EXPECT_EQ(leg.sends(), 0);
    leg.reconnected();
    EXPECT_FALSE(leg.on_this_connection());
}

TEST(LegDelivery, WhatGoesOutWhileTheLineIsCutIsOnNoConnection) {
    LegDelivery leg;
    leg.sent(0, false, at(1));
    EXPECT_EQ(leg.phase(), Phase::kSent);
    EXPECT_FALSE(leg.on_this_connection());
}

TEST(LegDelivery, LostFromEveryPhaseAndNotLostWhenItIsShownAfterAll) {
    for (const bool sent : {false, true}) {
        for (const bool shown : {false, true}) {
            LegDelivery leg;
            if (sent) leg.sent(0, true, at(1));
            if (shown) leg.shown(at(2));
            leg.give_up();
            EXPECT_EQ(leg.phase(), Phase::kLost);
            EXPECT_FALSE(leg.seen());
            EXPECT_FALSE(leg.unconfirmed());
            EXPECT_TRUE(leg.shown(at(3)));
            EXPECT_EQ(leg.phase(), Phase::kSeen);
            EXPECT_EQ(leg.started(), shown ? at(2) : at(3));
        }
    }
}

TEST(LegDelivery, ACancelEndsTheWaitAndOutlivesWhatTheVehicleShows) {
    LegDelivery leg;
    leg.sent(0, true, at(1));
    leg.cancel();
    EXPECT_TRUE(leg.cancelling());
    EXPECT_FALSE(leg.unconfirmed()) << "nothing of it is sent again";
    leg.shown(at(2));
    EXPECT_TRUE(leg.cancelling());
    leg.cancel_failed();
    EXPECT_FALSE(leg.cancelling());
    EXPECT_EQ(leg.phase(), Phase::kSeen);
}

TEST(LegDelivery, AnotherLegBeginsWithNothingOfTheOneBefore) {
    LegDelivery leg;
    leg.sent(2, true, at(1));
    leg.shown(at(2));
    leg.give_up();
    leg.cancel();
    leg.begin();
    EXPECT_EQ(leg.phase(), Phase::kPlanned);
    EXPECT_FALSE(leg.cancelling());
    EXPECT_EQ(leg.sends(), 0);
    EXPECT_FALSE(leg.started());
    EXPECT_FALSE(leg.on_this_connection());
}

}  // namespace
}  // namespace pulseline::fleet
