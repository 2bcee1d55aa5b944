#pragma once

#include "core/planning/grid/grid_search.hpp"
#include "core/planning/grid/label_table.hpp"
#include "core/planning/grid/small_cost.hpp"
#include "core/planning/search/bucket_queue.hpp"

namespace pulseline::planning {

/// Turn-jump search: A* over turning points only, exact for the direction-penalised cost
/// k_same x length + P x turns with P = k_diff - k_same >= 0 on a uniform map (4-connected, every
/// free cell may be entered, left and turned in alike). See README.md.
///
/// A *leg* is a straight run in direction e, entered at p from a leg in direction d across it.
/// Among the paths of least cost take one with fewest turns, of those one with least length, of
/// those the one whose leg lengths are lexicographically smallest. Claims about each of its legs
/// but the first and the last:
///   1. Some cell beside it, on the side the vehicle came from (-d), is blocked. Else the whole leg
///      could slide one cell towards -d: the leg before gets one shorter (and if it vanishes, two
///      turns become at most one: from the leg or heading before it straight into e), the leg after
///      one longer (f = d), or one shorter (f = -d). The cost does not rise, and the path comes
///      earlier in the order: a contradiction.
///   2. The turn that ends it lies at or behind the first such cell. Else the part driven of it has
///      no blocked cell beside it, as in 1.
/// U-turns never pay but as the first turn from a given heading. So after a turn at p from d to e:
///   - the turn is *useful* only if the free ray from p along e has a blocked cell on its -d side,
///     or the goal lies on the ray: one bit per cell, heading and side (TurnPlanes);
///   - the candidates for the next turn are the useful cells from the first such blocked cell to
///     the end of the ray: found 64 cells at a time by ctz/clz over the bit planes;
///   - whether the goal lies on a ray, or on a ray across it, is one comparison with the four
///     free runs around the goal, found once per query.
/// What may follow depends on (p, e, side of d) alone. Hence along the path chosen above every leg
/// is generated once its predecessor is, and it is enough to keep per (p, e) the least cost and the
/// sides reached with it: an entry of higher cost, or of equal cost and the same side, is dropped.
/// The same argument lets an entry be dropped when an expanded ray of the same direction and side
/// runs through its place at no higher cost: that ray began behind it, so its first blocked cell is
/// not later, and it has generated all that the entry would.
///
/// Bound: k_same x max(Manhattan, landmarks) + P x least turns on an empty floor; both parts are
/// consistent.
class TurnJumpSearch {
public:
    /// Goes over plain cells only: on a map that is not uniform, what it finds may cost more than
    /// the least. kUnfit when the other conditions above do not hold or costs leave 30 bits.
    SearchEnd run(const GridMap& map, const GridRequest& request, GridRoute& route);
    void prepare(const GridMap& map);
    std::size_t bytes() const;

    /// What the last query took, in expansions of the bucket search that take as long.
    std::int64_t work() const { return 2 * popped_ + turns_seen_ * 3 / 2; }
    /// Queries end as cancelled soon after they took so much.
    void limit_work(std::int64_t most) { most_work_ = most; }

private:
    /// Which line beside a leg the vehicle came from.
    enum Side : std::uint8_t { kLesser = 0, kGreater = 1, kNoSide = 2 };
    struct Entry {
        std::uint32_t cost;
        std::uint16_t col;  // padded
        std::uint16_t row;
        std::uint16_t resume;  // position on the ray where its candidates go on; 0: from its start
        std::uint8_t heading;
        Side side;
    };
    /// The last ray expanded in a line, by heading and side.
    struct Ray {
        std::uint32_t stamp = 0;
        std::int32_t base = 0;  // cost at position 0, were it driven from there
        std::uint16_t begin = 0;
        std::uint16_t end = 0;
    };
    /// Free cells around the goal along one axis, both ends included.
    struct Run {
        int line;
        int goal;
        int first;
        int last;
        bool covers(int on_line, int position) const {
            return on_line == line && position >= first && position <= last;
        }
    };

    void begin(const GridMap& map, const GridRequest& request, const SmallCost& cost);
    void enter(const GridRequest& request);
    void expand(const Entry& entry);
    template <bool kUp>
    void expand_ray(const Entry& entry, int line, int position);
    template <bool kUp>
    void drive_ray(const Entry& entry, int line, int position);
    template <bool kUp>
    void turn_off(const Entry& entry, int line, int position, int first, int end);
    void generate(const Entry& from, int col, int row, int heading, std::uint32_t cost,
                  std::uint32_t way);
    bool covered(const Entry& entry, int line, int position) const;
    void arrive(std::uint32_t cost, const Entry& from, Cell corner);
    void trace(const GridRequest& request, GridRoute& route) const;

    std::uint32_t steps_left(int col, int row) const;
    std::uint32_t turns_left(int col, int row, int heading) const;
    std::uint32_t state(int col, int row, int heading) const {
        return (static_cast<std::uint32_t>(row) * stride_ + static_cast<std::uint32_t>(col)) *
                   kDirections +
               static_cast<std::uint32_t>(heading);
    }
    Cell cell_of(std::uint32_t state) const;

    // Scratch that lives on.
    LabelTable labels_;
    std::vector<Ray> rays_;
    BucketQueue<Entry> queue_;
    std::uint32_t stamp_ = 0;

    // The query.
    const TurnPlanes* planes_ = nullptr;
    const Landmarks* landmarks_ = nullptr;
    const Landmarks::Ways* goal_ways_ = nullptr;
    std::uint32_t stride_ = 0;
    std::uint32_t ray_lines_ = 0;
    std::uint32_t step_ = 0;
    std::uint32_t turn_ = 0;
    Cell goal_;  // padded
    Run goal_runs_[2];
    std::uint32_t expanding_ = 0;  // greatest bound in the bucket that is being emptied
    std::uint32_t best_ = 0;       // cost of the best route found so far
    std::uint32_t last_state_ = 0;
    Cell last_corner_;  // its turn onto the goal's line; the goal itself when there is none
    std::int64_t expanded_ = 0;
    std::int64_t popped_ = 0;
    std::int64_t turns_seen_ = 0;
    std::int64_t most_work_ = std::numeric_limits<std::int64_t>::max();
};

}  // namespace pulseline::planning
