#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "api/access/access_control.hpp"
#include "api/http/wire/message.hpp"
#include "api/vda5050/hand_held.hpp"
#include "api/vda5050/header.hpp"
#include "server/base/camera_store.hpp"
#include "server/base/metrics.hpp"
#include "server/base/net.hpp"
#include "server/base/options.hpp"
#include "server/base/pose_table.hpp"
#include "server/runtime/fleet_runtime.hpp"
#include "server/vehicles/link_budget.hpp"

namespace pulseline::server {

/// One open socket of a vehicle, as the gateway sees it.
class VehicleSocket {
public:
    virtual ~VehicleSocket() = default;
    virtual void send(std::string frame) = 0;
    virtual void close(std::uint16_t code, const char* reason) = 0;
};

/// An open page of the dashboard by which a person may drive one vehicle.
class HandHeldPage {
public:
    virtual ~HandHeldPage() = default;
    virtual void answer(const vda5050::HandAnswer& answer) = 0;
};

/// Between the vehicles' sockets and the fleet: who may connect as whom, what a frame means, what
/// is kept of a vehicle while it is away. Decides nothing about driving.
/// Thread safety: none, the network thread owns it.
class VehicleGateway {
public:
    struct Ports {
        const plant::Plant& plant;
        const Limits& limits;
        const Clock& clock;
        FleetRuntime& runtime;
        api::access::AccessControl& access;
        Metrics& metrics;
        CameraStore& images;
        PoseTable& poses;
    };
    explicit VehicleGateway(Ports ports) : ports_(ports) {}

    /// The vehicle a request may connect as, or the answer that refuses it.
    net::awaitable<tl::expected<plant::VehicleId, api::Response>> admit(api::Request& request,
                                                                        bool upgrade);

    void opened(const plant::VehicleId& id, const std::shared_ptr<VehicleSocket>& socket);
    void closed(const plant::VehicleId& id, const VehicleSocket* socket);
    void heard(const plant::VehicleId& id, const VehicleSocket* socket);
    void text(const plant::VehicleId& id, const VehicleSocket* socket, std::string_view frame);
    /// The newest message that came too soon, when its time has come.
    void take_withheld(const plant::VehicleId& id, const VehicleSocket* socket);
    void binary(const plant::VehicleId& id, const VehicleSocket* socket, std::string_view frame);

    /// Committed messages of the fleet. A vehicle without a socket gets none: the fleet sends
    /// again until it sees them in the vehicle's state.
    void send(const std::vector<fleet::VehicleMessage>& messages);
    /// Tells a fleet that was built anew who is connected, who is not, and what each one said last.
    void introduce_all();

    // What hand-held controls say goes past the fleet straight to the vehicle, whose program
    // decides between them; what it does of it its states tell.
    /// False when the vehicle has kMostControls of them open. `control` is a name nobody else has.
    bool hand_held_opened(const plant::VehicleId& id, const std::string& control,
                          const std::string& person, HandHeldPage& page);
    /// Answered through the page, by the vehicle, or for it with vehicle_not_connected.
    void hand_held(const plant::VehicleId& id, const std::string& control,
                   const vda5050::HandCommand& command);
    void hand_held_closed(const plant::VehicleId& id, const std::string& control);

    /// Newest retained payload of connection or factsheet; empty before the first.
    std::string retained(const plant::VehicleId& id, vda5050::Topic topic) const;

private:
    using Steady = std::chrono::steady_clock;
    /// All their answers together stay below what a vehicle may say.
    static constexpr std::size_t kMostControls = 3;
    /// So long a refused message is shown with the vehicle's own errors.
    static constexpr auto kShowRefused = std::chrono::seconds(60);
    /// Newest state on its way to the fleet: one waits at most, a newer one takes its place.
    struct StateSlot {
        std::mutex mutex;
        std::optional<vda5050::StateMessage> waiting;
    };
    struct HandHeld {
        std::string person;
        HandHeldPage* page = nullptr;
    };
    struct Row {
        std::shared_ptr<VehicleSocket> socket;
        std::deque<Steady::time_point> takeovers;
        Steady::time_point tell_heard_at{};
        std::map<vda5050::Topic, std::string> retained;
        std::optional<vda5050::StateMessage> passed;  // newest one that the fleet was given
        Steady::time_point pass_at{};                 // the next one, whatever it says
        std::shared_ptr<StateSlot> state = std::make_shared<StateSlot>();
        std::optional<vda5050::Factsheet> factsheet;
        std::optional<vda5050::VehicleError> refused;  // shown with the vehicle's own errors
        Steady::time_point refused_at{};
        std::optional<Steady::time_point> told_not_sent;
        int malformed_in_a_row = 0;
        std::optional<LinkBudget> budget;     // lasts longer than a connection
        std::optional<std::string> withheld;  // newest message beyond it
        Steady::time_point logged{};          // newest line about a refused message
        std::int64_t not_logged = 0;
        std::optional<vda5050::HeaderSource> headers;
        bool said_offline = false;
    };

    Row* current(const plant::VehicleId& id, const VehicleSocket* socket);
    void take_text(const plant::VehicleId& id, Row& row, std::string_view frame);
    LinkBudget& budget(Row& row);
    /// When a vehicle's turn comes again: each has a moment of its own in `every`.
    static Steady::time_point next_beat(const plant::VehicleId& id, Steady::time_point now,
                                        Duration every);
    void too_many(const plant::VehicleId& id, Row& row);
    void tell_not_connected(const plant::VehicleId& id) const;
    void pass_hand_answer(const plant::VehicleId& id, const vda5050::HandAnswerFrame& frame) const;
    void malformed(const plant::VehicleId& id, Row& row, const Error& error);
    void pass_state(const plant::VehicleId& id, Row& row, vda5050::StateMessage state);
    void hand_over_factsheet(const plant::VehicleId& id, const Row& row);
    void hand_over_state(const plant::VehicleId& id, const Row& row);
    void not_sent(const plant::VehicleId& id, Row& row, const char* why);
    void play_last_will(const plant::VehicleId& id, Row& row);
    vda5050::Header next_header(const plant::VehicleId& id, Row& row, vda5050::Topic topic);

    Ports ports_;
    std::map<plant::VehicleId, Row> rows_;
    std::map<plant::VehicleId, std::map<std::string, HandHeld>> hands_;  // by the controls' names
};

}  // namespace pulseline::server
