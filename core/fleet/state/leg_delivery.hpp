#pragma once

#include <cstddef>
#include <optional>

#include "core/base/time.hpp"

namespace pulseline::fleet {

/// How far the VDA 5050 order of a leg has come on its way to its vehicle, and what of it is waited
/// for. All that may happen to it is one of the transitions below:
///
///     kPlanned --sent--> kSent --shown--> kSeen --lost--> kLost --> (the leg is dropped)
///        ^-----unanswered--/  \----------------lost-------^
///
/// From kSeen it is sent again with each longer base, which confirmed() ends. cancel() may come in
/// any phase; from then on nothing but instant actions goes out, until the leg is dropped.
class LegDelivery {
public:
    enum class Phase {
        kPlanned,  // no message of it is waited for: it has none yet, or had too many in vain
        kSent,     // until the vehicle shows its id
        kSeen,     // the vehicle has shown its id
        kLost,     // the vehicle does not have it, nor says where it stands
    };
    Phase phase() const;
    bool seen() const { return all_.seen; }
    bool lost() const { return all_.lost; }
    bool cancelling() const { return all_.cancelling; }
    /// When the newest message went out that the vehicle has not shown yet.
    std::optional<Time> unconfirmed_since() const { return all_.unconfirmed_since; }
    bool unconfirmed() const { return all_.unconfirmed_since.has_value(); }
    /// First node of the newest message, and how often it has gone out.
    std::size_t sent_from() const { return all_.sent_from; }
    int sends() const { return all_.sends; }
    /// Newest message of this leg on this connection; nullopt: none is under way on it.
    std::optional<Time> on_this_connection() const { return all_.on_this_connection; }
    /// When the vehicle showed it for the first time.
    std::optional<Time> started() const { return all_.started; }

    /// There is another leg, or none.
    void begin();
    /// A message with the nodes behind `from` goes out.
    void sent(std::size_t from, bool connected, Time now);
    /// The vehicle shows the leg's id; true when it does so for the first time.
    bool shown(Time now);
    /// The vehicle shows the newest update.
    void confirmed();
    /// Nobody answered as often as it may be sent; a person decides.
    void unanswered() { all_.unconfirmed_since.reset(); }
    /// A person lets it be sent as often again.
    void sent_anew() { all_.sends = 0; }
    /// What was under way on the old connection is lost.
    void reconnected() { all_.on_this_connection.reset(); }
    /// The vehicle does not have it any more, or never had it.
    void give_up();
    /// A cancelOrder goes out.
    void cancel();
    /// It ended in vain, and another one is to go out.
    void cancel_failed() { all_.cancelling = false; }

    /// For the journal only.
    struct All {
        bool seen = false;
        std::size_t sent_from = 0;
        std::optional<Time> unconfirmed_since;
        int sends = 0;
        std::optional<Time> on_this_connection;
        bool lost = false;
        bool cancelling = false;
        std::optional<Time> started;
    };
    All& all() { return all_; }
    const All& all() const { return all_; }

private:
    All all_;
};

}  // namespace pulseline::fleet
