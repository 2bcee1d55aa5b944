#include "core/traffic/monitor.hpp"

#include <algorithm>
#include <limits>
#include <set>

namespace pulseline::traffic {
namespace {

constexpr VehicleIndex kNobody = std::numeric_limits<VehicleIndex>::max();

}  // namespace

std::string to_string(const Violation& violation) {
    return violation.law + ": vehicle " + std::to_string(violation.vehicle) + ", move " +
           std::to_string(violation.move) + ", other vehicle " + std::to_string(violation.other) +
           ", tile " + std::to_string(violation.tile);
}

std::vector<Monitor::Tile> Monitor::tiles(const TileSet& set) {
    std::vector<Tile> numbers;
    numbers.reserve(set.size());
    for (const TileId id : set) {
        const auto [it, is_new] =
            tile_numbers_.try_emplace(id, static_cast<Tile>(tile_ids_.size()));
        if (is_new) {
            tile_ids_.push_back(id);
            owners_.emplace_back();
            closures_.push_back(0);
        }
        numbers.push_back(it->second);
    }
    return numbers;
}

void Monitor::take(VehicleIndex vehicle, MoveNumber move, const std::vector<Tile>& tiles,
                   std::vector<Violation>& found) {
    for (const Tile tile : tiles) {
        Owner& owner = owners_[tile];
        if (owner.count > 0 && owner.vehicle != vehicle) {
            found.push_back({"two_holders", vehicle, move, owner.vehicle, tile_ids_[tile]});
            continue;
        }
        owner.vehicle = vehicle;
        ++owner.count;
    }
}

void Monitor::drop(VehicleIndex vehicle, const std::vector<Tile>& tiles) {
    for (const Tile tile : tiles) {
        Owner& owner = owners_[tile];
        if (owner.vehicle == vehicle && owner.count > 0) --owner.count;
    }
}

void Monitor::on_stand(const Change& change, std::vector<Violation>& found) {
    if (change.vehicle >= bodies_.size()) bodies_.resize(change.vehicle + 1);
    Body& body = bodies_[change.vehicle];
    drop(change.vehicle, body.stand);
    for (MoveNumber n = body.passed + 1; n <= body.granted; ++n) {
        drop(change.vehicle, body.step(n).swept);
    }
    body.stand = tiles(change.tiles);
    body.steps.clear();
    body.passed = body.granted = change.number;
    take(change.vehicle, change.number, body.stand, found);
}

void Monitor::on_plan(const Change& change, std::vector<Violation>& found) {
    Body& body = bodies_[change.vehicle];
    if (change.number != body.granted) {
        found.push_back({"base_changed", change.vehicle, change.number, change.vehicle, 0});
        for (MoveNumber n = std::max(body.passed, change.number) + 1; n <= body.granted; ++n) {
            drop(change.vehicle, body.step(n).swept);
        }
        body.granted = std::max(body.passed, std::min(change.number, body.granted));
    }
    body.steps.resize(body.granted - body.passed);
    for (const auto& move : change.moves) {
        body.steps.push_back({tiles(move.swept), tiles(move.stand), move.waits_for});
    }
}

void Monitor::on_granted(const Change& change, std::vector<Violation>& found) {
    Body& body = bodies_[change.vehicle];
    if (change.number > body.end()) {
        found.push_back({"unknown_move", change.vehicle, change.number, 0, 0});
    }
    if (body.halted) found.push_back({"granted_halted", change.vehicle, change.number, 0, 0});
    for (MoveNumber n = body.granted + 1; n <= std::min(change.number, body.end()); ++n) {
        const Step& step = body.step(n);
        take(change.vehicle, n, step.swept, found);
        for (const MoveRef& ref : step.waits_for) {
            if (ref.move == kForever || bodies_[ref.vehicle].passed < ref.move) {
                found.push_back({"granted_out_of_order", change.vehicle, n, ref.vehicle, 0});
            }
        }
        const auto closed = [&](Tile tile) { return closures_[tile] > 0; };
        const auto& from = n == body.passed + 1 ? body.stand : body.step(n - 1).stand;
        const auto tile = std::find_if(step.swept.begin(), step.swept.end(), closed);
        if (tile != step.swept.end() && std::none_of(from.begin(), from.end(), closed)) {
            found.push_back({"granted_closed", change.vehicle, n, 0, tile_ids_[*tile]});
        }
    }
    body.granted = std::min(change.number, body.end());
}

void Monitor::on_passed(const Change& change, std::vector<Violation>& found) {
    Body& body = bodies_[change.vehicle];
    if (change.number > body.granted) {
        found.push_back({"passed_ungranted", change.vehicle, change.number, 0, 0});
        return;
    }
    while (body.passed < change.number) {
        const Step step = body.steps.front();
        body.steps.erase(body.steps.begin());
        ++body.passed;
        // The new stand is held on before the old floor is given up.
        take(change.vehicle, body.passed, step.stand, found);
        drop(change.vehicle, step.swept);
        drop(change.vehicle, body.stand);
        body.stand = step.stand;
    }
}

std::vector<Violation> Monitor::apply(const std::vector<Change>& changes) {
    changed_ = changed_ || !changes.empty();
    std::vector<Violation> found;
    std::set<VehicleIndex> replanned;
    for (const Change& change : changes) {
        switch (change.kind) {
            case Change::Kind::kStand:
                on_stand(change, found);
                break;
            case Change::Kind::kPlan:
                on_plan(change, found);
                replanned.insert(change.vehicle);
                break;
            case Change::Kind::kWaits:
                for (const auto& move : change.moves) {
                    Body& body = bodies_[change.vehicle];
                    if (move.number <= body.passed || move.number > body.end()) {
                        found.push_back({"unknown_move", change.vehicle, move.number, 0, 0});
                    } else {
                        body.step(move.number).waits_for = move.waits_for;
                    }
                }
                break;
            case Change::Kind::kReleased:
                on_granted(change, found);
                break;
            case Change::Kind::kPassed:
                on_passed(change, found);
                break;
            case Change::Kind::kHalted:
                bodies_[change.vehicle].halted = true;
                break;
            case Change::Kind::kResumed:
                bodies_[change.vehicle].halted = false;
                break;
            case Change::Kind::kClosed:
                for (const Tile tile : tiles(change.tiles)) ++closures_[tile];
                break;
            case Change::Kind::kReopened:
                for (const Tile tile : tiles(change.tiles)) --closures_[tile];
                break;
        }
    }
    for (const VehicleIndex vehicle : replanned) {
        if (on_cycle(vehicle)) found.push_back({"cycle", vehicle, 0, vehicle, 0});
    }
    return found;
}

std::vector<Violation> Monitor::check_footprint(VehicleIndex vehicle,
                                                const TileSet& footprint) const {
    std::vector<Violation> found;
    for (const TileId id : footprint) {
        const auto it = tile_numbers_.find(id);
        const Owner owner = it == tile_numbers_.end() ? Owner{} : owners_[it->second];
        if (owner.count > 0 && owner.vehicle == vehicle) continue;
        const VehicleIndex other = owner.count > 0 ? owner.vehicle : vehicle;
        found.push_back({"footprint_outside", vehicle, bodies_[vehicle].passed, other, id});
    }
    return found;
}

/// Looks for a way back to a move of the vehicle from a later one of it, against the edges.
bool Monitor::on_cycle(VehicleIndex vehicle) const {
    // Per vehicle the greatest move known to come before; earlier ones come before it anyway.
    std::vector<MoveNumber> before;
    before.reserve(bodies_.size());
    for (const Body& any : bodies_) before.push_back(any.granted);
    const Body& body = bodies_[vehicle];
    for (MoveNumber n = body.granted + 1; n <= body.end(); ++n) {
        std::vector<MoveRef> open = body.step(n).waits_for;
        while (!open.empty()) {
            const MoveRef ref = open.back();
            open.pop_back();
            if (ref.move == kForever) continue;
            if (ref.vehicle == vehicle) {
                if (ref.move >= n) return true;
                continue;
            }
            const Body& other = bodies_[ref.vehicle];
            MoveNumber& known = before[ref.vehicle];
            for (MoveNumber m = known + 1; m <= std::min(ref.move, other.end()); ++m) {
                const auto& waits = other.step(m).waits_for;
                open.insert(open.end(), waits.begin(), waits.end());
            }
            known = std::max(known, ref.move);
        }
    }
    return false;
}

bool Monitor::number_moves(std::vector<std::vector<std::int64_t>>& numbers,
                           Violation& cycle) const {
    // Repeatedly takes off moves that nothing is left before (Kahn 1962).
    struct Link {
        VehicleIndex vehicle;
        MoveNumber move;
    };
    std::vector<std::vector<std::vector<Link>>> after(bodies_.size());
    std::vector<std::vector<int>> missing(bodies_.size());
    std::vector<Link> ready;
    numbers.assign(bodies_.size(), {});
    for (VehicleIndex v = 0; v < bodies_.size(); ++v) {
        after[v].resize(bodies_[v].steps.size());
        missing[v].assign(bodies_[v].steps.size(), 0);
        numbers[v].assign(bodies_[v].steps.size(), -1);
    }
    const auto index = [&](VehicleIndex v, MoveNumber n) { return n - bodies_[v].passed - 1; };
    for (VehicleIndex v = 0; v < bodies_.size(); ++v) {
        const Body& body = bodies_[v];
        for (MoveNumber n = body.passed + 1; n <= body.end(); ++n) {
            int& count = missing[v][index(v, n)];
            if (n > body.passed + 1) {
                after[v][index(v, n - 1)].push_back({v, n});
                ++count;
            }
            if (n > body.granted) {
                for (const MoveRef& ref : body.step(n).waits_for) {
                    if (ref.move == kForever || ref.move <= bodies_[ref.vehicle].passed ||
                        ref.move > bodies_[ref.vehicle].end()) {
                        continue;
                    }
                    after[ref.vehicle][index(ref.vehicle, ref.move)].push_back({v, n});
                    ++count;
                }
            }
            if (count == 0) ready.push_back({v, n});
        }
    }
    std::int64_t next = 0;
    while (!ready.empty()) {
        const Link link = ready.back();
        ready.pop_back();
        numbers[link.vehicle][index(link.vehicle, link.move)] = next++;
        for (const Link& other : after[link.vehicle][index(link.vehicle, link.move)]) {
            if (--missing[other.vehicle][index(other.vehicle, other.move)] == 0) {
                ready.push_back(other);
            }
        }
    }
    for (VehicleIndex v = 0; v < bodies_.size(); ++v) {
        for (std::size_t i = 0; i < numbers[v].size(); ++i) {
            if (numbers[v][i] >= 0) continue;
            cycle = {"cycle", v, bodies_[v].passed + 1 + static_cast<MoveNumber>(i), v, 0};
            return false;
        }
    }
    return true;
}

void Monitor::check_orders(const std::vector<std::vector<std::int64_t>>& numbers,
                           std::vector<Violation>& found) const {
    struct Stay {
        Tile tile;
        std::int64_t number;  // of its first move; -1: on the tile already
        VehicleIndex vehicle;
        MoveNumber first;
        MoveNumber last;
    };
    // A tile that one vehicle uses only has no order to claim: most are.
    std::vector<VehicleIndex> user(tile_ids_.size(), kNobody);
    std::vector<std::uint8_t> shared(tile_ids_.size(), 0);
    const auto uses = [&](VehicleIndex v, const std::vector<Tile>& tiles) {
        for (const Tile tile : tiles) {
            if (user[tile] != kNobody && user[tile] != v) shared[tile] = 1;
            user[tile] = v;
        }
    };
    for (VehicleIndex v = 0; v < bodies_.size(); ++v) {
        uses(v, bodies_[v].stand);
        for (const Step& step : bodies_[v].steps) uses(v, step.swept);
    }

    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::vector<Stay> stays;
    std::vector<std::size_t> newest(tile_ids_.size(), kNone);  // of stays, by tile
    const auto stay = [&](Tile tile, const Stay& begins) {
        newest[tile] = stays.size();
        stays.push_back(begins);
    };
    for (VehicleIndex v = 0; v < bodies_.size(); ++v) {
        const Body& body = bodies_[v];
        for (const Tile tile : body.stand) {
            if (shared[tile] != 0) stay(tile, {tile, -1, v, body.passed, kForever});
        }
        for (MoveNumber n = body.passed + 1; n <= body.end(); ++n) {
            const Step& step = body.step(n);
            for (const MoveRef& ref : step.waits_for) {
                // A vehicle without a plan may be in the way; one with a plan must not end there.
                const bool crossed = ref.move == kForever && !bodies_[ref.vehicle].steps.empty();
                if (crossed) found.push_back({"rest_crossed", ref.vehicle, kForever, v, 0});
            }
            const std::int64_t number = n <= body.granted ? -1 : numbers[v][n - body.passed - 1];
            for (const Tile tile : step.swept) {
                if (shared[tile] == 0) continue;
                const auto known = newest[tile];
                const bool still =
                    known != kNone && stays[known].vehicle == v && stays[known].last == kForever;
                if (!still) stay(tile, {tile, number, v, n, kForever});
                if (!std::binary_search(step.stand.begin(), step.stand.end(), tile)) {
                    stays[newest[tile]].last = n;
                }
            }
        }
    }
    std::stable_sort(stays.begin(), stays.end(), [](const Stay& a, const Stay& b) {
        return a.tile != b.tile ? a.tile < b.tile : a.number < b.number;
    });
    for (std::size_t i = 1; i < stays.size(); ++i) {
        const Stay& a = stays[i - 1];
        const Stay& b = stays[i];
        if (a.tile != b.tile || a.vehicle == b.vehicle || b.number < 0) continue;
        const auto& waits = bodies_[b.vehicle].step(b.first).waits_for;
        const bool ordered = std::any_of(waits.begin(), waits.end(), [&](const MoveRef& ref) {
            return ref.vehicle == a.vehicle && ref.move >= a.last;
        });
        if (!ordered) {
            found.push_back({"order_missing", b.vehicle, b.first, a.vehicle, tile_ids_[b.tile]});
        }
    }
}

std::vector<Violation> Monitor::check_all() const {
    std::vector<Violation> found;
    std::vector<VehicleIndex> holder(tile_ids_.size(), 0);
    std::vector<bool> held(tile_ids_.size(), false);
    const auto hold = [&](VehicleIndex v, MoveNumber n, const std::vector<Tile>& tiles) {
        for (const Tile tile : tiles) {
            if (held[tile] && holder[tile] != v) {
                found.push_back({"two_holders", v, n, holder[tile], tile_ids_[tile]});
            }
            held[tile] = true;
            holder[tile] = v;
        }
    };
    for (VehicleIndex v = 0; v < bodies_.size(); ++v) {
        const Body& body = bodies_[v];
        hold(v, body.passed, body.stand);
        for (MoveNumber n = body.passed + 1; n <= body.granted; ++n) hold(v, n, body.step(n).swept);
    }
    std::vector<std::vector<std::int64_t>> numbers;
    Violation cycle;
    if (!number_moves(numbers, cycle)) {
        found.push_back(cycle);
        return found;
    }
    check_orders(numbers, found);
    return found;
}

}  // namespace pulseline::traffic
