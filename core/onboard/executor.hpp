#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/onboard/acceptance.hpp"
#include "core/onboard/drive.hpp"
#include "core/onboard/equipment.hpp"
#include "core/onboard/hand_drive.hpp"
#include "core/onboard/stop_procedure.hpp"
#include "core/onboard/way_ahead.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// Obeys orders and instant actions as VDA 5050 2.1 asks: takes or rejects them, drives the base
/// and never past it, reports nodes, runs actions. A drive that has stopped of itself is let go on
/// by what a person sends: stopPause, initPosition, or the end of a cancelOrder. Its state lives in
/// memory only: a restarted vehicle knows no order and no pose. Thread safety: none. No clock: time
/// passes by step().
class Executor {
public:
    /// `equipment` may be null: it measures and drives only.
    Executor(Drive& motion, StopSensing& sensing, std::string map_id,
             Equipment* equipment = nullptr, control::MotionCompensation compensation = {});

    /// As StopProcedure::see, which see.
    void see(const std::vector<control::Scan>& seen) { procedure_.see(seen); }
    void handle(const vda5050::OrderMessage& order);
    void handle(const vda5050::InstantActionsMessage& message);
    /// A message that could not be understood, or a fault of the vehicle; reported until the next
    /// accepted order.
    void report(vda5050::VehicleError error);
    void step(double dt_s);

    /// Somebody drives the vehicle with a hand-held control from now on: it brakes, gives up its
    /// order and takes none (operatingMode MANUAL). Where it stands it still tells, and may be
    /// told. A drive that has stopped of itself is let go on, unless what stopped it is still
    /// there.
    void take_by_hand();
    /// A zero twist lets go, by which a drive that has stopped of itself may go on. Fails with
    /// conflict not_in_hand {}; let_go_first {} after a pause that came meanwhile, which brakes it,
    /// until somebody lets go; held {} on its feet or plugged in; the cause for which the drive has
    /// stopped; or cannot_move_so as HandDrive says.
    Status drive_by_hand(const kinematics::Twist& wanted);
    /// It brakes, if it is in hand. Nobody has let go by that: what a pause or a drive that has
    /// stopped of itself asks for is still to be done.
    void brake_by_hand();
    /// Gives it back; it waits for an order. Fails with not_in_hand {} and still_moving {}.
    Status give_back();
    bool in_hand() const { return in_hand_; }

    // Going round something that stands on its line; who looks out plans it.
    /// It stands in an order with nothing else to do than to drive on.
    bool may_go_round() const;
    const WayAhead& way_ahead() const { return way_; }
    /// As WayAhead says, which see. REQUIRES: may_go_round().
    void go_round(const planning::Detour& detour);
    /// Asks for a longer base while `wanted`, where there is a horizon to take it from.
    void ask_for_base(bool wanted) { base_wanted_ = wanted; }

    /// Order, action, drive and pose fields of the state.
    void write_state(vda5050::StateMessage& state) const;
    /// True once after anything happened that must be reported at once.
    bool take_changed();
    bool take_factsheet_request();

    bool position_initialized() const { return position_initialized_; }
    /// Where it was told to stand, once.
    std::optional<vda5050::InitPosition> take_told() { return std::exchange(told_, std::nullopt); }
    /// It does not know where it is any more: it brakes, stays and tells why until somebody, or a
    /// code below it, says where it stands.
    void lose_pose(vda5050::VehicleError why);
    /// Of iGPS, by the newest setTransmitters; they stay when the link is lost.
    const std::vector<plant::Transmitter>& transmitters() const { return transmitters_; }
    /// For its navigation scanner, by the newest setReflectors; they stay the same way.
    const std::vector<plant::Reflector>& reflectors() const { return reflectors_; }
    const std::string& order_id() const { return order_id_; }
    std::int64_t last_node_sequence_id() const { return last_node_sequence_id_; }
    /// sequenceId of the last released node: the vehicle never drives past it.
    std::int64_t base_end_sequence_id() const { return base_end_.sequence_id; }
    /// What the vehicle has learned of its small moves, to be kept for its next start.
    const control::MotionCompensation& compensation() const { return procedure_.compensation(); }
    bool acting() const { return procedure_.running(); }
    /// The line to who gives commands is cut. Brackets and feet that move stay where they are, and
    /// what moved them has failed: whoever looks at them lets them go on. A drive goes on.
    void lose_link();
    /// While `held` it begins no way where it stands, since it knows too little where that is or
    /// its drive has still to be led to the pose that it knows: some time after a person's word. On
    /// its way it drives on.
    void hold(bool held) { held_ = held; }
    /// It would drive, were it not held.
    bool waits_to_begin() const;
    /// Codes read under way: the result of observeMarkers on the edge being driven.
    void note_codes(const std::vector<std::string>& payloads);

private:
    void start_order(const vda5050::OrderMessage& order);
    void extend_order(const vda5050::OrderMessage& order);
    void append(const vda5050::OrderMessage& order);
    void traverse(const vda5050::OrderNode& node);
    void take_traversals();
    void finish_on_edge(const vda5050::Action& action);
    std::string take_codes_read_on(const vda5050::Action& action);
    void queue_edges();
    void run_actions(double dt_s);
    void run_equipment();
    void note_equipment_end();
    void run_lift();
    void hold_equipment();
    void stop_equipment(const char* why);
    void finish_stop(const StopProcedure::Outcome& outcome);
    void know_pose();
    void finish_cancel();
    void finish_pause();
    void note_motion();
    void drop_order();
    void step_in_hand(double dt_s);

    void handle_instant(const vda5050::Action& action);
    void cancel_order(const vda5050::Action& action);
    /// What an order still has to do fails for this reason.
    void abort_actions(const char* why);
    void init_position(const vda5050::Action& action);
    void set_transmitters(const vda5050::Action& action);
    void set_reflectors(const vda5050::Action& action);
    void instant_stop(const vda5050::Action& action);
    void instant_equipment(const vda5050::Action& action);
    void instant_lift(const vda5050::Action& action);
    bool has_lifts() const;
    bool can_lift(const std::string& action_type) const;

    OrderContext context() const;
    bool order_done() const { return way_.empty() && waiting_.empty(); }
    vda5050::ActionState* find_action(const std::string& id);
    void add_action(const vda5050::Action& action, vda5050::ActionStatus status,
                    std::string result = {});
    void set_action(const std::string& id, vda5050::ActionStatus status, std::string result = {});
    void forget_old_instant_actions();

    Drive& motion_;
    StopProcedure procedure_;
    Equipment* equipment_;
    std::string map_id_;

    std::string order_id_;
    std::int64_t order_update_id_ = 0;
    WayAhead way_;
    std::string last_node_id_;
    std::int64_t last_node_sequence_id_ = 0;
    vda5050::NodeState base_end_;

    std::deque<vda5050::Action> waiting_;  // of the node it stands on, first one running
    std::string running_stop_;             // id of the action in the procedure
    std::string running_equipment_;        // id of the action that the equipment is at
    std::string running_lift_;             // id of the instant action that moves brackets or feet
    std::string cancel_id_;                // of the cancelOrder at work
    std::string pause_id_;
    HandDrive hand_;
    bool cancelled_ = false;
    bool paused_ = false;
    bool in_hand_ = false;
    bool must_let_go_ = false;  // a pause came while it was in hand
    bool held_ = false;
    bool equipment_held_ = false;  // by a pause, in the middle of running_equipment_

    std::vector<vda5050::ActionState> order_actions_;
    std::vector<vda5050::ActionState> instant_actions_;
    std::vector<std::string> codes_read_;         // on the edge being driven
    vda5050::Action edge_passed_;                 // what was to be read on the last one with codes
    std::vector<std::string> codes_read_before_;  // on the last one with codes
    std::vector<vda5050::VehicleError> errors_;
    std::vector<plant::Transmitter> transmitters_;
    std::vector<plant::Reflector> reflectors_;
    bool position_initialized_ = false;
    std::optional<vda5050::InitPosition> told_;
    std::optional<vda5050::VehicleError> lost_;  // why it does not know where it is any more
    bool driving_ = false;
    bool stopped_ = false;      // by the drive itself
    bool base_wanted_ = false;  // to go round something
    bool new_base_request_ = false;
    bool changed_ = true;
    bool factsheet_requested_ = false;
};

}  // namespace pulseline::onboard
