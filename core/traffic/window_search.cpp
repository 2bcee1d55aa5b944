#include "core/traffic/window_search.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::traffic {
namespace {

constexpr std::uint32_t kNoLabel = std::numeric_limits<std::uint32_t>::max();
// Weighted A* (Pohl 1970): the plan takes at most this times the soonest one's time from here on.
// Without it every short wait for somebody makes all ways of nearly equal length worth a look.
constexpr double kGreed = 1.25;
constexpr std::size_t kPatience = 1'000;  // labels; then twice as greedy, at twice as many again

}  // namespace

SearchResult WindowSearch::find(const JointPlan& joint, const SearchTask& task) {
    if (task.hopeless) {
        SearchResult hopeless;
        hopeless.obstacle = *task.hopeless;
        return hopeless;
    }
    start(joint, task);
    const auto later = [](const OpenEntry& a, const OpenEntry& b) {
        if (a.end_s != b.end_s) return a.end_s > b.end_s;
        if (a.left_s != b.left_s) return a.left_s > b.left_s;  // nearer to the goal first
        return a.label > b.label;
    };
    std::size_t patience = kPatience;
    while (!open_.empty()) {
        std::pop_heap(open_.begin(), open_.end(), later);
        const OpenEntry entry = open_.back();
        open_.pop_back();
        Label& label = labels_[entry.label];
        if (label.closed) continue;
        label.closed = true;
        if (is_end(label)) return result_from(entry.label);
        if (labels_.size() > task.most_labels) {
            SearchResult cut;
            cut.obstacle.cause = Obstacle::Cause::kSearchLimit;
            cut.labels = labels_.size();
            return cut;
        }
        if (labels_.size() > patience) {
            // Dense traffic: a plan soon is worth more than the soonest plan.
            patience *= 2;
            greed_ *= 2;
            for (OpenEntry& open : open_) open = entry_of(open.label);
            std::make_heap(open_.begin(), open_.end(), later);
        }
        const std::size_t first_new = labels_.size();
        expand(entry.label);
        for (std::size_t i = first_new; i < labels_.size(); ++i) {
            open_.push_back(entry_of(static_cast<std::uint32_t>(i)));
            std::push_heap(open_.begin(), open_.end(), later);
        }
    }
    SearchResult nothing;
    nothing.obstacle = obstacle_;
    nothing.labels = labels_.size();
    return nothing;
}

void WindowSearch::start(const JointPlan& joint, const SearchTask& task) {
    joint_ = &joint;
    task_ = &task;
    ++stamp_;
    graph_places_ = task.graph ? task.graph->places.size() : 0;
    labels_.clear();
    open_.clear();
    pool_.clear();
    busy_.clear();
    obstacle_ = {};
    obstacle_bound_s_ = kEver_s;

    // The start is the first place behind the graph's; each sequence adds a place per step.
    steps_.assign(1, {});
    own_stands_.assign(1, &task.start_stand);
    own_ends_.assign(1, false);
    for (const FixedSequence& sequence : task.sequences) {
        std::size_t from = 0;
        for (std::size_t i = 0; i < sequence.steps.size(); ++i) {
            const bool into_graph = i + 1 == sequence.steps.size() && sequence.ends_at != kNoPlace;
            if (into_graph) {
                steps_[from].push_back({sequence.ends_at, &sequence.steps[i]});
                break;
            }
            const std::size_t to = steps_.size();
            steps_[from].push_back(
                {static_cast<PlaceIndex>(graph_places_ + to), &sequence.steps[i]});
            steps_.emplace_back();
            own_stands_.push_back(&sequence.steps[i].shape->stand);
            own_ends_.push_back(i + 1 == sequence.steps.size());
            from = to;
        }
    }
    step_list_.clear();
    for (const auto& steps : steps_) {
        for (const Step& step : steps) step_list_.push_back(&step);
    }
    places_ = graph_places_ + steps_.size();
    place_ranges_.resize(std::max(place_ranges_.size(), places_));
    const std::size_t floors = task.graph ? task.graph->floors : 0;
    floor_ranges_.resize(std::max(floor_ranges_.size(), floors));
    const std::size_t heads = places_ * (task.stops.size() + 1);
    heads_.resize(std::max(heads_.size(), heads));
    head_stamps_.resize(std::max(head_stamps_.size(), heads), 0);

    rest_of_way_s_.assign(task.stops.size() + 1, 0);
    for (std::size_t k = task.stops.size(); k-- > 0;) {
        const PlaceIndex here = task.stops[k].place;
        const bool last = k + 1 == task.stops.size();
        const auto& onward = last ? task.times_to_rest : task.stops[k + 1].times_to;
        rest_of_way_s_[k] = task.stops[k].dwell_s + (onward ? (*onward)[here] : 0.0F) +
                            (last ? 0.0 : rest_of_way_s_[k + 1]);
    }

    // A sequence may come back to the place it starts at: being there before it is another thing.
    const bool in_graph = task.start != kNoPlace && task.sequences.empty();
    const auto place = in_graph ? task.start : static_cast<PlaceIndex>(graph_places_);
    const auto& windows = place_windows(place);
    for (std::uint32_t i = 0; i < windows.count; ++i) {
        const Window window = pool_[windows.begin + i];
        if (window.from_s <= task.start_s && task.start_s < window.to_s) {
            add(place, 0, kNoLabel, -1, task.start_s, task.start_s, window.to_s);
        }
    }
    if (labels_.empty()) {
        note_obstacle(stand_of(place), 0);
        return;
    }
    greed_ = kGreed;
    find_earliest();
    open_.push_back(entry_of(0));
}

const TileIndexes& WindowSearch::stand_of(PlaceIndex place) const {
    return place < graph_places_ ? task_->graph->places[place].stand
                                 : *own_stands_[place - graph_places_];
}

double WindowSearch::bound(PlaceIndex place, std::size_t stage) const {
    if (place >= graph_places_) return 0;
    if (stage < task_->stops.size()) {
        const auto& stop = task_->stops[stage];
        return (stop.times_to ? (*stop.times_to)[place] : 0.0F) + rest_of_way_s_[stage];
    }
    return task_->times_to_rest ? (*task_->times_to_rest)[place] : 0.0F;
}

/// When a stop is taken by others until late, all that a plan does before is waiting; knowing the
/// time keeps the search from looking at every way to wait.
void WindowSearch::find_earliest() {
    earliest_s_.assign(task_->stops.size() + 1, task_->start_s);
    for (std::size_t k = 0; k < task_->stops.size(); ++k) {
        const Range windows = place_windows(task_->stops[k].place);
        for (std::uint32_t i = 0; i < windows.count; ++i) {
            const Window window = pool_[windows.begin + i];
            if (window.to_s - window.from_s < task_->stops[k].dwell_s) continue;
            earliest_s_[k] = window.from_s;
            break;
        }
    }
    if (task_->resting.empty()) return;
    double least_s = kEver_s;
    for (const PlaceIndex place : task_->resting) {
        const Range windows = place_windows(place);
        if (windows.count > 0) {
            least_s = std::min(least_s, pool_[windows.begin + windows.count - 1].from_s);
        }
    }
    if (!std::isinf(least_s)) earliest_s_.back() = least_s;
}

WindowSearch::OpenEntry WindowSearch::entry_of(std::uint32_t index) const {
    const Label& label = labels_[index];
    const double left_s = bound(label.place, label.stage);
    if (label.place >= graph_places_) return {label.arrive_s, left_s, index};
    double end_s = label.arrive_s;
    double to_go_s = left_s;
    for (std::size_t k = label.stage; k < task_->stops.size(); ++k) {
        end_s = std::max(end_s + greed_ * (to_go_s - rest_of_way_s_[k]), earliest_s_[k]);
        end_s += task_->stops[k].dwell_s;
        to_go_s = rest_of_way_s_[k] - task_->stops[k].dwell_s;
    }
    return {std::max(end_s + greed_ * to_go_s, earliest_s_.back()), left_s, index};
}

bool WindowSearch::is_end(const Label& label) const {
    if (label.until_s != kEver_s) return false;
    if (label.place >= graph_places_) return own_ends_[label.place - graph_places_];
    if (label.stage < task_->stops.size()) return false;
    if (task_->resting.empty()) return task_->graph->places[label.place].resting;
    return std::find(task_->resting.begin(), task_->resting.end(), label.place) !=
           task_->resting.end();
}

void WindowSearch::add(PlaceIndex place, std::size_t stage, std::uint32_t parent, std::int32_t arc,
                       double leave_s, double arrive_s, double until_s) {
    const std::size_t slot = stage * places_ + place;
    if (head_stamps_[slot] != stamp_) {
        head_stamps_[slot] = stamp_;
        heads_[slot] = kNoLabel;
    }
    // Intervals of one place do not overlap, so their ends tell them apart. Who can be in an
    // interval earlier can wait there for everything the later one can do.
    for (std::uint32_t i = heads_[slot]; i != kNoLabel; i = labels_[i].next) {
        if (labels_[i].until_s != until_s) continue;
        if (labels_[i].arrive_s <= arrive_s) return;
        labels_[i].closed = true;
    }
    labels_.push_back({place, static_cast<std::uint16_t>(stage), parent, arc, leave_s, arrive_s,
                       until_s, heads_[slot], false});
    heads_[slot] = static_cast<std::uint32_t>(labels_.size() - 1);
}

void WindowSearch::move_along(std::uint32_t index, PlaceIndex to, std::int32_t arc,
                              const ShapePtr& shape, double duration_s, const Range& windows) {
    const Label from = labels_[index];
    const double onward_s = bound(to, from.stage);
    if (std::isinf(onward_s)) return;
    if (const auto tile = joint_->closed_tile(stand_of(from.place), *shape)) {
        if (onward_s < obstacle_bound_s_) {
            obstacle_bound_s_ = onward_s;
            obstacle_ = {Obstacle::Cause::kClosed, 0, 0, tile};
        }
        return;
    }
    bool passable = false;
    for (std::uint32_t i = 0; i < windows.count; ++i) {
        const Window window = pool_[windows.begin + i];
        if (window.from_s >= from.until_s) break;  // would have to leave and come back
        const double leave_s = std::max(window.from_s, from.arrive_s);
        const double arrive_s = leave_s + duration_s;
        if (arrive_s > window.to_s) continue;
        if (arrive_s > task_->now_s + kBlocked_s / 2) break;
        passable = true;
        const Range stand = place_windows(to);
        for (std::uint32_t k = 0; k < stand.count; ++k) {
            const Window stay = pool_[stand.begin + k];
            if (stay.from_s <= leave_s && arrive_s <= stay.to_s) {
                add(to, from.stage, index, arc, leave_s, arrive_s, stay.to_s);
                break;
            }
        }
    }
    if (!passable && onward_s < obstacle_bound_s_) note_obstacle(shape->swept, onward_s);
}

void WindowSearch::expand(std::uint32_t index) {
    const Label from = labels_[index];
    const bool begins = index == 0 && !task_->sequences.empty();
    if (begins || from.place >= graph_places_) {
        for (const Step& step : steps_[begins ? 0 : from.place - graph_places_]) {
            const auto number = std::find(step_list_.begin(), step_list_.end(), &step);
            const auto arc = -2 - static_cast<std::int32_t>(number - step_list_.begin());
            const Range windows = free_windows(step.step->shape->swept);
            move_along(index, step.to, arc, step.step->shape, step.step->duration_s, windows);
        }
        return;
    }
    if (from.stage < task_->stops.size() && task_->stops[from.stage].place == from.place) {
        const double done_s = from.arrive_s + task_->stops[from.stage].dwell_s;
        if (done_s <= from.until_s) {
            add(from.place, from.stage + std::size_t{1}, index, -1, from.arrive_s, done_s,
                from.until_s);
        }
    }
    const CompiledGraph& graph = *task_->graph;
    for (auto arc = graph.first_arc[from.place]; arc < graph.first_arc[from.place + 1]; ++arc) {
        const auto& a = graph.arcs[arc];
        if (std::isinf(bound(a.to, from.stage))) continue;
        const Range windows = arc_windows(arc);
        move_along(index, a.to, static_cast<std::int32_t>(arc), a.shape, a.duration_s, windows);
    }
}

/// Remembers who is on the tiles or, with nobody there, who keeps them longest.
void WindowSearch::note_obstacle(const TileIndexes& tiles, double bound_s) {
    bool held = false;
    double latest_s = -1;
    for (const TileIndex tile : tiles) {
        for (const Use& use : joint_->queue(tile)) {
            const bool is_held = std::isinf(joint_->start_of(use));
            const bool later = joint_->end_of(use) > latest_s;
            if (use.vehicle == task_->vehicle || held > is_held || (held == is_held && !later)) {
                continue;
            }
            held = is_held;
            latest_s = joint_->end_of(use);
            obstacle_ = {Obstacle::Cause::kVehicle, use.vehicle, use.last, tile};
            obstacle_bound_s_ = bound_s;
        }
    }
}

SearchResult WindowSearch::result_from(std::uint32_t last) const {
    SearchResult result;
    result.found = true;
    result.labels = labels_.size();
    for (std::uint32_t i = last; labels_[i].parent != kNoLabel; i = labels_[i].parent) {
        const Label& label = labels_[i];
        PlannedMove move;
        move.place = label.place < graph_places_ ? label.place : kNoPlace;
        move.start_s = label.leave_s;
        move.end_s = label.arrive_s;
        move.duration_s = label.arrive_s - label.leave_s;
        if (label.arc >= 0) {
            move.shape = task_->graph->arcs[static_cast<std::size_t>(label.arc)].shape;
            move.duration_s = task_->graph->arcs[static_cast<std::size_t>(label.arc)].duration_s;
        } else if (label.arc == -1) {
            const TileIndexes& stand = stand_of(label.place);
            const auto& stop = task_->stops[labels_[label.parent].stage];
            move.shape = make_shape(stand, stand, stand);
            move.visit = stop.visit;
            move.duration_s = stop.dwell_s;
        } else {
            const Step& step = *step_list_[static_cast<std::size_t>(-2 - label.arc)];
            move.shape = step.step->shape;
            move.visit = step.step->visit;
            if (move.place == kNoPlace) move.place = step.step->place;
            move.duration_s = step.step->duration_s;
        }
        result.moves.push_back(std::move(move));
    }
    std::reverse(result.moves.begin(), result.moves.end());
    return result;
}

}  // namespace pulseline::traffic
