#include "tests/simulation/fleet_judge_vehicle.hpp"

#include <algorithm>
#include <utility>

namespace pulseline::fleet_judge {

namespace {
constexpr int kUnreadable = 40;      // one stop in so many is not measured
constexpr double kInView_m = 0.085;  // half of what a camera sees of the floor
constexpr double kBattery_percent = 90;
}  // namespace

/// What the cameras find at a stop: the true pose, to a tenth of a millimetre.
class Vehicle::Cameras : public onboard::StopSensing {
public:
    Cameras(const simulation::VehicleMotion& motion, std::mt19937_64& random)
        : motion_(motion), random_(random) {}
    Result<vda5050::StopMeasurement> measure(const vda5050::StopTarget& target) override {
        if (random_() % kUnreadable == 0) {
            return fail(Errc::kNotFound, "no_marker_in_view", "dirt on the code");
        }
        return vda5050::StopMeasurement{
            motion_.true_pose(), 1e-4, 1e-4, "dual_camera", {target.markers.front().payload}};
    }

private:
    const simulation::VehicleMotion& motion_;
    std::mt19937_64& random_;
};

Vehicle::Vehicle(const plant::Plant& plant, const plant::Vehicle& vehicle,
                 std::shared_ptr<simulation::Supports> supports, std::uint64_t seed)
    : plant_(plant),
      vehicle_(vehicle),
      type_(*plant::find_vehicle_type(plant, vehicle.type)),
      random_(seed) {
    if (type_.parking) {
        const auto* load = plant::first_load(plant, vehicle.id);
        std::optional<simulation::TrueLoad> carried;
        if (load != nullptr) carried = {load->id, load->mass_kg, load->centre};
        equipment_ = std::make_unique<simulation::VehicleEquipment>(
            type_, stands_, std::vector<Pose2>{}, kBattery_percent, 1,
            load == nullptr ? 0 : load->mass_kg, seed);
        equipment_->work_below(std::move(supports), plant.halls[0].id, carried);
    }
    shows_codes = !type_.brackets.empty();  // it leaves a station only when it sees them
    boot(plant::find_station(plant, vehicle.home)->pose);
}

Vehicle::~Vehicle() = default;

void Vehicle::boot(const Pose2& pose) {
    executor_.reset();
    handling_.reset();
    cameras_.reset();
    misread_reports_ = 0;
    simulation::MotionErrors errors;
    if (type_.length_m() > 5) {  // the platform follows marks on the floor of its row
        errors.heading_rad_per_sqrt_m /= 10;
        errors.steering_bias_rad /= 10;
        errors.settle_rad /= 10;
    }
    motion_ = std::make_unique<simulation::VehicleMotion>(type_, pose, random_(), 1, errors);
    cameras_ = std::make_unique<Cameras>(*motion_, random_);
    if (equipment_) handling_ = std::make_unique<onboard::LoadHandling>(*equipment_, type_);
    if (begun_transfer_) handling_->begun_before(*begun_transfer_);
    executor_ = std::make_unique<onboard::Executor>(*motion_, *cameras_, plant_.halls[0].id.str(),
                                                    handling_.get());
    stands_ = pose;
    if (equipment_) equipment_->abort();  // its brakes hold without power
}

void Vehicle::restart() {
    boot(Pose2(motion_->true_pose()));
    header_id_ = 0;
}

void Vehicle::push(const Pose2& to) {
    const bool known = knows_pose();
    boot(to);
    if (!known) return;
    vda5050::Action action;
    action.type = "initPosition";
    action.id = "pushed";
    action.init_position = vda5050::InitPosition{to, plant_.halls[0].id.str(), {}};
    executor_->handle(vda5050::InstantActionsMessage{{action}});
}

void Vehicle::misread(const Pose2& by, int reports) {
    misread_ = by;
    misread_reports_ = reports;
}

void Vehicle::receive(const fleet::VehicleMessage& message) {
    if (message.instant_actions) {
        for (const auto& action : message.instant_actions->actions) {
            const bool moved = equipment_ && equipment_->busy();
            executor_->handle(vda5050::InstantActionsMessage{{action}});
            if (equipment_ && equipment_->busy() && !moved) lifts_begun_.push_back(action.id);
            if (action.type == "initPosition") misread_reports_ = 0;
        }
    }
    if (message.order) executor_->handle(*message.order);
}

std::optional<plant::LoadId> Vehicle::load() const {
    const auto& carried = equipment_ ? equipment_->carried() : std::nullopt;
    return carried ? std::optional(carried->id) : std::nullopt;
}

double Vehicle::bracket_height_m() const {
    double highest_m = 0;
    for (const auto& bracket : type_.brackets) {
        highest_m = std::max(highest_m, equipment_->bracket_height_m(bracket.name).value_or(0));
    }
    return highest_m;
}

void Vehicle::step(double dt_s) {
    moved_ = false;
    if (dead) return;
    if (equipment_) {
        equipment_->step(dt_s, 0);
        handling_->step();
        begun_transfer_ = handling_->begun();
    }
    if (manual || broken || safety_stopped) return;
    const Pose2 before = motion_->true_pose();
    executor_->step(dt_s);
    stands_ = motion_->true_pose();
    moved_ = !(before.x_m == pose().x_m && before.y_m == pose().y_m &&
               before.heading_rad == pose().heading_rad);
}

std::vector<vda5050::CameraReading> Vehicle::readings() const {
    std::vector<vda5050::CameraReading> found;
    for (const auto& camera : type_.cameras) {
        vda5050::CameraReading reading;
        reading.camera = camera.name;
        for (const auto& marker : plant_.markers) {
            const auto in_body = geometry::inverse(pose()) * marker.pose;
            const auto off = in_body.position() - camera.body_from_camera.position();
            if (norm(off) > kInView_m) continue;
            reading.found = true;
            reading.payload = marker.payload;
            reading.code = in_body.position();
            reading.angle_rad = in_body.heading_rad;
            reading.sigma_m = 1e-5;
        }
        found.push_back(std::move(reading));
    }
    return found;
}

vda5050::StateMessage Vehicle::state() {
    vda5050::StateMessage state;
    executor_->write_state(state);
    state.header_id = ++header_id_;
    if (equipment_) equipment_->write_state(state);
    if (misread_reports_ > 0 && state.pose) {
        --misread_reports_;
        state.pose->x_m += misread_.x_m;
        state.pose->y_m += misread_.y_m;
        state.pose->heading_rad = wrap(state.pose->heading_rad + misread_.heading_rad);
    }
    if ((!knows_pose() || shows_codes) && standing()) state.cameras = readings();
    if (manual) state.operating_mode = "MANUAL";
    if (broken) state.errors.push_back({"driveFault", true, "the drive is hot", {}});
    if (safety_stopped) state.e_stop = "MANUAL";
    if (manual || broken || safety_stopped) {
        state.driving = false;
        state.velocity_mps = state.turn_rate_radps = 0;
    }
    return state;
}

bool Vehicle::take_changed() {
    const bool is = manual || broken || safety_stopped;
    return executor_->take_changed() || std::exchange(was_, is) != is;
}

}  // namespace pulseline::fleet_judge
