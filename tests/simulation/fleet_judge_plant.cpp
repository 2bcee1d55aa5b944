#include "tests/simulation/fleet_judge_plant.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace pulseline::fleet_judge {
namespace {

using plant::NodeId;
using plant::Plant;
using plant::VehicleTypeId;

constexpr double kColumn_m = 12;
constexpr double kRow_m = 12;
constexpr double kBayAside_m = 3;  // along the row, to both sides of a column
constexpr double kBayAway_m = 6;
constexpr double kPlatformBay_m = 17;  // beyond the end of its row
constexpr double kCamera_m = 0.4;      // the same on all types, so that all read the same codes

plant::VehicleType type_of(const char* id, double length_m, double width_m, double speed_mps) {
    plant::VehicleType type;
    type.id = VehicleTypeId(id);
    type.name = id;
    type.footprint = geometry::rectangle(length_m, width_m);
    type.max_speed_mps = speed_mps;
    type.max_accel_mps2 = 0.5;
    type.max_turn_rate_radps = 0.5;
    type.max_turn_accel_radps2 = 0.5;
    type.clearance_m = 0.3;
    type.motion_modes = {plant::MotionMode::kLinear};
    // The platform keeps its heading; the others turn at nodes.
    if (length_m < 5) type.motion_modes.push_back(plant::MotionMode::kSelfRotation);
    for (const auto& [name, x_m] : {std::pair{"front", kCamera_m}, std::pair{"back", -kCamera_m}}) {
        plant::Camera camera;
        camera.name = name;
        camera.body_from_camera = {x_m, 0, 0};
        type.cameras.push_back(camera);
    }
    return type;
}

class Builder {
public:
    Builder(std::mt19937_64& random, bool free, bool several) : random_(random), several_(several) {
        rows_ = pick(random, 1, 3);
        columns_ = pick(random, 3, rows_ == 1 ? 7 : 6);
        plant_.id = "judge";
        plant_.name = "Judge's hall";
        const double right = (columns_ - 1) * kColumn_m + 26;
        const double top = (rows_ - 1) * kRow_m + 10;
        plant::Hall hall;
        hall.id = plant::HallId("h1");
        hall.name = "Hall";
        hall.outline = {{-26, -10}, {right, -10}, {right, top}, {-26, top}};
        plant_.halls.push_back(hall);
        plant_.vehicle_types = {type_of("cart", 1.2, 0.8, 1.2), type_of("carrier", 3.0, 1.2, 1.0),
                                type_of("platform", 10.5, 2.5, 0.8)};
        auto& platform = plant_.vehicle_types.back();
        platform.mass_kg = 10200;
        platform.max_load_kg = 22000;
        platform.load_footprint = geometry::rectangle(10.5, 2.9);
        for (const double x_m : {2.7, -2.7}) {
            for (const double y_m : {0.7, -0.7}) {
                platform.brackets.push_back(
                    {"b" + std::to_string(platform.brackets.size()), {x_m, y_m}});
            }
        }
        platform.parking.emplace();
        for (const auto& corner : geometry::rectangle(10.5, 2.5)) {
            const auto number = std::to_string(platform.parking->feet.size());
            platform.wheels.push_back({"w" + number, 0.9 * corner, false, true, 0.3});
            platform.parking->feet.push_back({"f" + number, corner});
        }
        for (auto& type : plant_.vehicle_types) {
            if (free && type.id.str() != "platform")
                type.motion_modes.push_back(plant::MotionMode::kFree);
        }
    }

    Plant build() {
        const int platform_row = pick(random_, 0, rows_ - 1);
        for (int row = 0; row < rows_; ++row) {
            add_row(row, row == platform_row || (several_ && pick(random_, 0, 1) == 0));
        }
        add_cross_lanes();
        add_bays(0, -1);
        add_bays(rows_ - 1, 1);
        const auto most = std::min<int>(static_cast<int>(bays_.size()) - 1, 29);
        const int vehicles = pick(random_, 5, most);
        for (std::size_t i = bays_.size(); i > 1; --i)
            std::swap(bays_[i - 1], bays_[random_() % i]);
        for (int i = 0; i < vehicles; ++i) {
            // At least one of each type, or a seed would have one class only.
            const bool carrier = i == 0 || (i > 1 && pick(random_, 0, 2) == 0);
            add_vehicle(i + 1, carrier ? "carrier" : "cart", bays_[static_cast<std::size_t>(i)]);
        }
        int platforms = 1;
        const auto most_platforms = static_cast<int>(platform_bays_.size());
        if (several_) {
            platforms = pick(random_, 2, most_platforms);
            std::shuffle(platform_bays_.begin(), platform_bays_.end(), random_);
        } else {
            std::swap(platform_bays_[0], platform_bays_[random_() % 2]);
        }
        for (int i = 0; i < platforms; ++i) {
            add_vehicle(vehicles + 1 + i, "platform", platform_bays_[static_cast<std::size_t>(i)]);
            add_load(101 + i);
        }
        return std::move(plant_);
    }

private:
    void add_node(const std::string& name, geometry::Point2 at) {
        plant_.nodes.push_back({NodeId(name), plant_.halls[0].id, at});
    }

    void add_lane(const std::string& a, const std::string& b, std::vector<std::string> types) {
        for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
            plant::RoadmapEdge edge;
            edge.from = NodeId(from);
            edge.to = NodeId(to);
            edge.id = plant::EdgeId(from + "." + to);
            for (const auto& type : types) edge.vehicle_types.emplace_back(type);
            // Every third lane has room to go round things, which is kept free like the lane.
            if (plant_.edges.size() / 2 % 3 == 0) edge.corridor = plant::Corridor{1.4, 1.4};
            plant_.edges.push_back(edge);
        }
    }

    plant::StationId add_station(const std::string& node, geometry::Point2 at, bool resting,
                                 std::vector<std::string> types) {
        plant::Station station;
        station.number = static_cast<int>(plant_.stations.size()) + 1;
        station.id = plant::StationId("s" + std::to_string(station.number));
        station.name = node;
        station.hall = plant_.halls[0].id;
        station.pose = {at.x_m, at.y_m, 0};
        station.node = NodeId(node);
        station.resting_place = resting;
        for (const auto& type : types) station.vehicle_types.emplace_back(type);
        for (const auto& [side, x_m] : {std::pair{"F", kCamera_m}, std::pair{"B", -kCamera_m}}) {
            plant::Marker marker;
            marker.payload = station.id.str() + "-" + side;
            marker.id = plant::MarkerId(marker.payload);
            marker.hall = station.hall;
            marker.pose = {at.x_m + x_m, at.y_m, 0};
            station.markers.push_back(marker.id);
            plant_.markers.push_back(marker);
        }
        plant_.stations.push_back(station);
        return station.id;
    }

    void add_row(int row, bool platform) {
        const double y_m = row * kRow_m;
        std::vector<std::string> chain;
        const bool outer = row == 0 || row == rows_ - 1;
        for (int column = 0; column < columns_; ++column) {
            const double x_m = column * kColumn_m;
            const std::string name = node_name(row, column);
            if (outer) {
                add_node(name + "l", {x_m - kBayAside_m, y_m});
                chain.push_back(name + "l");
            }
            add_node(name, {x_m, y_m});
            chain.push_back(name);
            add_station(name, {x_m, y_m}, false, {});
            if (outer) {
                add_node(name + "r", {x_m + kBayAside_m, y_m});
                chain.push_back(name + "r");
            }
        }
        for (std::size_t i = 1; i < chain.size(); ++i) add_lane(chain[i - 1], chain[i], {});
        if (!platform) return;
        const double end_m = (columns_ - 1) * kColumn_m;
        const std::string west = "west" + std::to_string(row);
        const std::string east = "east" + std::to_string(row);
        add_node(west, {-kPlatformBay_m, y_m});
        add_node(east, {end_m + kPlatformBay_m, y_m});
        add_lane(west, chain.front(), {"platform"});
        add_lane(chain.back(), east, {"platform"});
        platform_bays_.push_back(add_station(west, {-kPlatformBay_m, y_m}, true, {"platform"}));
        platform_bays_.push_back(
            add_station(east, {end_m + kPlatformBay_m, y_m}, true, {"platform"}));
    }

    /// Rows hang together by their first or last column, the others are drawn.
    void add_cross_lanes() {
        for (int row = 1; row < rows_; ++row) {
            const int sure = pick(random_, 0, columns_ - 1);
            for (int column = 0; column < columns_; ++column) {
                if (column != sure && pick(random_, 0, 1) == 0) continue;
                add_lane(node_name(row - 1, column), node_name(row, column), {"cart", "carrier"});
            }
        }
    }

    void add_bays(int row, double side) {
        for (int column = 0; column < columns_; ++column) {
            for (const auto& [name, dx] :
                 {std::pair{"l", -kBayAside_m}, std::pair{"r", kBayAside_m}}) {
                const std::string at_row = node_name(row, column) + name;
                const std::string bay = at_row + (side > 0 ? "top" : "bottom");
                const geometry::Point2 at{column * kColumn_m + dx,
                                          row * kRow_m + side * kBayAway_m};
                add_node(bay, at);
                add_lane(at_row, bay, {"cart", "carrier"});
                bays_.push_back(add_station(bay, at, true, {"cart", "carrier"}));
            }
        }
    }

    void add_vehicle(int number, const char* type, const plant::StationId& home) {
        plant::Vehicle vehicle;
        vehicle.id = plant::VehicleId("V" + std::to_string(number));
        vehicle.type = VehicleTypeId(type);
        vehicle.manufacturer = "judge";
        vehicle.serial_number = vehicle.id.str();
        vehicle.home = home;
        plant_.vehicles.push_back(vehicle);
    }

    /// An aircraft that hangs where the newest platform is at home; all along its row something can
    /// hold it.
    void add_load(int number) {
        const auto home = *plant::find_station(plant_, plant_.vehicles.back().home);
        for (auto& station : plant_.stations) {
            if (station.pose.y_m == home.pose.y_m) station.support = plant::Support{0.05};
        }
        plant::Load load;
        load.name = "A-" + std::to_string(number);
        load.id = plant::LoadId(load.name);
        load.mass_kg = 9000;
        load.station = home.id;
        plant_.loads.push_back(std::move(load));
    }

    static std::string node_name(int row, int column) {
        return "n" + std::to_string(row) + "-" + std::to_string(column);
    }

    std::mt19937_64& random_;
    bool several_;
    Plant plant_;
    int rows_ = 1;
    int columns_ = 1;
    std::vector<plant::StationId> bays_;
    std::vector<plant::StationId> platform_bays_;
};

}  // namespace

const plant::Station& home_of(const plant::Plant& plant, const plant::VehicleId& id) {
    return *plant::find_station(plant, plant::find_vehicle(plant, id)->home);
}

int pick(std::mt19937_64& random, int low, int high) {
    return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1));
}

Plant random_plant(std::mt19937_64& random, bool free, bool several) {
    return Builder(random, free, several).build();
}

}  // namespace pulseline::fleet_judge
