#include "core/planning/room/obstacles.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace pulseline::planning {
namespace {

using geometry::Polygon;

/// A hall with a grid of random marks and nothing else.
plant::Plant marked_hall(std::mt19937_64& random) {
    plant::Plant plant;
    plant::Hall hall;
    hall.id = plant::HallId("hall");
    hall.outline = {{0, 0}, {40, 0}, {40, 30}, {0, 30}};
    hall.grid.width = 400;
    hall.grid.height = 300;
    hall.grid.resolution_m = 0.1;
    hall.grid.occupied.assign(400 * 300, 0);
    for (int i = 0; i < 25; ++i) {  // blobs, so that there are inner cells
        const auto col = random() % 380;
        const auto row = random() % 280;
        for (std::size_t y = row; y < row + 3 + random() % 15; ++y) {
            for (std::size_t x = col; x < col + 3 + random() % 15; ++x) {
                hall.grid.occupied[y * 400 + x] = 1;
            }
        }
    }
    plant.halls.push_back(hall);
    return plant;
}

double by_hand(const plant::Hall& hall, const Polygon& piece) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hall.outline.size(); ++i) {
        least = std::min(least,
                         geometry::distance(piece, {hall.outline[i], hall.outline[(i + 1) % 4]}));
    }
    for (int row = 0; row < hall.grid.height; ++row) {
        for (int col = 0; col < hall.grid.width; ++col) {
            if (!hall.grid.is_occupied(col, row)) continue;
            const double x = col * 0.1;
            const double y = row * 0.1;
            least = std::min(least,
                             geometry::distance(
                                 piece, {{x, y}, {x + 0.1, y}, {x + 0.1, y + 0.1}, {x, y + 0.1}}));
        }
    }
    return least;
}

TEST(Obstacles, MeasureTheDistanceToGridAndWallsExactly) {
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> x(4, 36);
    std::uniform_real_distribution<double> y(4, 26);
    std::uniform_real_distribution<double> turn(-kPi, kPi);
    int free_places = 0;
    for (int hall = 0; hall < 4; ++hall) {
        const auto plant = marked_hall(random);
        const Obstacles obstacles(plant, plant.halls.front());
        for (int i = 0; i < 40; ++i) {
            const auto piece = geometry::transformed({x(random), y(random), turn(random)},
                                                     geometry::rectangle(4, 1));
            const double truth = by_hand(plant.halls.front(), piece);
            EXPECT_NEAR(obstacles.nearest({piece}).distance_m, truth, 1e-9);
            EXPECT_EQ(obstacles.keeps({piece}, obstacles.limits(0.5)), truth >= 0.5);
            const auto violation = obstacles.violation({piece}, obstacles.limits(0.5));
            EXPECT_EQ(violation.has_value(), truth < 0.5);
            EXPECT_NEAR(violation ? violation->distance_m : truth, truth, 1e-9);
            free_places += truth >= 0.5 ? 1 : 0;
        }
    }
    EXPECT_GT(free_places, 20);
    EXPECT_LT(free_places, 140);
}

TEST(Obstacles, OutsideTheHallIsTheWall) {
    plant::Plant plant;
    plant::Hall hall;
    hall.outline = {{0, 0}, {40, 0}, {40, 30}, {0, 30}};
    plant.halls.push_back(hall);
    const Obstacles obstacles(plant, plant.halls.front());
    const auto outside = geometry::transformed({60, 10, 0}, geometry::rectangle(4, 1));

    const auto violation = obstacles.violation({outside}, obstacles.limits(0.1));

    ASSERT_TRUE(violation);
    EXPECT_EQ(violation->what, "wall");
    EXPECT_EQ(violation->distance_m, 0);
}

TEST(Obstacles, AMarkedCellBesideAnAreaCarriesItsName) {
    std::mt19937_64 random(1);
    plant::Plant plant = marked_hall(random);
    auto& grid = plant.halls.front().grid;
    std::fill(grid.occupied.begin(), grid.occupied.end(), std::uint8_t{0});
    for (std::size_t col = 99; col <= 151; ++col) grid.occupied[99 * 400 + col] = 1;
    grid.occupied[200 * 400 + 300] = 1;
    plant.areas.push_back({plant::AreaId("jig"),
                           plant::AreaKind::kObstacle,
                           "Jig",
                           plant::HallId("hall"),
                           {{10, 10}, {15, 10}, {15, 12}, {10, 12}},
                           {}});
    const Obstacles obstacles(plant, plant.halls.front());

    EXPECT_EQ(obstacles.nearest({{{12, 9}, {13, 9}, {13, 9.5}}}).what, "jig");
    EXPECT_EQ(obstacles.nearest({{{29, 21}, {30, 21}, {30, 21.5}}}).what, "map");
}

}  // namespace
}  // namespace pulseline::planning
