#include "core/planning/manoeuvre/manoeuvre_path.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace pulseline::planning {
namespace {

using geometry::Pose2;

constexpr double kGain_m = 0.01;  // less is not worth a change
constexpr double kNoMove = 1e-7;  // a rest of a move that is no move any more

/// A place on the path: so far into a move.
struct Place {
    std::size_t move = 0;
    double share = 0;
};

std::vector<Pose2> corners(const Pose2& start, const Moves& moves) {
    std::vector<Pose2> at{start};
    for (const Move& move : moves) at.push_back(moved(at.back(), move));
    return at;
}

Move piece(const Move& move, double share) {
    Move result = move;
    result.amount *= share;
    return result;
}

Moves spliced(const Moves& moves, const Place& from, const Place& to, const Way& way) {
    Moves result;
    const auto add = [&](const Move& move) {
        if (std::abs(move.amount) > 0) append(result, move);
    };
    for (std::size_t i = 0; i < from.move; ++i) add(moves[i]);
    if (from.share > 0) add(piece(moves[from.move], from.share));
    for (int i = 0; i < way.count; ++i) add(way.moves[static_cast<std::size_t>(i)]);
    if (to.move < moves.size()) add(piece(moves[to.move], 1 - to.share));
    for (std::size_t i = to.move + 1; i < moves.size(); ++i) add(moves[i]);
    return result;
}

class Shortening {
public:
    Shortening(const ManoeuvreTask& task, Moves moves) : task_(task), moves_(std::move(moves)) {
        measure();
    }

    bool join(const Place& from, const Place& to) {
        const Pose2 a = pose_at(from);
        const Pose2 b = pose_at(to);
        task_.steering.ways(a, b, ways_);
        task_.room.add_work(kWaysWork);
        for (std::size_t i = 0; i < std::min(kWaysTried, ways_.size()); ++i) {
            Moves joined = spliced(moves_, from, to, ways_[i]);
            if (cost_m(task_.steering, joined) > cost_ - kGain_m) continue;
            if (!task_.room.is_free(a, ways_[i])) continue;
            moves_ = std::move(joined);
            measure();
            return true;
        }
        return false;
    }

    void join_corners() {
        for (bool again = true; again;) {
            again = false;
            for (std::size_t i = 0; i < moves_.size() && !again; ++i) {
                for (std::size_t k = moves_.size(); k > i + 1 && !again; --k) {
                    again = join({i, 0}, {k, 0});
                }
            }
        }
    }

    /// Place so far along the path, by cost without stops.
    Place place(double along_m) const {
        for (std::size_t i = 0; i < moves_.size(); ++i) {
            const double own = task_.steering.cost_m(moves_[i]);
            if (along_m < own) {
                const double share = along_m / own;
                return share * std::abs(moves_[i].amount) < kNoMove ? Place{i, 0} : Place{i, share};
            }
            along_m -= own;
        }
        return {moves_.size(), 0};
    }

    double length_m() const { return length_; }
    Moves take() { return std::move(moves_); }

private:
    Pose2 pose_at(const Place& place) const {
        if (place.move == moves_.size()) return task_.goal;
        return place.share > 0 ? moved(corners_[place.move], moves_[place.move], place.share)
                               : corners_[place.move];
    }
    void measure() {
        corners_ = corners(task_.start, moves_);
        cost_ = cost_m(task_.steering, moves_);
        length_ = 0;
        for (const Move& move : moves_) length_ += task_.steering.cost_m(move);
    }

    const ManoeuvreTask& task_;
    Moves moves_;
    std::vector<Pose2> corners_;
    std::vector<Way> ways_;
    double cost_ = 0;
    double length_ = 0;
};

}  // namespace

bool same_motion(const Move& a, const Move& b) {
    return a.kind == b.kind && (a.amount > 0) == (b.amount > 0) && a.curvature == b.curvature &&
           a.direction_rad == b.direction_rad;
}

void append(Moves& moves, const Move& move) {
    if (!moves.empty() && same_motion(moves.back(), move)) {
        moves.back().amount += move.amount;
    } else {
        moves.push_back(move);
    }
}

Moves reversed(const Moves& moves) {
    Moves result(moves.rbegin(), moves.rend());
    for (Move& move : result) move.amount = -move.amount;
    return result;
}

double cost_m(const Steering& steering, const Moves& moves) {
    double sum = 0;
    for (const Move& move : moves) sum += steering.cost_m(move);
    return moves.empty() ? 0 : sum + Steering::kStop_m * static_cast<double>(moves.size() - 1);
}

Moves shortened(const ManoeuvreTask& task, Moves moves, int rounds, std::uint64_t seed) {
    Shortening path(task, std::move(moves));
    path.join_corners();
    std::mt19937_64 random(seed);
    // std::uniform_real_distribution differs between standard libraries.
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (int i = 0; i < rounds; ++i) {
        double a = uniform() * path.length_m();
        double b = uniform() * path.length_m();
        if (a > b) std::swap(a, b);
        if (i % 4 == 0) a = 0;
        if (i % 4 == 1) b = path.length_m();
        path.join(path.place(a), path.place(b));
    }
    path.join_corners();
    return path.take();
}

}  // namespace pulseline::planning
