#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "core/plant/plant.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// Segmented navigation as a vehicle keeps to it (Li 2022, section 4): which codes its order relies
/// on (segmentMarkers of observeMarkers) were passed without being read, and whether it should go
/// slowly. Behind a missed one it does until a code is read. Behind the boundary marker only if it
/// knows its place so badly that three sigma reach out of its cameras' view: what it does not know
/// there, driving slowly does not teach it, but the station's codes are then looked for from near.
/// Thread safety: none.
class SegmentWatch {
public:
    static constexpr const char* kMissed = "segmentMarkerMissed";  // type of the error it reports
    /// In the vehicle's own time: what knows too little, or is told to go precisely, goes no
    /// faster.
    static constexpr double kPrecise_mps = 0.3;

    explicit SegmentWatch(plant::VehicleType type) : type_(std::move(type)) {}

    /// After each step. `ahead`: as MarkerWatch::step; `read`: payloads taken in this step; `way_m`
    /// driven in it; `sigma_m`: of the believed place, its worse axis.
    void step(const std::deque<vda5050::OrderEdge>& ahead, std::span<const std::string> read,
              double way_m, double sigma_m);

    /// Segment markers passed unread since a code was read last; of this drive.
    const std::vector<std::string>& missed() const { return missed_; }
    /// From the boundary marker to the stop.
    bool precise() const { return precise_; }
    /// Of every speed, at most.
    double speed_share() const;
    void write_state(vda5050::StateMessage& state) const;

private:
    struct Awaited {
        std::string payload;
        std::int64_t sequence_id = 0;  // of the last edge that has it
        double size_m = 0;
        bool boundary = false;
        bool read = false;
        double behind_m = 0;  // driven since that edge
    };

    void follow(const std::deque<vda5050::OrderEdge>& ahead);
    std::vector<Awaited> awaited_on(const std::deque<vda5050::OrderEdge>& ahead) const;
    void note_read(std::span<const std::string> payloads);
    void note_missed(double way_m);
    void enter_precise(const Awaited& boundary);

    plant::VehicleType type_;
    std::vector<Awaited> ahead_;
    std::vector<Awaited> behind_;
    std::vector<std::string> missed_;
    // What `ahead_` was made of.
    std::size_t edges_ = 0;
    std::int64_t first_sequence_id_ = 0;
    bool precise_ = false;
    double in_view_m_ = 0;  // of the cameras, for codes like the boundary marker
    bool unsure_ = false;
};

}  // namespace pulseline::onboard
