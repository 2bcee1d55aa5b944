#include "api/vda5050/motion.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "api/vda5050/order.hpp"
#include "tests/api/vda5050/samples.hpp"

namespace pulseline::vda5050 {
namespace {

vda5050::OrderMessage round_trip(const vda5050::OrderMessage& order) {
    const auto parsed = json::parse_json(encode_order(order, testing::header()));
    EXPECT_TRUE(parsed);
    const auto decoded = decode_order(*parsed);
    EXPECT_TRUE(decoded) << decoded.error().what << " at " << decoded.error().field;
    return decoded.value_or(vda5050::OrderMessage{});
}

void expect_same(const geometry::Pose2& a, const geometry::Pose2& b) {
    EXPECT_NEAR(a.x_m, b.x_m, 1e-9);
    EXPECT_NEAR(a.y_m, b.y_m, 1e-9);
    EXPECT_NEAR(wrap(a.heading_rad - b.heading_rad), 0, 1e-9);
}

TEST(Motion, EverySegmentComesBackFromItsGeometry) {
    const auto order = testing::order();
    const auto back = round_trip(order);
    ASSERT_EQ(back.edges.size(), order.edges.size());
    for (std::size_t i = 0; i < order.edges.size(); ++i) {
        SCOPED_TRACE(i);
        const auto& sent = order.edges[i].segment;
        const auto& read = back.edges[i].segment;
        EXPECT_EQ(read.kind, sent.kind);
        expect_same(read.start, sent.start);
        expect_same(read.end, sent.end);
        EXPECT_NEAR(read.turn_rad, sent.turn_rad, 1e-8);
        EXPECT_NEAR(read.length_m, sent.length_m, 1e-7);
        EXPECT_NEAR(wrap(read.direction_rad - sent.direction_rad), 0, 1e-9);
        if (sent.kind == kinematics::Segment::Kind::kArc) {
            EXPECT_NEAR(read.centre.x_m, sent.centre.x_m, 1e-6);
            EXPECT_NEAR(read.centre.y_m, sent.centre.y_m, 1e-6);
        }
    }
}

TEST(Motion, ArcsAreExactQuarterPiecesWithTheWeightOfTheStandard) {
    Json edge;
    encode_motion(edge, testing::arc({1, 2, 0.3}, 8, 2.0, false));
    const Json& trajectory = edge["trajectory"];
    EXPECT_EQ(trajectory["degree"], 2);
    ASSERT_EQ(trajectory["controlPoints"].size(), 5u);  // two pieces
    EXPECT_EQ(trajectory["knotVector"].size(), 5u + 2 + 1);
    EXPECT_NEAR(trajectory["controlPoints"][1]["weight"].get<double>(), std::cos(0.5), 1e-12);
}

TEST(Motion, LeftIsMinusHalfPi) {
    Json edge;
    encode_motion(edge, testing::straight({}, 1, kPi / 2));
    EXPECT_NEAR(edge["orientation"].get<double>(), -kPi / 2, 1e-12);
}

/// The order as sent, with one thing changed.
Error refused(const std::function<void(Json&)>& change) {
    auto message = *json::parse_json(encode_order(testing::order(), testing::header()));
    change(message);
    const auto decoded = decode_order(message);
    EXPECT_FALSE(decoded);
    return decoded ? Error{} : decoded.error();
}

TEST(Motion, RefusesATrajectoryThatIsNoArcOrLeadsElsewhere) {
    const auto error =
        refused([](Json& m) { m["edges"][6]["trajectory"]["controlPoints"][1]["weight"] = 1.0; });
    EXPECT_EQ(error.field, "/edges/6/trajectory");
    EXPECT_EQ(refused([](Json& m) {
                  m["edges"][6]["trajectory"]["controlPoints"].back()["x"] = 0.0;
              }).field,
              "/edges/6/trajectory");
    EXPECT_EQ(refused([](Json& m) { m["edges"][6]["orientation"] = 1.5; }).field,
              "/edges/6/orientation");
}

TEST(Motion, GlobalOrientationIsTheHeading) {
    auto message = *json::parse_json(encode_order(testing::order(), testing::header()));
    message["edges"][0]["orientationType"] = "GLOBAL";
    message["edges"][0]["orientation"] = 0.2;
    const auto decoded = decode_order(message);
    ASSERT_TRUE(decoded);
    EXPECT_NEAR(decoded->edges[0].segment.start.heading_rad, 0.2, 1e-12);
    EXPECT_NEAR(decoded->edges[0].segment.direction_rad, 0, 1e-9);
}

}  // namespace
}  // namespace pulseline::vda5050
