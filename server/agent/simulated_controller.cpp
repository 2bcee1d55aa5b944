#include "server/agent/simulated_controller.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/simulation/world/image_conditions.hpp"
#include "core/simulation/world/true_camera.hpp"
#include "core/vda5050/actions.hpp"
#include "server/agent/body_status.hpp"
#include "server/agent/hall_truth.hpp"

namespace pulseline::agent {
namespace {

using namespace machine;

constexpr double kUsualBattery = 90;
constexpr const char* kEveryPart = "all";

const char* type_of(Lift::What what) {
    switch (what) {
        case Lift::What::kBracketHeight:
            return vda5050::kSetBracketHeight;
        case Lift::What::kLowerFeet:
            return vda5050::kLowerParking;
        case Lift::What::kRaiseFeet:
            return vda5050::kRaiseParking;
        case Lift::What::kStartCharging:
            return vda5050::kStartCharging;
        case Lift::What::kStopCharging:
            break;
    }
    return vda5050::kStopCharging;
}

template <class Part>
std::optional<std::string> name_of(const std::vector<Part>& parts,
                                   std::optional<std::uint8_t> one) {
    if (!one) return kEveryPart;
    if (*one >= parts.size()) return std::nullopt;
    return parts[*one].name;
}

/// What a frame of the program asks of the equipment; nothing: of a part that it has not.
std::optional<vda5050::Action> action_of(const plant::VehicleType& type, const Lift& lift) {
    vda5050::Action action;
    action.type = type_of(lift.what);
    if (lift.what == Lift::What::kBracketHeight) {
        const auto name = name_of(type.brackets, lift.one);
        if (!name) return std::nullopt;
        action.params = {{"bracket", *name}, {"height_m", lift.height_m}};
        if (lift.speed_mps) action.params.push_back({"speed_mps", *lift.speed_mps});
    } else if (lift.what == Lift::What::kLowerFeet || lift.what == Lift::What::kRaiseFeet) {
        const auto name =
            type.parking ? name_of(type.parking->feet, lift.one) : std::optional<std::string>();
        if (!name) return std::nullopt;
        action.params = {{"foot", *name}};
    }
    return action;
}

/// Why a program whose plant says other of the axes is not talked with.
std::optional<std::string> other_control(const plant::VehicleType& type, const Hello& hello) {
    if (hello.cycle_s != type.control.cycle_s) {
        return "unknown_cycle: " + std::to_string(type.control.cycle_s) + " s is what it has";
    }
    const auto axes = plant::axes_of(type);
    if (hello.axes.size() != axes.size()) {
        return "wrong_axes: " + std::to_string(hello.axes.size()) + " of " +
               std::to_string(axes.size());
    }
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (hello.axes[i].name != axes[i].name) return "unknown_axis: " + hello.axes[i].name;
        if (hello.axes[i].position_gain_per_s != axes[i].position_gain_per_s) {
            return "other_gain: " + axes[i].name + " has " +
                   std::to_string(axes[i].position_gain_per_s);
        }
    }
    return std::nullopt;
}

}  // namespace

SimulatedController::SimulatedController(const simulation::World& world,
                                         const plant::Vehicle& vehicle,
                                         const plant::VehicleType& type,
                                         const geometry::Pose2& true_pose, const Settings& settings)
    : world_(world),
      type_(type),
      hall_(plant::find_station(world.plant, vehicle.home)->hall),
      wheels_(type, true_pose, simulation::seed_for(settings.seed, "motion " + vehicle.id.str()),
              first_load_kg(world.plant, vehicle), world.errors),
      equipment_(type, wheels_.true_pose(), charger_contacts(world.plant),
                 settings.battery_percent.value_or(kUsualBattery), 1,
                 first_load_kg(world.plant, vehicle),
                 simulation::seed_for(settings.seed, "body " + vehicle.id.str())),
      cameras_(type.cameras),
      scanners_(world, hall_, type, wheels_.true_pose(),
                simulation::seed_for(settings.seed, "scanners " + vehicle.id.str())),
      random_(simulation::seed_for(settings.seed, "eyes " + vehicle.id.str())),
      settings_(settings),
      load_kg_(first_load_kg(world.plant, vehicle)),
      heat_(type) {
    equipment_.work_below(world.supports, hall_, carried_at_first(world.plant, vehicle));
    const bool loaded = plant::first_load(world.plant, vehicle.id) != nullptr;
    for (auto& camera : cameras_) {
        camera = simulation::true_camera(camera, world.errors.camera, loaded, random_);
    }
}

std::vector<Frame> SimulatedController::handle(const Frame& frame) {
    if (const auto* hello = std::get_if<Hello>(&frame)) {
        if (hello->version != kVersion) {
            return {Refused{"unknown_version: version " + std::to_string(hello->version)}};
        }
        if (auto why_not = other_control(type_, *hello)) return {Refused{std::move(*why_not)}};
        hello_ = *hello;
        silent_s_ = 0;
        return {description()};
    }
    if (!hello_) return {Refused{"hello_first: who is it?"}};
    std::vector<Frame> answers;
    if (const auto* points = std::get_if<SetPoints>(&frame)) {
        if (auto why_not = drive(*points)) return {Refused{std::move(*why_not)}};
        end_lift(answers);
        answers.emplace_back(feedback(points->cycle));
    } else if (const auto* lift = std::get_if<Lift>(&frame)) {
        if (auto ended = begin(*lift)) answers.emplace_back(std::move(*ended));
    } else if (std::holds_alternative<StopLifts>(frame)) {
        equipment_.abort();
        if (lift_) {
            answers.emplace_back(LiftEnded{*std::exchange(lift_, std::nullopt),
                                           LiftEnded::Outcome::kFailed, "lifts_stopped"});
        }
    } else if (const auto* off = std::get_if<SwitchOff>(&frame)) {
        if (off->wheel >= type_.wheels.size()) return {Refused{"unknown_wheel: it has fewer"}};
        wheels_.switch_off(type_.wheels[off->wheel].name);
    } else if (const auto* expose = std::get_if<Expose>(&frame)) {
        answers.push_back(picture(*expose));
    } else if (const auto* look = std::get_if<Look>(&frame)) {
        answers.push_back(scans(*look));
    } else {
        return {Refused{"not_for_a_machine: that is what it says itself"}};
    }
    return answers;
}

Description SimulatedController::description() const {
    Description told;
    told.maker = "Pulseline, simulated";
    told.dead_cycles = static_cast<std::uint16_t>(wheels_.dead_cycles());
    for (const auto& wheel : type_.wheels) told.wheels.push_back(wheel.name);
    for (const auto& bracket : type_.brackets) told.brackets.push_back(bracket.name);
    if (type_.parking) {
        for (const auto& foot : type_.parking->feet) told.feet.push_back(foot.name);
    }
    for (const auto& camera : type_.cameras) told.cameras.push_back(camera.name);
    for (const auto& scanner : type_.scanners) told.scanners.push_back(scanner.name);
    return told;
}

/// One cycle; why not, where the program does not know its machine.
std::optional<std::string> SimulatedController::drive(const SetPoints& points) {
    const std::size_t count = points.mode == Mode::kBraked ? 0 : type_.wheels.size();
    if (points.wheels.size() != count) {
        return "wrong_wheels: " + std::to_string(points.wheels.size()) + " of " +
               std::to_string(count);
    }
    silent_s_ = 0;
    std::vector<kinematics::WheelMotion> wanted;
    for (const auto& wheel : points.wheels) wanted.push_back({wheel.angle_rad, wheel.speed_mps});
    double fastest_mps = 0;
    if (points.mode == Mode::kBraked) {
        fall_in();
    } else if (points.mode == Mode::kSteer) {
        wheels_.steer(wanted);
    } else {
        braked_ = false;
        wheels_.roll(wanted);
        for (const auto& wheel : wheels_.measured()) {
            fastest_mps = std::max(fastest_mps, std::abs(wheel.speed_mps));
        }
    }
    const double cycle_s = type_.control.cycle_s;
    heat_.step(cycle_s, wheels_.measured());
    for (std::size_t i = 0; i < type_.wheels.size(); ++i) wheels_.set_hot(i, heat_.is_off(i));
    equipment_.step(cycle_s, fastest_mps * cycle_s);
    if (std::exchange(load_kg_, equipment_.load_kg()) != load_kg_) wheels_.set_load(load_kg_);
    return std::nullopt;
}

void SimulatedController::fall_in() {
    if (!std::exchange(braked_, true)) wheels_.brake();
}

Feedback SimulatedController::feedback(std::uint32_t cycle) {
    vda5050::StateMessage told;
    equipment_.write_state(told);
    Feedback feedback;
    feedback.cycle = cycle;
    feedback.settled = wheels_.settled();
    feedback.moving_lifts = equipment_.busy();
    feedback.charging = told.charging;
    feedback.slip_share = wheels_.slip_share();
    feedback.battery_percent = told.battery_percent;
    const auto fault = wheels_.fault();
    const auto lagging = wheels_.lagging();
    for (std::size_t i = 0; i < type_.wheels.size(); ++i) {
        const auto& name = type_.wheels[i].name;
        const auto& measured = wheels_.measured()[i];
        feedback.wheels.push_back({measured.speed_mps, measured.angle_rad,
                                   wheels_.present()[i].angle_rad, heat_.temperature_c(i),
                                   heat_.is_off(i) ? kTooHot
                                   : fault == name ? kDriveFault
                                                   : "",
                                   lagging == name});
    }
    for (const auto& bracket : told.brackets) {
        feedback.brackets.push_back(
            {bracket.height_m.value_or(0), bracket.force_a_n, bracket.force_b_n});
    }
    for (const auto& foot : told.parking_feet) {
        feedback.feet.push_back({foot.extension_m, foot.force_n.value_or(0)});
    }
    return feedback;
}

std::optional<LiftEnded> SimulatedController::begin(const Lift& lift) {
    const auto refused = [&](std::string why) {
        return LiftEnded{lift.id, LiftEnded::Outcome::kRefused, std::move(why)};
    };
    if (lift_ || equipment_.busy()) return refused("lifts_moving");
    if (!braked_) return refused("vehicle_busy");
    const auto action = action_of(type_, lift);
    if (!action) return refused("unknown_part: it has no such bracket or foot");
    const auto& can = equipment_.action_types();
    if (std::ranges::find(can, action->type) == can.end()) return refused("unknown_lift");
    if (auto why_not = equipment_.begin(*action)) return refused(std::move(*why_not));
    if (!equipment_.busy()) return LiftEnded{lift.id, LiftEnded::Outcome::kDone, {}};
    lift_ = lift.id;
    return std::nullopt;
}

void SimulatedController::end_lift(std::vector<Frame>& answers) {
    if (!lift_ || equipment_.busy()) return;
    const auto failure = equipment_.failure();
    answers.emplace_back(LiftEnded{
        *std::exchange(lift_, std::nullopt),
        failure ? LiftEnded::Outcome::kFailed : LiftEnded::Outcome::kDone, failure.value_or("")});
}

cv::Mat SimulatedController::render(std::size_t camera) {
    const auto codes = codes_around(world_, hall_, true_pose(), !covered_);
    auto conditions = simulation::ImageConditions::nominal(random_);
    if (settings_.dark) conditions.exposure = 0;
    return simulation::render_floor(cameras_[camera], true_pose(), codes, conditions);
}

Frame SimulatedController::picture(const Expose& expose) {
    if (expose.camera >= cameras_.size()) return Refused{"unknown_camera: it has fewer"};
    const auto image = render(expose.camera);
    Picture picture;
    picture.id = expose.id;
    picture.camera = expose.camera;
    picture.width_px = static_cast<std::uint16_t>(image.cols);
    picture.height_px = static_cast<std::uint16_t>(image.rows);
    for (int row = 0; row < image.rows; ++row) {
        picture.grey.append(reinterpret_cast<const char*>(image.ptr(row)),
                            static_cast<std::size_t>(image.cols));
    }
    return picture;
}

Frame SimulatedController::scans(const Look& look) {
    scanners_.scan(seen_);
    Scans told;
    told.id = look.id;
    for (const auto& scan : seen_) {
        auto& one = told.scans.emplace_back();
        one.first_rad = scan.first_rad;
        one.step_rad = scan.step_rad;
        one.blind = scan.blind;
        one.ranges_m = scan.ranges_m;
        for (float& range_m : one.ranges_m) range_m = control::is_return(range_m) ? range_m : 0;
    }
    return told;
}

bool SimulatedController::has(Fault::Kind fault) {
    return fault != Fault::Kind::kTransmitterDark && fault != Fault::Kind::kScannerCovered;
}

void SimulatedController::apply_faults(double dt_s) {
    age_s_ += dt_s;
    std::erase_if(settings_.faults, [&](const Fault& fault) {
        if (age_s_ < fault.after_s || (fault.driving && braked_)) return false;
        apply(fault);
        return true;
    });
}

void SimulatedController::apply(const Fault& fault) {
    switch (fault.kind) {
        case Fault::Kind::kMarkerLost:
            covered_ = true;
            break;
        case Fault::Kind::kDark:
            settings_.dark = true;
            break;
        case Fault::Kind::kObstacle:
            scanners_.put(thing_at(fault.place));
            break;
        case Fault::Kind::kWayFree:
            scanners_.take_away();
            scanners_.clean();
            break;
        case Fault::Kind::kLookOutCovered:
            scanners_.cover();
            break;
        case Fault::Kind::kWheel:
            wheels_.break_wheel(fault.part);
            break;
        case Fault::Kind::kSlip:
            wheels_.set_slip(fault.part, fault.share);
            break;
        case Fault::Kind::kEncoder:
            wheels_.kill_encoder(fault.part);
            break;
        case Fault::Kind::kCarried:
            wheels_.carry(fault.carried);
            break;
        case Fault::Kind::kBracketOff:
            equipment_.displace_bracket(fault.part, fault.by_m);
            break;
        case Fault::Kind::kPit:
            equipment_.dig_below(fault.part);
            break;
        case Fault::Kind::kBearing:
            heat_.seize_bearing(fault.part);
            break;
        case Fault::Kind::kTransmitterDark:
        case Fault::Kind::kScannerCovered:
            break;  // it has none of these
    }
}

void SimulatedController::wait(double dt_s) {
    silent_s_ += dt_s;
    if (hello_ && silent_s_ < hello_->watchdog_s) return;
    fall_in();
    if (lift_) equipment_.abort();
}

void SimulatedController::part() {
    fall_in();
    equipment_.abort();
    hello_.reset();
    lift_.reset();
    silent_s_ = 0;
}

}  // namespace pulseline::agent
