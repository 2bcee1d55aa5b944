#include "core/onboard/pose/segment_watch.hpp"

#include <gtest/gtest.h>

#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::onboard {
namespace {

/// Four edges, each with a code of its own and one that is no segment marker; the way relies on
/// "1", "2" and "3", the boundary marker. "4" belongs to the station.
class SegmentWatchTest : public ::testing::Test {
protected:
    SegmentWatchTest() {
        type_.cameras = {plant::Camera{}};
        for (int i = 1; i <= 4; ++i) {
            vda5050::OrderEdge edge;
            edge.sequence_id = 2 * i - 1;
            edge.actions.emplace_back();
            auto& observe = edge.actions.back();
            add(observe, std::to_string(i));
            add(observe, "beside-" + std::to_string(i));
            if (i < 4) observe.segment_markers = {std::to_string(i)};
            if (i == 3) observe.boundary_marker = "3";
            ahead_.push_back(std::move(edge));
        }
        watch_ = SegmentWatch(type_);
    }

    static void add(vda5050::Action& observe, const std::string& payload) {
        vda5050::SurveyedMarker marker;
        marker.payload = payload;
        marker.size_m = 0.05;
        observe.markers.push_back(marker);
    }
    void step(const std::vector<std::string>& read = {}, double sigma_m = 0.002) {
        watch_.step(ahead_, read, 0.1, sigma_m);
    }
    void drive(double way_m) {
        for (double at_m = 0; at_m < way_m; at_m += 0.1) step();
    }
    void pass_edge() {
        ahead_.pop_front();
        step();
    }

    plant::VehicleType type_ = pulseline::testing::mecanum();
    std::deque<vda5050::OrderEdge> ahead_;
    SegmentWatch watch_{type_};
};

TEST_F(SegmentWatchTest, WhoReadsThemAllIsNotSlowedDown) {
    for (const char* payload : {"1", "2", "3", "4"}) {
        step({payload});
        pass_edge();
        drive(1);
        EXPECT_TRUE(watch_.missed().empty());
        EXPECT_EQ(watch_.speed_share(), 1);
    }
}

TEST_F(SegmentWatchTest, AMissedOneIsToldAndTheVehicleGoesSlowlyUntilACodeIsRead) {
    drive(2);
    pass_edge();
    EXPECT_TRUE(watch_.missed().empty()) << "it may be read yet, of a picture taken before";
    drive(0.6);
    EXPECT_EQ(watch_.missed(), std::vector<std::string>{"1"});
    EXPECT_NEAR(watch_.speed_share() * type_.max_speed_mps, 0.3, 1e-9);
    vda5050::StateMessage state;
    watch_.write_state(state);
    ASSERT_EQ(state.errors.size(), 1u);
    EXPECT_EQ(state.errors[0].type, "segmentMarkerMissed");
    EXPECT_FALSE(state.errors[0].fatal);
    EXPECT_EQ(state.errors[0].references,
              (std::vector<std::pair<std::string, std::string>>{{"marker", "1"}}));

    step({"beside-2"});
    EXPECT_TRUE(watch_.missed().empty()) << "any code tells where it is";
    EXPECT_EQ(watch_.speed_share(), 1);
}

TEST_F(SegmentWatchTest, ACodeReadJustBehindItsEdgeIsNotMissed) {
    step();
    pass_edge();
    step({"1"});
    drive(2);
    EXPECT_TRUE(watch_.missed().empty());
}

TEST_F(SegmentWatchTest, OneThatAlsoLiesOnTheNextEdgeIsMissedBehindThatOne) {
    add(ahead_[1].actions[0], "1");
    ahead_[1].actions[0].segment_markers.push_back("1");
    step();
    pass_edge();
    drive(2);
    EXPECT_TRUE(watch_.missed().empty());
    step({"2"});
    pass_edge();
    drive(1);
    EXPECT_EQ(watch_.missed(), std::vector<std::string>{"1"});
}

TEST_F(SegmentWatchTest, APartOfTheHorizonThatIsTakenBackIsNotMissed) {
    step({"1"});
    ahead_.resize(2);
    step();
    drive(2);
    EXPECT_TRUE(watch_.missed().empty());
}

TEST_F(SegmentWatchTest, FromTheBoundaryMarkerOnItIsPreciseAndSlowOnlyIfUnsure) {
    step({"1"});
    pass_edge();
    step({"2"});
    pass_edge();
    EXPECT_FALSE(watch_.precise());
    step({}, 0.1);
    EXPECT_EQ(watch_.speed_share(), 1) << "what is left until the boundary marker is rough";
    step({"3"});
    EXPECT_TRUE(watch_.precise());
    EXPECT_EQ(watch_.speed_share(), 1);
    step({}, 0.010);
    EXPECT_EQ(watch_.speed_share(), 1) << "30 mm of the 45 mm that the camera sees to either side";
    step({}, 0.020);
    EXPECT_LT(watch_.speed_share(), 1);
    step({"4"}, 0.002);
    EXPECT_EQ(watch_.speed_share(), 1);
}

TEST_F(SegmentWatchTest, ItsStopEndsIt) {
    step({"1"});
    ahead_.erase(ahead_.begin(), ahead_.begin() + 3);
    drive(1);
    EXPECT_EQ(watch_.missed().size(), 2u);
    EXPECT_TRUE(watch_.precise());
    ahead_.clear();
    step();
    EXPECT_TRUE(watch_.missed().empty());
    EXPECT_FALSE(watch_.precise());
    EXPECT_EQ(watch_.speed_share(), 1);
}

}  // namespace
}  // namespace pulseline::onboard
