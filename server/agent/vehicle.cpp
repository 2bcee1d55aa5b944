#include "server/agent/vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "core/simulation/machine/vehicle_motion.hpp"
#include "server/agent/utc.hpp"
#include "server/base/log.hpp"

namespace pulseline::agent {
namespace {

using namespace std::chrono_literals;

constexpr auto kMinStateInterval = 50ms;
constexpr auto kStateInterval = 1s;
constexpr auto kVisualizationInterval = 100ms;
constexpr auto kTruthInterval = 50ms;
constexpr auto kPictureInterval = 500ms;
constexpr auto kSettle = 300ms;
constexpr auto kLookInterval = Vehicle::Steady::duration(2s);
// Pictures of standing vehicles may cost this share of the processor, all together.
constexpr int kLookShare = 10;
constexpr double kRounding = 1e-9;
constexpr double kSeen_m = 50;  // a scanner's range and two long bodies

/// The contacts stand where the drawing says; the vehicle's stop is what is measured against them.
std::vector<geometry::Pose2> chargers(const plant::Plant& plant) {
    std::vector<geometry::Pose2> poses;
    for (const auto& station : plant.stations) {
        if (station.charger) poses.push_back(station.pose);
    }
    return poses;
}

double first_charge(const plant::Vehicle& vehicle, const VehicleSettings& settings) {
    if (settings.battery_percent) return *settings.battery_percent;
    std::mt19937_64 random(simulation::seed_for(settings.seed, "battery " + vehicle.id.str()));
    return std::uniform_real_distribution<double>(82, 98)(random);
}

plant::VehicleType as_loaded(plant::VehicleType type, const plant::Vehicle& vehicle) {
    type.cameras = plant::cameras_of(type, plant::is_loaded(vehicle));
    return type;
}

control::MotionCompensation learned_before(const std::optional<LearnedMoves>& learned) {
    if (!learned) return {};
    auto before = learned->load();
    if (before) return std::move(*before);
    server::log::warn("learned.not_read", {{"what", before.error().what}});
    return {};
}

/// Somebody left a box standing there.
geometry::Polygon thing_at(geometry::Point2 place) {
    constexpr double kBox_m = 0.5;
    return geometry::transformed({place.x_m, place.y_m, 0}, geometry::rectangle(kBox_m, kBox_m));
}

bool drives_by_wheels(const plant::VehicleType& type, const VehicleSettings& settings) {
    return settings.servo_drive &&
           std::any_of(type.wheels.begin(), type.wheels.end(),
                       [](const plant::Wheel& wheel) { return wheel.driven; });
}

std::unique_ptr<simulation::SimulatedDrive> make_drive(const plant::VehicleType& type,
                                                       const plant::Vehicle& vehicle,
                                                       const geometry::Pose2& true_pose,
                                                       const VehicleSettings& settings,
                                                       const localisation::ErrorBudget& errors) {
    const auto seed = simulation::seed_for(settings.seed, "motion " + vehicle.id.str());
    if (drives_by_wheels(type, settings)) {
        return std::make_unique<simulation::ServoDrive>(type, true_pose, seed, settings.time_factor,
                                                        vehicle.load_kg, errors);
    }
    return std::make_unique<simulation::VehicleMotion>(type, true_pose, seed, settings.time_factor);
}

/// Of the drive that make_drive() makes.
localisation::OdometryNoise odometry_noise(const plant::VehicleType& type,
                                           const VehicleSettings& settings,
                                           const localisation::ErrorBudget& errors) {
    return drives_by_wheels(type, settings)
               ? localisation::odometry_noise(errors.drive, type)
               : simulation::odometry_noise(simulation::MotionErrors{});
}

}  // namespace

Vehicle::Vehicle(const simulation::World& world, const plant::Vehicle& vehicle,
                 const geometry::Pose2& true_pose, const VehicleSettings& settings, TruthLog* truth)
    : vehicle_(vehicle),
      type_(as_loaded(*plant::find_vehicle_type(world.plant, vehicle.type), vehicle)),
      hall_(plant::find_station(world.plant, vehicle.home)->hall),
      settings_(settings),
      drive_(make_drive(type_, vehicle, true_pose, settings, world.errors)),
      sensing_(world, hall_, *drive_, settings.rendered,
               simulation::seed_for(settings.seed, "eyes " + vehicle.id.str()),
               plant::is_loaded(vehicle)),
      stop_senses_(sensing_),
      equipment_(type_, drive_->true_pose(), chargers(world.plant), first_charge(vehicle, settings),
                 settings.time_factor, vehicle.load_kg,
                 simulation::seed_for(settings.seed, "body " + vehicle.id.str())),
      learned_(settings.learned.empty() ? std::nullopt
                                        : std::optional<LearnedMoves>(
                                              std::in_place, settings.learned, vehicle.id.str())),
      executor_(*drive_, stop_senses_, hall_.str(), &equipment_, learned_before(learned_)),
      body_(*drive_),
      estimate_(geometry::Pose2{}, odometry_noise(type_, settings, world.errors)),
      rest_watch_(*drive_, estimate_),
      watch_(sensing_, *drive_, estimate_),
      truth_(truth),
      headers_(vehicle.manufacturer, vehicle.serial_number),
      look_every_(kLookInterval) {
    if (drives_by_wheels(type_, settings)) guard_.emplace(type_, plant::is_loaded(vehicle));
    drive_->set_believed({});  // where it stands it is told, or its codes or receivers say
    if (!type_.receivers.empty()) {
        receivers_.emplace(world, hall_, type_, drive_->true_pose(),
                           simulation::seed_for(settings.seed, "receivers " + vehicle.id.str()));
        light_.emplace(*receivers_, *drive_, estimate_, watch_.trail(), world.errors.receiver);
        stop_senses_.use(*light_);
    }
    if (type_.navigation_scanner) {
        navigation_scanner_.emplace(
            world, hall_, type_, drive_->true_pose(),
            simulation::seed_for(settings.seed, "navigation scanner " + vehicle.id.str()));
        reflectors_.emplace(*navigation_scanner_, *drive_, estimate_, watch_.trail(),
                            world.errors.reflector);
    }
    if (settings.servo_drive && !type_.scanners.empty()) {
        scanners_.emplace(world, hall_, type_, drive_->true_pose(),
                          simulation::seed_for(settings.seed, "scanners " + vehicle.id.str()));
        look_out_.emplace(*scanners_, vehicle, *drive_);
        executor_.see(look_out_->scans());
        going_round_.emplace(type_, plant::is_loaded(vehicle), *drive_, *look_out_, executor_);
        if (settings.map) {
            contours_.emplace(*scanners_, *drive_, estimate_, watch_.trail(), settings.map,
                              simulation::seed_for(settings.seed, "particles " + vehicle.id.str()));
        }
    }
}

void Vehicle::step(double dt_s, Steady::time_point now) {
    apply_faults(dt_s);
    drive(dt_s);
    keep_learned();
    body_.step(dt_s);
    equipment_.step(dt_s, std::abs(drive_->velocity_mps()) * dt_s);
    if (!drive_->standing()) stood_since_ = now;
    write_truth(now);
    if (sensing_.take_fresh()) {
        pictures_due_ = true;
        state_due_ = true;
        last_look_ = now;
    }
    look_while_standing(now);
    if (executor_.take_factsheet_request()) send_factsheet();
    state_due_ |= executor_.take_changed();
    if (look_out_) state_due_ |= look_out_->take_changed() | going_round_->take_changed();
    if (!linked_) return;
    const auto since = now - last_state_;
    if ((state_due_ && since >= kMinStateInterval) || since >= kStateInterval) send_state(now);
    if (executor_.position_initialized() && now - last_visualization_ >= kVisualizationInterval) {
        last_visualization_ = now;
        send_visualization();
    }
    if (pictures_due_ && now - last_pictures_ >= kPictureInterval) send_pictures(now);
}

/// It looks out and is steered by steps of its own time, however fast that runs.
void Vehicle::drive(double dt_s) {
    for (double left_s = dt_s; left_s > 0;) {
        const double parts = std::ceil(left_s * settings_.time_factor / most_step_s() - kRounding);
        const double part_s = parts > 1 ? left_s / parts : left_s;
        // Whoever drives it by hand looks out.
        if (look_out_ && !executor_.in_hand()) {
            look_out_->step(part_s);
            going_round_->step(part_s);
        }
        limit_speed();
        executor_.step(part_s);
        know_pose(part_s);
        left_s = parts > 1 ? left_s - part_s : 0;
    }
}

void Vehicle::see(simulation::SimulatedScanners::Neighbours neighbours) {
    if (receivers_) receivers_->see(neighbours);
    if (navigation_scanner_) navigation_scanner_->see(neighbours);
    if (scanners_) scanners_->see(std::move(neighbours));
}

void Vehicle::show_body(const plant::HallId& hall, geometry::Point2 from,
                        std::vector<geometry::Polygon>& to) const {
    const auto& pose = drive_->true_pose();
    if (hall != hall_ || distance(pose.position(), from) > kSeen_m) return;
    for (const auto& piece : plant::outline_with_load(type_, plant::is_loaded(vehicle_))) {
        to.push_back(geometry::transformed(pose, piece));
    }
}

bool Vehicle::drives_fast() const {
    return std::abs(drive_->velocity_mps()) > type_.max_speed_mps * drive_->time_factor() / 2;
}

void Vehicle::apply_faults(double dt_s) {
    age_s_ += dt_s;
    std::erase_if(settings_.faults, [&](const Fault& fault) {
        const bool waits = fault.driving && !drives_fast();
        if (age_s_ < fault.after_s || waits) return false;
        apply(fault);
        state_due_ = true;
        return true;
    });
}

void Vehicle::apply(const Fault& fault) {
    auto* servo = dynamic_cast<simulation::ServoDrive*>(drive_.get());
    bool known = true;
    switch (fault.kind) {
        case Fault::Kind::kMarkerLost:
            return sensing_.cover();
        case Fault::Kind::kDark:
            return sensing_.darken();
        case Fault::Kind::kObstacle:
            if (scanners_) scanners_->put(thing_at(fault.place));
            return;
        case Fault::Kind::kWayFree:
            if (!scanners_) return;
            scanners_->take_away();
            return scanners_->clean();
        case Fault::Kind::kLookOutCovered:
            if (scanners_) scanners_->cover();
            return;
        case Fault::Kind::kTransmitterDark:
            if (receivers_) receivers_->cover(plant::TransmitterId(fault.part));
            return;
        case Fault::Kind::kCarried:
            return drive_->carry(fault.carried);
        case Fault::Kind::kScannerCovered:
            if (navigation_scanner_) navigation_scanner_->cover();
            return;
        case Fault::Kind::kWheel:
            body_.break_wheel(fault.part);
            if (servo != nullptr) known = servo->break_wheel(fault.part);
            break;
        case Fault::Kind::kBearing:
            known = body_.seize_bearing(fault.part);
            break;
        case Fault::Kind::kSlip:
            known = servo != nullptr && servo->set_slip(fault.part, fault.share);
            break;
        case Fault::Kind::kEncoder:
            known = servo != nullptr && servo->kill_encoder(fault.part);
            break;
    }
    if (!known)
        server::log::warn("fault.unknown_wheel",
                          {{"vehicle", vehicle_.id.str()}, {"wheel", fault.part}});
}

void Vehicle::keep_learned() {
    const bool ended = stopping_ && !executor_.acting();
    stopping_ = executor_.acting();
    if (!ended || !learned_) return;
    if (const auto saved = learned_->save(executor_.compensation()); !saved) {
        server::log::warn("learned.not_kept",
                          {{"vehicle", vehicle_.id.str()}, {"what", saved.error().what}});
    }
}

/// What the cameras see lets the server confirm where the vehicle stands.
void Vehicle::look_while_standing(Steady::time_point now) {
    if (!drive_->standing()) {
        sensing_.forget();
        last_look_ = {};
        return;
    }
    if (!linked_ || executor_.acting() || now - stood_since_ < kSettle) return;
    if (now - last_look_ < look_every_) return;
    const auto begin = Steady::now();
    sensing_.look();
    look_every_ =
        std::max(kLookInterval, kLookShare * settings_.vehicles * (Steady::now() - begin));
    last_look_ = now;
}

void Vehicle::write_truth(Steady::time_point now) {
    if (truth_ == nullptr) return;
    TruthLine line{vehicle_.id.str(),
                   drive_->true_pose(),
                   !drive_->standing(),
                   executor_.order_id(),
                   executor_.last_node_sequence_id(),
                   executor_.base_end_sequence_id(),
                   {estimate_.pose(), estimate_.sigma_xy_m(), estimate_.sigma_heading_rad()}};
    const TruthLine& last = last_truth_line_;
    const bool told = line.moving == last.moving && line.order_id == last.order_id &&
                      line.last_node_seq == last.last_node_seq &&
                      line.base_end_seq == last.base_end_seq && line.vehicle == last.vehicle;
    const bool moved = !(line.pose == last.pose) && now - last_truth_ >= kTruthInterval;
    if (told && !moved) return;
    last_truth_ = now;
    last_truth_line_ = line;
    truth_->write(line, to_ns(utc_now()) / 1'000'000);
}

}  // namespace pulseline::agent
