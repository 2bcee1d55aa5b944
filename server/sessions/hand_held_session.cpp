#include "api/vda5050/hand_held.hpp"
#include "server/base/signal.hpp"
#include "server/sessions/sessions.hpp"

namespace pulseline::server {
namespace {

constexpr auto kRecheckHand = std::chrono::seconds(1);  // is the session behind it still good
constexpr auto kHandCloseTime = std::chrono::seconds(1);
/// A page says something several times a second; who says nothing has gone.
constexpr auto kHandGone = std::chrono::seconds(3);
constexpr std::size_t kMostHandBytes = 1024;
constexpr int kMostHandPerSecond = 30;
constexpr std::size_t kMostHandAnswers = 64;  // that wait for a slow reader

class Control : public HandHeldPage {
public:
    Control(Context& c, ByteStream stream, const api::Request& request, plant::VehicleId id)
        : context(c),
          socket(std::move(stream), {.most_bytes = kMostHandBytes, .idle = kHandGone}),
          identity(request.identity),
          vehicle(std::move(id)),
          name(request.request_id),
          signal(c.io) {}

    void answer(const vda5050::HandAnswer& answer) override {
        if (outbox.size() >= kMostHandAnswers) return close(1013, "too slow, come back");
        outbox.push_back(vda5050::print(vda5050::hand_answer_json(answer)));
        signal.set();
    }
    void close(std::uint16_t code, const char* reason) {
        if (close_with == 0) {
            close_with = code;
            close_reason = reason;
        }
        signal.set();
    }

    Context& context;
    WebSocket socket;
    api::access::Identity identity;
    plant::VehicleId vehicle;
    std::string name;
    Signal signal;
    std::deque<std::string> outbox;
    bool ended = false;  // the reader saw the end
    std::uint16_t close_with = 0;
    const char* close_reason = "";
};

net::awaitable<void> write_answers(std::shared_ptr<Control> control) {
    auto& context = control->context;
    while (!control->ended && control->close_with == 0) {
        if (!context.access.still_valid(control->identity, context.clock.now())) {
            control->close(4401, "signed out");
            break;
        }
        if (control->outbox.empty()) {
            co_await control->signal.wait(kRecheckHand);
            continue;
        }
        const std::string text = std::move(control->outbox.front());
        control->outbox.pop_front();
        if (co_await control->socket.write(text)) break;
    }
    if (control->close_with != 0 && !control->ended) {
        net::steady_timer timer(context.io, kHandCloseTime);
        timer.async_wait([control](const error_code& ec) {
            if (!ec) control->socket.cancel();
        });
        co_await control->socket.close(control->close_with, control->close_reason);
        timer.cancel();
    }
    control->socket.close_now();
}

void take_command(Control& control, std::string_view text) {
    auto& context = control.context;
    const auto command = vda5050::decode_hand_command(text);
    if (!command) {
        vda5050::HandAnswer refused;
        refused.refused = command.error();
        return control.answer(refused);
    }
    // Whoever drives is at work, also when nothing else is pressed for half an hour.
    if (command->what != vda5050::HandCommand::What::kWhere)
        context.access.touch(control.identity, context.clock.now());
    context.gateway.hand_held(control.vehicle, control.name, *command);
}

net::awaitable<void> read_commands(std::shared_ptr<Control> control) {
    auto window = std::chrono::steady_clock::now();
    int count = 0;
    while (control->close_with == 0) {
        if (co_await control->socket.read()) break;
        const auto now = std::chrono::steady_clock::now();
        if (now - window >= std::chrono::seconds(1)) {
            window = now;
            count = 0;
        }
        if (++count > kMostHandPerSecond) {
            control->close(1008, "too many messages");
        } else if (control->close_with == 0) {
            take_command(*control, control->socket.message());
        }
    }
    control->ended = control->close_with == 0;
    control->signal.set();
}

void log_hand_end(const std::exception_ptr& error) {
    try {
        if (error) std::rethrow_exception(error);
    } catch (const std::exception& e) {
        log::error("hand_held_session_threw", {{"what", e.what()}});
    }
}

}  // namespace

net::awaitable<void> hand_held_session(Context& context, ByteStream stream, Upgrade upgrade,
                                       api::Request request, plant::VehicleId vehicle) {
    error_code ec;
    stream.lowest().socket().set_option(tcp::no_delay(true), ec);
    auto control = std::make_shared<Control>(context, std::move(stream), request, vehicle);
    const WebSocket::Headers headers{{"X-Request-Id", request.request_id}};
    if (co_await control->socket.accept(upgrade, headers)) co_return;
    if (!context.gateway.hand_held_opened(vehicle, control->name, control->identity.name,
                                          *control)) {
        control->close(1013, "too many controls of this vehicle");
    }
    struct Closer {
        Control& control;
        ~Closer() { control.context.gateway.hand_held_closed(control.vehicle, control.name); }
    };
    const Closer closer{*control};
    const StopList::Entry stop(context.stops, [control] { control->close(1001, "server stops"); });
    net::co_spawn(context.io, read_commands(control), log_hand_end);
    co_await write_answers(control);
}

}  // namespace pulseline::server
