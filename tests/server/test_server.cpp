#include "tests/server/test_server.hpp"

#include <stdexcept>

namespace pulseline::server::testing {

plant::Plant small_plant() {
    plant::Plant plant;
    plant.id = "small";
    plant.name = "Small";
    plant::Hall hall;
    hall.id = plant::HallId("hall");
    hall.name = "Hall";
    hall.outline = {{0, 0}, {20, 0}, {20, 10}, {0, 10}};
    plant.halls.push_back(hall);
    for (int number = 1; number <= 2; ++number) {
        plant::RoadmapNode node;
        node.id = plant::NodeId("n" + std::to_string(number));
        node.hall = hall.id;
        node.position = {5.0 * number, 5};
        plant.nodes.push_back(node);
        plant::Station station;
        station.id = plant::StationId("st0" + std::to_string(number));
        station.number = number;
        station.name = "Station " + std::to_string(number);
        station.hall = hall.id;
        station.pose = {5.0 * number, 5, 0};
        station.node = node.id;
        station.resting_place = true;
        plant.stations.push_back(station);
    }
    for (const auto& [from, to] : {std::pair{"n1", "n2"}, std::pair{"n2", "n1"}}) {
        plant::RoadmapEdge edge;
        edge.id = plant::EdgeId(std::string(from) + to);
        edge.from = plant::NodeId(from);
        edge.to = plant::NodeId(to);
        plant.edges.push_back(edge);
    }
    plant::VehicleType type;
    type.id = plant::VehicleTypeId("small");
    type.name = "Small";
    type.kinematics = plant::Kinematics::kDifferential;
    type.footprint = {{-0.5, -0.3}, {0.5, -0.3}, {0.5, 0.3}, {-0.5, 0.3}};
    type.motion_modes = {plant::MotionMode::kLinear, plant::MotionMode::kSelfRotation};
    plant::Camera camera;
    camera.name = "front";
    type.cameras.push_back(camera);
    plant.vehicle_types.push_back(type);
    plant::Vehicle vehicle;
    vehicle.id = plant::VehicleId("V1");
    vehicle.type = type.id;
    vehicle.manufacturer = "ACME";
    vehicle.serial_number = "0001";
    vehicle.name = "V1";
    vehicle.home = plant.stations.front().id;
    plant.vehicles.push_back(vehicle);
    return plant;
}

TestServer::TestServer(Options options, MemoryStore* store) : store_(store ? store : &own_store_) {
    options.listen = "127.0.0.1:0";
    server_ = std::make_unique<Server>(std::move(options),
                                       Server::Parts{plant_, *store_, *store_, access_});
    if (const auto started = server_->start(); !started) {
        throw std::runtime_error(started.error().what);
    }
    thread_ = std::thread([this] { server_->run(); });
}

TestServer::~TestServer() { stop(); }

void TestServer::stop() {
    if (!thread_.joinable()) return;
    server_->stop();
    thread_.join();
}

std::map<std::string, std::string> TestServer::token(access::Role role) {
    const auto made = server_->access().create_api_token(role, "api", "test", Time{});
    if (!made) throw std::runtime_error(made.error().what);
    return {{"Authorization", "Bearer " + made->secret}};
}
std::map<std::string, std::string> TestServer::operator_token() {
    return token(access::Role::kOperator);
}
std::map<std::string, std::string> TestServer::viewer_token() {
    return token(access::Role::kViewer);
}

std::string TestServer::vehicle_token(const std::string& serial) {
    const auto made = server_->access().create_vehicle_token("ACME", serial, "test", Time{});
    if (!made) throw std::runtime_error(made.error().what);
    return made->secret;
}

}  // namespace pulseline::server::testing
