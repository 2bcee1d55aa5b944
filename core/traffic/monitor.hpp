#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/traffic/record.hpp"

namespace pulseline::traffic {

struct Violation {
    /// two_holders, footprint_outside, cycle, order_missing, rest_crossed, granted_out_of_order,
    /// granted_closed, granted_halted, base_changed, passed_ungranted, unknown_move
    std::string law;
    VehicleIndex vehicle = 0;
    MoveNumber move = 0;
    VehicleIndex other = 0;
    TileId tile = 0;
};
std::string to_string(const Violation& violation);

/// Watches the invariants S and D from outside. Knows traffic only by its changes and shares no
/// code with it (plain data aside), so that one mistake does not hide the other. On a violation the
/// owner stops granting. Thread safety: none.
class Monitor {
public:
    /// Takes in all changes of one call to traffic (in between, plans may contradict each other)
    /// and checks what they concern: holders of the tiles, order and closures at each grant,
    /// cycles through changed plans.
    std::vector<Violation> apply(const std::vector<Change>& changes);
    /// The vehicle reports a body on `tiles`: all must be floor it holds.
    std::vector<Violation> check_footprint(VehicleIndex vehicle, const TileSet& tiles) const;
    /// Everything from scratch: holders, cycles, and that for each tile the claimed order leaves no
    /// two stays unordered.
    std::vector<Violation> check_all() const;
    /// True once after changes came in: only then has check_all() anything new to look at.
    bool take_changed() { return std::exchange(changed_, false); }

private:
    using Tile = std::uint32_t;
    struct Step {
        std::vector<Tile> swept;
        std::vector<Tile> stand;
        std::vector<MoveRef> waits_for;
    };
    struct Body {
        std::vector<Tile> stand;
        MoveNumber passed = 0;
        MoveNumber granted = 0;
        std::vector<Step> steps;  // of moves passed + 1 ..
        bool halted = false;
        MoveNumber end() const { return passed + static_cast<MoveNumber>(steps.size()); }
        const Step& step(MoveNumber n) const { return steps[n - passed - 1]; }
        Step& step(MoveNumber n) { return steps[n - passed - 1]; }
    };
    struct Owner {
        VehicleIndex vehicle = 0;
        std::uint32_t count = 0;  // reasons to hold it: the stand and every granted move
    };

    std::vector<Tile> tiles(const TileSet& set);
    void take(VehicleIndex vehicle, MoveNumber move, const std::vector<Tile>& tiles,
              std::vector<Violation>& found);
    void drop(VehicleIndex vehicle, const std::vector<Tile>& tiles);
    void on_stand(const Change& change, std::vector<Violation>& found);
    void on_plan(const Change& change, std::vector<Violation>& found);
    void on_granted(const Change& change, std::vector<Violation>& found);
    void on_passed(const Change& change, std::vector<Violation>& found);
    /// Numbers of all moves in an order that agrees with the edges; false: there is a cycle.
    bool number_moves(std::vector<std::vector<std::int64_t>>& numbers, Violation& cycle) const;
    bool on_cycle(VehicleIndex vehicle) const;
    void check_orders(const std::vector<std::vector<std::int64_t>>& numbers,
                      std::vector<Violation>& found) const;

    std::unordered_map<TileId, Tile> tile_numbers_;
    std::vector<TileId> tile_ids_;
    std::vector<Body> bodies_;
    std::vector<Owner> owners_;  // by tile
    std::vector<int> closures_;  // by tile
    bool changed_ = true;
};

}  // namespace pulseline::traffic
