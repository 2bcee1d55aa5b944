#include "core/mapping/monte_carlo.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/base/square.hpp"
#include "core/mapping/likelihood_field.hpp"
#include "core/mapping/particle_cloud.hpp"
#include "core/mapping/surfaces.hpp"

namespace pulseline::mapping {
namespace {

using geometry::Point2;
using geometry::Pose2;

// Of one ray's end from what it met: the scanner's noise and half a cell.
constexpr float kRaySigma_m = 0.04F;
constexpr float kWithin_m = 0.3F;  // farther off something else was met
constexpr float kByChance = 0.2F;  // of all rays, on what is not in the map
// Of a scan: neighbours tell the same. Where the place is known roughly, more: 20 m away the rays
// are 1 m apart, and between them one does not see where a column ends.
constexpr std::size_t kEveryRay = 12;
constexpr std::size_t kEveryRayRoughly = 6;
constexpr double kNothing = 1e4;
// Around a ray's end, what stands there shows which way it lies: so far that a wall that the map
// has in three rows of cells is still one.
constexpr int kAround_cells = 10;
// Of the lesser to the greater spread of cells: below it is a line.
constexpr double kLine = 0.15;
constexpr int kNear_cells = 2;
constexpr int kThick_cells = 4;  // of a wall, at most
constexpr std::uint8_t kFreeFrom = 192;
// What a look tells, read backwards, of what was known before: of less the particles tell chance.
constexpr double kLeastWorth = 0.25;
// Where the place is known roughly, how far n particles may have the spread too small by chance:
// sigmas of sqrt(2 / n).
constexpr double kChanceSigmas = 1.5;
// One sigma of where in its cells a wall lies.
const double kInCell = 1 / std::sqrt(12.0);
constexpr int kBlock_cells = 16;
// A ray goes through a wall when it ends farther behind it than the pose and the map may be off.
constexpr double kBehind_m = 0.5;

}  // namespace

struct MatchedMap {
    OccupancyMap map;
    /// Seen from the map's corner: MRPT moves a corner to a multiple of the cell.
    std::shared_ptr<LikelihoodField> grid;

    /// By block of cells, whether one of them is occupied: most of a ray's way leads through air.
    std::vector<bool> blocks;
    int block_columns = 0;

    void find_blocks() {
        block_columns = (map.columns + kBlock_cells - 1) / kBlock_cells;
        const int block_rows = (map.rows + kBlock_cells - 1) / kBlock_cells;
        blocks.assign(static_cast<std::size_t>(block_columns * block_rows), false);
        for (int row = 0; row < map.rows; ++row) {
            for (int column = 0; column < map.columns; ++column) {
                if (map.occupied(column, row)) blocks[block_of(column, row)] = true;
            }
        }
    }
    std::size_t block_of(int column, int row) const {
        return static_cast<std::size_t>((row / kBlock_cells) * block_columns +
                                        column / kBlock_cells);
    }

    /// Whether something stands on the way, but for its ends. Half a cell at least: a ray that
    /// grazes a wall only cuts its corners.
    bool has_something_between(Point2 from, Point2 to) const {
        const double way_m = distance(from, to) - kBehind_m;
        const double step_m = map.cell_m / 2;
        // In cells from the map's corner.
        const Point2 start = (1 / map.cell_m) * (from - map.corner);
        const Point2 step = (0.5 / distance(from, to)) * (to - from);
        bool before = false;
        for (int i = 1; i * step_m < way_m; ++i) {
            const Point2 at = start + static_cast<double>(i) * step;
            if (at.x_m < 0 || at.y_m < 0 || at.x_m >= map.columns || at.y_m >= map.rows) {
                before = false;
                continue;
            }
            const auto column = static_cast<int>(at.x_m);
            const auto row = static_cast<int>(at.y_m);
            if (!blocks[block_of(column, row)]) {
                i += std::max(0, static_cast<int>(steps_left_in_block(at, step)) - 1);
                before = false;
                continue;
            }
            const bool here = map.occupied(column, row);
            if (here && before) return true;
            before = here;
        }
        return false;
    }

    /// Until the next block begins, `at` and `step` in cells. Along an axis that the ray does not
    /// follow none does: then as many as lead through a whole block along the other.
    static double steps_left_in_block(Point2 at, Point2 step) {
        constexpr double kMost = 2 * kBlock_cells;
        const auto along = [](double from, double by) {
            const double edge = kBlock_cells * (std::floor(from / kBlock_cells) + (by > 0 ? 1 : 0));
            return by == 0 ? kMost : (edge - from) / by;
        };
        return std::min({along(at.x_m, step.x_m), along(at.y_m, step.y_m), kMost});
    }

    /// What was met before, by cell: a vehicle that passes meets the same again and again.
    mutable std::map<std::pair<int, int>, std::optional<Met>> met;

    /// Nothing: nothing stands there.
    const std::optional<Met>& met_at(Point2 place) const {
        const Point2 in = place - map.corner;
        const auto column = static_cast<int>(std::floor(in.x_m / map.cell_m));
        const auto row = static_cast<int>(std::floor(in.y_m / map.cell_m));
        const auto [known, added] = met.try_emplace({column, row});
        if (added) known->second = met_in(column, row);
        return known->second;
    }

    std::optional<Met> met_in(int column, int row) const {
        double count = 0;
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
        for (int r = std::max(0, row - kAround_cells);
             r <= std::min(map.rows - 1, row + kAround_cells); ++r) {
            for (int c = std::max(0, column - kAround_cells);
                 c <= std::min(map.columns - 1, column + kAround_cells); ++c) {
                if (!map.occupied(c, r)) continue;
                const Eigen::Vector2d cell(c - column, r - row);
                ++count;
                sum += cell;
                squares += cell * cell.transpose();
            }
        }
        if (count == 0) return std::nullopt;
        const Eigen::Matrix2d spread = squares / count - sum * sum.transpose() / (count * count);
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> shape(spread);
        const double lesser = shape.eigenvalues()[0];
        const double greater = shape.eigenvalues()[1];
        const double along = greater > 0 ? lesser / greater : 1;
        const Point2 middle =
            map.middle_of(column, row) + (map.cell_m / count) * Point2{sum.x(), sum.y()};
        return Met{shape.eigenvectors(), {1, along < kLine ? 0 : along}, middle};
    }

    bool has_something_near(Point2 place) const {
        const Point2 in = place - map.corner;
        const auto column = static_cast<int>(std::floor(in.x_m / map.cell_m));
        const auto row = static_cast<int>(std::floor(in.y_m / map.cell_m));
        for (int r = std::max(0, row - kNear_cells); r <= std::min(map.rows - 1, row + kNear_cells);
             ++r) {
            for (int c = std::max(0, column - kNear_cells);
                 c <= std::min(map.columns - 1, column + kNear_cells); ++c) {
                if (map.occupied(c, r)) return true;
            }
        }
        return false;
    }
};

namespace {

/// Noise puts some rays' ends into cells behind the face of a wall, which no ray passes through and
/// which stay occupied: with these, all walls would seem to lie half a cell farther off.
bool is_behind_a_face(const OccupancyMap& map, int column, int row) {
    constexpr std::pair<int, int> kTowards[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    const auto is_inside = [&](int c, int r) {
        return c >= 0 && c < map.columns && r >= 0 && r < map.rows;
    };
    const auto steps_to_free = [&](const std::pair<int, int>& towards) {
        for (int step = 1; step <= kThick_cells; ++step) {
            const int c = column + step * towards.first;
            const int r = row + step * towards.second;
            if (!is_inside(c, r)) return 0;
            if (map.at(c, r) >= kFreeFrom) return step;
            if (!map.occupied(c, r)) return 0;
        }
        return 0;
    };
    bool behind = false;
    for (const auto& towards : kTowards) {
        const int steps = steps_to_free(towards);
        if (steps == 1) return false;
        behind |= steps > 1;
    }
    return behind;
}

}  // namespace

std::shared_ptr<const MatchedMap> prepare(OccupancyMap map) {
    auto matched = std::make_shared<MatchedMap>();
    matched->grid = std::make_shared<LikelihoodField>(
        0.0F, static_cast<float>(map.columns * map.cell_m), 0.0F,
        static_cast<float>(map.rows * map.cell_m), static_cast<float>(map.cell_m));
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            const bool is_face = map.occupied(column, row) && !is_behind_a_face(map, column, row);
            const Point2 middle = map.middle_of(column, row) - map.corner;
            matched->grid->setPos(static_cast<float>(middle.x_m), static_cast<float>(middle.y_m),
                                  is_face ? 0.0F : 1.0F);
        }
    }
    auto& likelihood = matched->grid->likelihoodOptions;
    likelihood.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
    likelihood.LF_stdHit = kRaySigma_m;
    likelihood.LF_zHit = 1 - kByChance;
    likelihood.LF_zRandom = kByChance;
    likelihood.LF_maxCorrsDistance = kWithin_m;
    likelihood.LF_decimation = 1;
    likelihood.enableLikelihoodCache = false;  // LikelihoodField keeps them
    matched->map = std::move(map);
    matched->find_blocks();
    return matched;
}

struct MonteCarlo::Particles {
    std::shared_ptr<const MatchedMap> map;
    ParticleCloud cloud;
    std::size_t rough_looks = 0;  // each by other rays
};

MonteCarlo::MonteCarlo(std::shared_ptr<const MatchedMap> map, std::uint64_t seed)
    : particles_(new Particles{map, ParticleCloud(map->grid, seed)}) {}

MonteCarlo::~MonteCarlo() = default;
MonteCarlo::MonteCarlo(MonteCarlo&&) noexcept = default;

namespace {

/// What one look has made of its particles.
struct Outcome {
    geometry::Pose2 about;
    Eigen::Matrix3d looked_around;  // covariance that they were drawn with
    geometry::Pose2 mean;
    double particles = 0;                  // that carried weight
    Eigen::Matrix3d information;           // inverse covariance of what the rays tell
    Eigen::Matrix3d by_particles;          // the same as these have it
    std::vector<Eigen::Vector3d> by_wall;  // how they answer to one sigma of each wall's own error
    Eigen::Matrix3d of_map;                // what all of it is off, covariance
};

/// Bayes' rule, read backwards: what took the place from where the particles were drawn to their
/// mean. Only in directions in which the map is better than what was `known`, a covariance.
MonteCarlo::Told read_backwards(const Outcome& by, const Eigen::Matrix3d& known) {
    const Eigen::Matrix3d root = known.llt().matrixL();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> worth(root.transpose() * by.information *
                                                               root);
    // In directions of the hall along which the rays' worth is independent, `known` a unit sphere.
    const Eigen::Matrix3d directions = root * worth.eigenvectors();
    const Eigen::Matrix3d to_sphere = directions.inverse();
    const Eigen::Vector3d moved(by.mean.x_m - by.about.x_m, by.mean.y_m - by.about.y_m,
                                wrap(by.mean.heading_rad - by.about.heading_rad));
    const Eigen::Matrix3d drawn = directions.transpose() * by.looked_around.inverse() * directions;
    const Eigen::Matrix3d map = to_sphere * by.of_map * to_sphere.transpose();
    Eigen::Vector3d gain = worth.eigenvalues();
    for (int i = 0; i < 3; ++i) {
        // A column before a wall has corners, which tell little where rays are far apart.
        const double seen = directions.col(i).dot(by.by_particles * directions.col(i));
        gain[i] = std::min(gain[i], std::max(seen, 0.0));
    }
    Eigen::Vector3d of_walls = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& wall : by.by_wall) {
        of_walls += Eigen::Vector3d(directions.transpose() * wall).cwiseAbs2();
    }
    const Eigen::Vector3d off = (drawn + Eigen::Matrix3d(gain.asDiagonal())) * to_sphere * moved;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    Eigen::Vector3d variance = Eigen::Vector3d::Constant(kNothing);
    Eigen::Vector3d of_map = Eigen::Vector3d::Zero();
    MonteCarlo::Told told;
    told.everything = true;
    for (int i = 0; i < 3; ++i) {
        const double off_by_map =
            gain[i] > 0 ? of_walls[i] / square(gain[i]) + map(i, i) : kNothing;
        if (off_by_map > 1 || gain[i] < kLeastWorth) {
            told.everything = false;
            continue;
        }
        place[i] = off[i] / gain[i];
        of_map[i] = off_by_map;
        // The mean of so many particles is off by chance, and more so read backwards.
        const double chance = (drawn(i, i) + gain[i]) / (square(gain[i]) * by.particles);
        variance[i] = 1 / gain[i] + chance + off_by_map;
        told.anything = true;
    }
    const Eigen::Vector3d at = directions * place;
    told.pose = {by.about.x_m + at[0], by.about.y_m + at[1], wrap(by.about.heading_rad + at[2])};
    told.covariance = directions * variance.asDiagonal() * directions.transpose();
    told.of_map = directions * of_map.asDiagonal() * directions.transpose();
    return told;
}

/// How a point of the hall moves with the pose of a body that it is fixed to.
Eigen::Matrix<double, 2, 3> by_pose(const Pose2& pose, Point2 place) {
    const Point2 arm = place - pose.position();
    Eigen::Matrix<double, 2, 3> moves;
    moves << 1, 0, -arm.y_m, 0, 1, arm.x_m;
    return moves;
}

Pose2 moved(const Pose2& pose, Point2 by) {
    return {pose.x_m + by.x_m, pose.y_m + by.y_m, pose.heading_rad};
}

/// Every so many rays of each scan, from `first` on.
std::vector<control::Scan> thinned(const std::vector<control::Scan>& scans, std::size_t every,
                                   std::size_t first) {
    std::vector<control::Scan> thin;
    for (const control::Scan& scan : scans) {
        thin.push_back({scan.body_from_sensor,
                        scan.first_rad + static_cast<double>(first) * scan.step_rad,
                        static_cast<double>(every) * scan.step_rad,
                        {},
                        scan.blind});
        for (std::size_t i = first; i < scan.ranges_m.size(); i += every) {
            thin.back().ranges_m.push_back(scan.ranges_m[i]);
        }
    }
    return thin;
}

/// visit(sensor, end) for each ray that met something.
template <class Visit>
void visit_ends(const Pose2& pose, const std::vector<control::Scan>& scans, Visit visit) {
    for (const control::Scan& scan : scans) {
        const Pose2 sensor = pose * scan.body_from_sensor;
        control::visit_ends(scan, sensor, [&](Point2 end) { visit(sensor.position(), end); });
    }
}

/// What the particles have learned, at least: few of them may lie near each other by chance
/// (`sigmas` of it), and looks that were believed for it would add up to a place that nothing has
/// told.
Eigen::Matrix3d seen_by(const ParticleCloud::Told& told, const Eigen::Matrix3d& drawn,
                        double sigmas) {
    const double by_chance = 1 + sigmas * std::sqrt(2 / told.carrying);
    return (by_chance * told.covariance).inverse() - drawn.inverse();
}

}  // namespace

MonteCarlo::Look MonteCarlo::look(const Pose2& about, const Eigen::Matrix3d& covariance,
                                  const Eigen::Matrix3d& around, const Eigen::Matrix3d& of_map,
                                  const std::vector<control::Scan>& scans) {
    const Eigen::Matrix3d drawn = covariance + around;
    const MatchedMap& map = *particles_->map;
    const bool well_known = ParticleCloud::is_well_known(drawn);
    const std::size_t every = well_known ? kEveryRay : kEveryRayRoughly;
    const auto rays = thinned(scans, every, well_known ? 0 : particles_->rough_looks++ % every);
    const Point2 corner = map.map.corner;
    const auto told = particles_->cloud.look({moved(about, -1.0 * corner), drawn}, rays);
    const Pose2 mean = moved(told.mean, corner);
    Look look;
    int explained = 0;
    int through = 0;
    Surfaces surfaces;
    visit_ends(mean, rays, [&](Point2 sensor, Point2 end) {
        ++look.returns;
        through += map.has_something_between(sensor, end);
        if (!map.has_something_near(end)) return;
        ++explained;
        if (const auto& met = map.met_at(end)) surfaces.add(*met, by_pose(mean, end));
    });
    const double one_ray = told.power / square(kRaySigma_m);
    Outcome outcome{about,
                    drawn,
                    mean,
                    told.carrying,
                    one_ray * surfaces.information(),
                    seen_by(told, drawn, well_known ? 0 : kChanceSigmas),
                    surfaces.answers(),
                    of_map};
    for (auto& wall : outcome.by_wall) wall *= one_ray * kInCell * map.map.cell_m;
    look.news = read_backwards(outcome, covariance);
    look.check = read_backwards(outcome, drawn);
    if (look.returns > 0) {
        look.explained = static_cast<double>(explained) / look.returns;
        look.through = static_cast<double>(through) / look.returns;
    }
    return look;
}

}  // namespace pulseline::mapping
