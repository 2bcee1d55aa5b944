#include "server/base/lane.hpp"

#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <vector>

namespace pulseline::server {
namespace {

/// Keeps a lane busy until it is let go. What its job looks at is the job's own: it may still wake
/// up when the plug is gone.
class Plug {
public:
    explicit Plug(Lane& lane) {
        const auto running = std::make_shared<std::promise<void>>();
        const auto job = [running, go = go_.get_future().share()](bool) {
            running->set_value();
            go.wait();
        };
        EXPECT_EQ(lane.take("plug", job), Lane::Taken::kYes);
        running->get_future().wait();
    }
    void pull() { go_.set_value(); }

private:
    std::promise<void> go_;
};

TEST(Lane, RunsJobsInTheOrderTheyCame) {
    std::vector<int> done;
    std::promise<void> last;
    Lane lane({});
    for (int i = 0; i < 5; ++i) {
        lane.take("a", [&, i](bool run) {
            EXPECT_TRUE(run);
            done.push_back(i);
            if (i == 4) last.set_value();
        });
    }
    last.get_future().wait();

    EXPECT_EQ(done, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(Lane, GivesNobodyMoreThanAShare) {
    Lane lane({10, 2, 0});
    Plug plug(lane);
    const auto nothing = [](bool) {};

    EXPECT_EQ(lane.take("greedy", nothing), Lane::Taken::kYes);
    EXPECT_EQ(lane.take("greedy", nothing), Lane::Taken::kYes);
    EXPECT_EQ(lane.take("greedy", nothing), Lane::Taken::kShareIsUsed);
    EXPECT_EQ(lane.take("modest", nothing), Lane::Taken::kYes);
    plug.pull();
}

TEST(Lane, TakesNoMoreThanItsQueueHolds) {
    Lane lane({2, 2, 0});
    Plug plug(lane);
    const auto nothing = [](bool) {};

    EXPECT_EQ(lane.take("a", nothing), Lane::Taken::kYes);
    EXPECT_EQ(lane.take("b", nothing), Lane::Taken::kYes);
    EXPECT_EQ(lane.take("c", nothing), Lane::Taken::kFull);
    plug.pull();
}

TEST(Lane, GivesUpWhatWaitsWhenItStops) {
    Lane lane({200, 200, 0});
    Plug plug(lane);
    int ran = 0;
    int given_up = 0;
    for (int i = 0; i < 150; ++i) lane.take("a", [&](bool run) { ++(run ? ran : given_up); });

    lane.stop();

    EXPECT_EQ(given_up, 150);
    EXPECT_EQ(ran, 0);
    EXPECT_EQ(lane.take("a", [](bool) {}), Lane::Taken::kStopped);
    plug.pull();
}

}  // namespace
}  // namespace pulseline::server
