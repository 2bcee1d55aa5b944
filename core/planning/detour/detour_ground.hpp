#pragma once

#include <optional>
#include <vector>

#include "core/planning/detour/detour.hpp"
#include "core/planning/manoeuvre/free_manoeuvre.hpp"
#include "core/planning/manoeuvre/manoeuvre_room.hpp"

namespace pulseline::planning {

/// The floor that a detour may use, as a hall of its own in the frame of the line: origin at the
/// beginning of the stretch, x along the way, y to the left. Its walls are drawn so that a body
/// which keeps kDetourClearance_m to them keeps the margin to the band.
/// Thread safety: any number of threads may read it.
class DetourGround {
public:
    /// REQUIRES: the stretch is not empty.
    explicit DetourGround(const DetourRequest& request);

    const geometry::Pose2& hall_from_line() const { return hall_from_line_; }
    const plant::VehicleType& type() const { return type_; }
    bool loaded() const { return loaded_; }
    const FreeFloor& floor() const { return floor_; }
    const std::vector<StandingBody>& things() const { return things_; }
    const geometry::Pose2& start() const { return start_; }
    double heading_rad() const { return heading_rad_; }  // of the body on the line
    /// Where the edges end; x, ascending.
    const std::vector<double>& ends_m() const { return ends_m_; }
    geometry::Pose2 on_line(double x_m) const { return {x_m, 0, heading_rad_}; }
    /// Farthest that the centre may be beside the line anywhere, to the left and to the right.
    double most_left_m() const { return most_left_m_; }
    double most_right_m() const { return most_right_m_; }

    /// Room for a way from `start` to `goal`, to check it with.
    ManoeuvreRoom room(const geometry::Pose2& start, const geometry::Pose2& goal) const;
    /// Where the body driving along the line from `from_m` comes too near to something first.
    std::optional<double> first_barred_m(double from_m) const;
    /// Whether the body may stand on the line there.
    bool is_free_on_line(double x_m) const;

private:
    plant::VehicleType type_;  // with the clearance of a detour
    bool loaded_ = false;
    geometry::Pose2 hall_from_line_;
    double heading_rad_ = 0;
    geometry::Pose2 start_;
    std::vector<double> ends_m_;
    std::vector<geometry::Polygon> body_;  // pieces, body frame
    geometry::Box on_line_;                // of the body on the line, about its centre
    double most_left_m_ = 0;
    double most_right_m_ = 0;
    plant::Hall hall_;
    FreeFloor floor_;
    std::vector<StandingBody> things_;

    plant::Hall make_hall(const DetourRequest& request);
    void take_things(const std::vector<geometry::Point2>& seen);
};

}  // namespace pulseline::planning
