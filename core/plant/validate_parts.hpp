#pragma once

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/plant/validate.hpp"

/// The steps of validate(), one file each. Not for use elsewhere.
namespace pulseline::plant::detail {

class Faults {
public:
    void add(std::string element, std::string code, std::string what, std::string remedy) {
        faults_.push_back(
            {std::move(element), std::move(code), std::move(what), std::move(remedy)});
    }
    std::vector<Fault> take() { return std::move(faults_); }

private:
    std::vector<Fault> faults_;
};

inline std::string at(const char* list, std::size_t index, const std::string& rest = {}) {
    return std::string("/") + list + "/" + std::to_string(index) + rest;
}

inline std::string quoted(const std::string& text) { return "\"" + text + "\""; }

/// Elements by key: validation looks each up many times. The first of equal keys wins.
struct Index {
    explicit Index(const Plant& plant);

    std::unordered_map<HallId, const Hall*> halls;
    std::unordered_map<StationId, std::size_t> stations;
    std::unordered_map<MarkerId, const Marker*> markers;
    std::unordered_map<VehicleTypeId, const VehicleType*> types;
    std::unordered_map<NodeId, std::size_t> nodes;
};

template <class Map, class K>
const typename Map::mapped_type* look_up(const Map& map, const K& key) {
    const auto it = map.find(key);
    return it == map.end() ? nullptr : &it->second;
}

/// Names, uniqueness and references.
void check_names(const Plant& plant, const Index& index, Faults& faults);
/// Finite numbers and limits that make sense.
void check_numbers(const Plant& plant, Faults& faults);
/// Outlines of halls, areas and vehicle types.
void check_outlines(const Plant& plant, Faults& faults);
/// One of them.
void check_outline(const Polygon& outline, const std::string& element, Faults& faults);
/// Numbers of a load.
void check_load_numbers(const Load& load, const std::string& element, Faults& faults);
/// Who may carry it is in the plant.
void check_load_types(const Load& load, const std::string& element, const Index& index,
                      Faults& faults);
/// Room at stations and homes, codes below the cameras. Needs sound numbers and outlines.
void check_stations(const Plant& plant, const Index& index, Faults& faults);
/// Transmitters where they can be told apart, and enough of them and of receivers for a pose. Needs
/// sound numbers and outlines.
void check_igps(const Plant& plant, const Index& index, Faults& faults);
/// Reflectors where a scanner can tell them apart, and enough of them. Needs the same.
void check_reflectors(const Plant& plant, const Index& index, Faults& faults);
/// Loads where they can be, one at a place, and none that nobody there may carry. Needs the same.
void check_loads(const Plant& plant, const Index& index, Faults& faults);
/// Nodes, edges, and stations to be reached over them.
void check_roadmap(const Plant& plant, const Index& index, Faults& faults);

}  // namespace pulseline::plant::detail
