#include <algorithm>
#include <map>
#include <set>

#include "core/plant/free_floor.hpp"
#include "core/plant/validate_parts.hpp"

namespace pulseline::plant::detail {
namespace {

template <class T>
void check_ids(const std::vector<T>& items, const char* list, Faults& faults) {
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const std::string& id = items[i].id.str();
        if (id.empty()) {
            faults.add(at(list, i, "/id"), "empty_id", "The id is empty.", "Give it a short name.");
            continue;
        }
        const auto [it, is_new] = first.emplace(id, i);
        if (!is_new) {
            faults.add(at(list, i, "/id"), "duplicate_id",
                       "The id " + quoted(id) + " is taken by " + at(list, it->second) + ".",
                       "Give each its own id.");
        }
    }
}

template <class Map, class K>
void check_reference(const Map& map, const K& key, const std::string& element, const char* kind,
                     Faults& faults) {
    if (map.count(key) != 0) return;
    faults.add(element, std::string("unknown_") + kind,
               std::string("There is no ") + kind + " " + quoted(key.str()) + ".",
               "Correct the name or add it to the plant.");
}

void check_types_of(const std::vector<VehicleTypeId>& types, const std::string& element,
                    const Index& index, Faults& faults) {
    for (std::size_t i = 0; i < types.size(); ++i) {
        check_reference(index.types, types[i], element + "/vehicle_types/" + std::to_string(i),
                        "vehicle_type", faults);
    }
}

/// No lane leads there: whoever serves it has to find its way over free floor.
void check_free_floor(const Plant& plant, const Station& station, const std::string& element,
                      Faults& faults) {
    for (const VehicleType& type : plant.vehicle_types) {
        const auto& served = station.vehicle_types;
        if (!served.empty() && std::ranges::find(served, type.id) == served.end()) continue;
        if (drives_over_free_floor(type)) continue;
        faults.add(element, "node_missing",
                   "It has no node, and vehicles of type " + quoted(type.id.str()) +
                       " cannot drive over free floor.",
                   "Name a node, or list only types that drive 'linear' and 'free'.");
    }
}

void check_station_names(const Plant& plant, const Index& index, Faults& faults) {
    std::map<int, std::size_t> numbers;
    for (std::size_t i = 0; i < plant.stations.size(); ++i) {
        const Station& s = plant.stations[i];
        const auto [it, is_new] = numbers.emplace(s.number, i);
        if (!is_new) {
            faults.add(at("stations", i, "/number"), "duplicate_number",
                       "Number " + std::to_string(s.number) + " is taken by " +
                           at("stations", it->second) + ".",
                       "Give each station its own number: people and codes say it.");
        }
        check_reference(index.halls, s.hall, at("stations", i, "/hall"), "hall", faults);
        if (s.node.empty()) {
            check_free_floor(plant, s, at("stations", i, "/node"), faults);
        } else {
            check_reference(index.nodes, s.node, at("stations", i, "/node"), "node", faults);
        }
        for (std::size_t m = 0; m < s.markers.size(); ++m) {
            const std::string element = at("stations", i, "/markers/" + std::to_string(m));
            check_reference(index.markers, s.markers[m], element, "marker", faults);
            const auto* marker = look_up(index.markers, s.markers[m]);
            if (marker != nullptr && (*marker)->hall != s.hall) {
                faults.add(element, "other_hall", "The marker lies in another hall.",
                           "Name a marker of hall " + quoted(s.hall.str()) + ".");
            }
        }
        check_types_of(s.vehicle_types, at("stations", i), index, faults);
    }
}

void check_markers(const Plant& plant, const Index& index, Faults& faults) {
    std::map<std::string, std::size_t> payloads;
    for (std::size_t i = 0; i < plant.markers.size(); ++i) {
        const Marker& m = plant.markers[i];
        check_reference(index.halls, m.hall, at("markers", i, "/hall"), "hall", faults);
        if (m.payload.empty()) {
            faults.add(at("markers", i, "/payload"), "empty_payload", "The payload is empty.",
                       "Write what the printed code says.");
            continue;
        }
        const auto [it, is_new] = payloads.emplace(m.payload, i);
        if (!is_new) {
            faults.add(at("markers", i, "/payload"), "duplicate_payload",
                       "The payload " + quoted(m.payload) + " is also that of " +
                           at("markers", it->second) + ".",
                       "Give each code its own payload: a vehicle could not tell them apart.");
        }
        if (m.kind == MarkerKind::kQr) continue;
        const int most = m.kind == MarkerKind::kAprilTag ? 586 : 254;
        const int least = m.kind == MarkerKind::kAprilTag ? 0 : 1;
        const bool digits =
            m.payload.size() <= 3 && std::all_of(m.payload.begin(), m.payload.end(),
                                                 [](char c) { return c >= '0' && c <= '9'; });
        const int number = digits ? std::stoi(m.payload) : -1;
        if (number < least || number > most) {
            faults.add(at("markers", i, "/payload"), "bad_payload",
                       "The payload of this kind is a number.",
                       "Write " + std::to_string(least) + " to " + std::to_string(most) + ".");
        }
    }
}

bool identity_charset(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '.' || c == ':' || c == '-';
    });
}

void check_vehicle_names(const Plant& plant, const Index& index, Faults& faults) {
    std::map<std::pair<std::string, std::string>, std::size_t> identities;
    std::map<StationId, std::size_t> homes;
    for (std::size_t i = 0; i < plant.vehicles.size(); ++i) {
        const Vehicle& v = plant.vehicles[i];
        check_reference(index.types, v.type, at("vehicles", i, "/type"), "vehicle_type", faults);
        check_reference(index.stations, v.home, at("vehicles", i, "/home"), "station", faults);
        const auto [home, free] = homes.emplace(v.home, i);
        if (!free) {
            faults.add(at("vehicles", i, "/home"), "duplicate_home",
                       quoted(v.home.str()) + " is already the home of " +
                           at("vehicles", home->second) + ".",
                       "Give each vehicle its own home.");
        }
        const char* const remedy = "Use letters, digits and _ . : - only (VDA 5050).";
        if (!identity_charset(v.manufacturer)) {
            faults.add(at("vehicles", i, "/manufacturer"), "bad_identity",
                       "The manufacturer " + quoted(v.manufacturer) + " does not fit a topic.",
                       remedy);
        }
        if (!identity_charset(v.serial_number)) {
            faults.add(at("vehicles", i, "/serial_number"), "bad_identity",
                       "The serial number " + quoted(v.serial_number) + " does not fit a topic.",
                       remedy);
        }
        const auto [same, is_new] =
            identities.emplace(std::pair(v.manufacturer, v.serial_number), i);
        if (!is_new) {
            faults.add(
                at("vehicles", i, "/serial_number"), "duplicate_identity",
                "Manufacturer and serial number are those of " + at("vehicles", same->second) + ".",
                "Give each vehicle its own serial number.");
        }
    }
}

/// Sideways motion needs wheels that can all point or roll that way, turning on a straight way ones
/// that need not be steered for it.
bool wheels_allow(const VehicleType& type, MotionMode mode) {
    switch (mode) {
        case MotionMode::kLateral:
        case MotionMode::kOblique:
            return type.kinematics != Kinematics::kDifferential;
        case MotionMode::kCombined:
            return type.kinematics == Kinematics::kMecanum;
        default:
            return true;
    }
}

/// Parts of a vehicle that are told apart by their names.
template <class T>
void check_own_names(const std::vector<T>& parts, const std::string& list, const std::string& kind,
                     const std::string& such, Faults& faults) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!parts[i].name.empty() && names.insert(parts[i].name).second) continue;
        faults.add(list + "/" + std::to_string(i) + "/name", "duplicate_" + kind,
                   "The " + kind + " has no name of its own.",
                   "Name it by its place, such as \"" + such + "\".");
    }
}

void check_type_names(const Plant& plant, Faults& faults) {
    for (std::size_t i = 0; i < plant.vehicle_types.size(); ++i) {
        const VehicleType& type = plant.vehicle_types[i];
        const auto own = [&](const auto& parts, const char* list, const char* kind,
                             const char* such = "front left") {
            check_own_names(parts, at("vehicle_types", i, list), kind, such, faults);
        };
        own(type.wheels, "/wheels", "wheel", "FL");
        own(type.casters, "/casters", "caster");
        own(type.brackets, "/brackets", "bracket");
        if (type.parking) own(type.parking->feet, "/parking/feet", "foot");
        own(type.cameras, "/cameras", "camera", "front");
        own(type.receivers, "/receivers", "receiver");
        own(type.scanners, "/scanners", "scanner");
        if (type.motion_modes.empty()) {
            faults.add(at("vehicle_types", i, "/motion_modes"), "no_motion_mode",
                       "The type allows no motion mode, so it can never move.",
                       "Allow at least \"linear\".");
        }
        for (const MotionMode mode : type.motion_modes) {
            if (wheels_allow(type, mode)) continue;
            faults.add(at("vehicle_types", i, "/motion_modes"), "mode_not_for_wheels",
                       std::string("The type's wheels cannot drive ") + to_string(mode) + ".",
                       "Take it out of the list, or correct \"kinematics\".");
        }
    }
}

}  // namespace

void check_names(const Plant& plant, const Index& index, Faults& faults) {
    if (plant.id.empty()) {
        faults.add("/id", "empty_id", "The plant has no id.", "Give it a short name.");
    }
    check_ids(plant.halls, "halls", faults);
    check_ids(plant.stations, "stations", faults);
    check_ids(plant.markers, "markers", faults);
    check_ids(plant.transmitters, "transmitters", faults);
    check_ids(plant.reflectors, "reflectors", faults);
    check_ids(plant.areas, "areas", faults);
    check_ids(plant.vehicle_types, "vehicle_types", faults);
    check_ids(plant.vehicles, "vehicles", faults);
    check_ids(plant.loads, "loads", faults);
    check_ids(plant.nodes, "roadmap/nodes", faults);
    check_ids(plant.edges, "roadmap/edges", faults);
    for (std::size_t i = 0; i < plant.transmitters.size(); ++i) {
        check_reference(index.halls, plant.transmitters[i].hall, at("transmitters", i, "/hall"),
                        "hall", faults);
    }
    for (std::size_t i = 0; i < plant.reflectors.size(); ++i) {
        check_reference(index.halls, plant.reflectors[i].hall, at("reflectors", i, "/hall"), "hall",
                        faults);
    }
    for (std::size_t i = 0; i < plant.areas.size(); ++i) {
        check_reference(index.halls, plant.areas[i].hall, at("areas", i, "/hall"), "hall", faults);
    }
    check_station_names(plant, index, faults);
    check_markers(plant, index, faults);
    check_type_names(plant, faults);
    check_vehicle_names(plant, index, faults);
}

}  // namespace pulseline::plant::detail
