#include <gtest/gtest.h>

#include "core/fleet/views/order_preview.hpp"
#include "tests/core/fleet/fleet_world.hpp"

/// An order that has not started is given other steps.
namespace pulseline::fleet::testing {
namespace {

NewOrder to_station(int number) {
    NewOrder order;
    order.vehicle = plant::VehicleId("V1");
    order.steps = {{number}};
    return order;
}

class OrderUpdate : public ::testing::Test {
protected:
    OrderUpdate() {
        world.connect_all();
        world.run(1);  // until the vehicle has said where it stands
        wanted.earliest_start = world.now + from_seconds(3600);
        id = world.order(wanted)->order.id;
    }
    Result<Created> update(const NewOrder& order) {
        ControlRequest request;
        request.method = JobMethod::kUpdate;
        request.actor = "mes";
        request.update = order;
        auto answer = world.fleet->control_order(id, request, world.now);
        world.settle();
        return answer;
    }

    World world;
    NewOrder wanted = to_station(3);
    JobOrderId id;
};

// It is the only order: where it used to end is not where its vehicle will come from.
TEST_F(OrderUpdate, IsPlannedFromWhereTheVehicleIs) {
    const double planned_s = world.stored(id).steps.front().planned_s;
    ASSERT_GT(planned_s, 0);
    ASSERT_TRUE(update(wanted));
    EXPECT_EQ(world.stored(id).steps.front().planned_s, planned_s);
}

TEST_F(OrderUpdate, IsPlannedBesideTheFleetFromThereToo) {
    OrderPreviewer previewer;
    const auto start = [&](JobOrderId self) {
        return previewer.preview(world.fleet->preview_task(wanted, world.now, self))
            .steps.front()
            .start;
    };
    const Pose2 vehicle = world.fleet->vehicle(wanted.vehicle, world.now)->pose.value();
    EXPECT_EQ(start(id).x_m, vehicle.x_m);
    EXPECT_NE(start({}).x_m, vehicle.x_m) << "a second order begins where the first one ends";
}

TEST_F(OrderUpdate, OfABadOneNamesTheFieldAndChangesNothing) {
    const auto answer = update(to_station(99));
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().field, "/order/steps/0/station");
    EXPECT_EQ(world.fleet->order(id)->steps.at(0).station.str(), "s3");
}

}  // namespace
}  // namespace pulseline::fleet::testing
