#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/tools/load/figures.hpp"
#include "tests/tools/load/machine_watch.hpp"
#include "tests/tools/load/peer.hpp"

namespace pulseline::load {

/// Programs that ask over REST: reads of all kinds, and orders that are cancelled when many are
/// open. They have a thread of their own: an answer must not wait until the frames of two hundred
/// dashboards were read.
class Askers {
public:
    struct Settings {
        std::uint16_t port = 0;
        std::string token;
        std::vector<std::string> vehicles;
        double requests_per_s = 20;
        double orders_per_s = 2;
    };
    Askers(Settings settings, const MachineWatch& machine);
    ~Askers();

    /// Asks from `start` to `end`; what was asked before `counts_from` is no figure.
    void begin(Clock::time_point start, Clock::time_point counts_from, Clock::time_point end);
    /// Waits for the end. The figures are whole then. Throws what ended the asking early.
    void join();
    const AskTotals& totals() const { return totals_; }

private:
    /// A connection that stays open and asks one thing after the other.
    struct Asker {
        std::unique_ptr<Peer> peer;
        Clock::time_point due;
        bool busy = false;
        bool orders = false;
        bool cancels = false;  // what it waits for now
    };

    void run(Clock::time_point start, Clock::time_point counts_from, Clock::time_point end);
    void ask(bool order, std::uint64_t index);
    void cancel_the_oldest();
    Asker* free_asker(bool order);
    void read(int timeout_ms);
    void take(Asker& asker, const Peer::Answer& answer);

    Settings settings_;
    const MachineWatch& machine_;
    std::vector<Asker> askers_;
    std::deque<std::string> open_orders_;
    AskTotals totals_;
    Clock::time_point counts_from_;
    std::exception_ptr error_;
    std::thread thread_;
};

}  // namespace pulseline::load
