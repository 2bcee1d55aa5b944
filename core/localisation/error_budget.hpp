#pragma once

#include <string_view>
#include <vector>

#include "core/base/angle.hpp"
#include "core/plant/plant.hpp"

/// Everything that separates what a vehicle's program believes from what is, written down once. The
/// simulation draws the true machine and hall from it, seed by seed; a vehicle computes from it the
/// sigma that it states. One sigma each unless the comment says otherwise.
namespace pulseline::localisation {

/// Between a machine's true motion and what its wheels tell. The constants of a vehicle are drawn
/// once. Together they end a 20 m drive typically 3 to 8 mm and some hundredths of a degree off, as
/// Tang 2020 measured before correcting, and a move of some millimetres within a few tenths of one.
struct DriveErrors {
    // Geometry: what is left after calibration. Over 20 m the first gives 2 mm along.
    double diameter_common = 1e-4;      // share; temperature and load change all tyres alike
    double diameter_each = 1.2e-5;      // share; 20 m at 0.84 m between wheels: 0.02 deg
    double wheel_place = 3e-4;          // share of a wheel's place: scale of turns
    double steering_common_rad = 6e-5;  // all wheels askew: 1.2 mm across in 20 m
    double steering_each_rad = 3e-5;    // 20 m at 9.6 m between wheels: 0.004 deg, 0.6 mm across
    double play_m = 2e-4;               // lost motion of gear and tyre when the direction changes
    double scrub_m = 1e-4;              // wheels steered standing push the body by so much

    // Contact. Force over weight, divided by the stiffness, is the share lost.
    double creep_stiffness = 100;       // polyurethane on concrete: 2e-4 while 0.2 m/s2 accelerate
    double side_stiffness = 30;         // across, on a slope
    double roller_slip = 4e-4;          // share of a sideways motion on Mecanum rollers
    double roller_wander = 1.3;         // they wander across so many times as much as tyres do
    double grade = 1e-3;                // slope of the floor, each direction: within DIN 18202
    double wander_m_per_sqrt_m = 4e-4;  // random walk, along and across
    double wander_rad_per_sqrt_m = 8e-5;  // of the heading
    double wander_rad_per_sqrt_rad = 2e-4;
    double patch_every_m = 25;  // dust or oil below one wheel, at random on average so often
    double patch_m = 0.3;
    double patch_slip = 1e-3;  // share; 0.3 mm each

    // The chassis, when it stands.
    double settle_m = 8e-4;  // sag when it brakes from full speed
    double settle_rad = 8e-4;
    double fine_m = 5e-5;  // at least, in each stop
    double fine_rad = radians(0.003);
};

/// Between a camera and what the vehicle's program holds of it: constant over a vehicle's life.
struct CameraErrors {
    double mounting_m = 1e-4;         // of the place in the body, per axis
    double mounting_rad = 2e-4;       // about the plumb line
    double tilt_rad = radians(0.05);  // per axis; moves the foot by height x tilt, 0.40 mm alone
    double focal_share = 0.003;       // of F; with the height below the 1.5 % that a reader takes
    double principal_px = 0.5;        // per axis
    double k1 = 0.005;
    double height_m = 5e-4;
    double loaded_height_m = 0.001;  // besides: tyres and frame give under the load
};

/// Between a code as it lies on the floor and what the survey holds of it. Where it lies comes with
/// each marker (plant::Marker::sigma_xy_m).
struct MarkerErrors {
    double print_share = 5e-4;  // of the size: printers stretch
    double print_m = 5e-5;     // of the centre: ink that runs to one side, a sheet that is not flat
    double survey_rad = 5e-4;  // of its direction, where an order does not say it
};

/// Of the free-rolling measuring wheels that show slip (plant::SlipSensor has their noise).
struct SlipSensorErrors {
    double scale = 0.005;  // share of the speed; constant of a vehicle
};

/// Between a receiver of iGPS and what the vehicle's program holds of it. What is not known of the
/// transmitters comes with each (plant::Transmitter).
struct ReceiverErrors {
    double place_m = 2e-5;  // in the body, per axis, after calibration
    double clock_s = 1e-4;  // of its stamps against the wheels', while it drives
};

/// Between a navigation scanner and what the vehicle's program holds of it, and what it sees that
/// is none of its reflectors. Its noise comes with it (plant::NavigationScanner), the survey's
/// errors with each reflector.
struct ReflectorErrors {
    double mounting_m = 5e-4;    // of the scanner in the body, per axis, after calibration
    double mounting_rad = 3e-4;  // about the plumb line
    double clock_s = 1e-3;       // of its stamps against the wheels', while it drives
    double remission = 0.05;     // share: of how bright a ray comes back
    int shining_things = 2;      // in each hall: bare metal, a safety vest on a hook
};

struct ErrorBudget {
    DriveErrors drive;
    CameraErrors camera;
    MarkerErrors marker;
    ReceiverErrors receiver;
    ReflectorErrors reflector;
    SlipSensorErrors slip_sensor;

    /// A machine as it comes from assembly: tilt and F from the drawing. What is demanded of stops
    /// is demanded of this one.
    static ErrorBudget nominal() { return {}; }
    /// One whose cameras were calibrated where they are (`pulseline calibrate`), on a good floor.
    static ErrorBudget kind();
    /// One that nobody has looked after: everything twice the nominal.
    static ErrorBudget harsh();
    /// By its name; every other name is the nominal one's.
    static ErrorBudget named(std::string_view name);
};

/// What one kind of error does to a code's place.
struct ErrorTerm {
    std::string_view name;
    double sigma_m = 0;
};
/// The terms of code_sigma_m but the image's own noise.
std::vector<ErrorTerm> code_terms(const ErrorBudget& budget, const plant::Camera& camera,
                                  double offset_m, bool loaded = false);

/// Sigma per axis [m] of a code's place in the body frame, `offset_m` from the foot of the camera,
/// the image's own noise being `image_m` on the floor. Tilt and principal point move the foot; F,
/// height, lens and print stretch the offset. Without the survey's sigma.
double code_sigma_m(const ErrorBudget& budget, const plant::Camera& camera, double offset_m,
                    double image_m, bool loaded = false);
/// Of the direction of its "up" edge, `image_rad` being the image's own noise.
double code_sigma_rad(const ErrorBudget& budget, double image_rad);

}  // namespace pulseline::localisation
