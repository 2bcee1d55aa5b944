#include "tests/simulation/fleet_judge_journal.hpp"

#include <utility>

namespace pulseline::fleet_judge {
namespace {

using namespace fleet::journal;

constexpr std::uint64_t kCompareEvery = 97;   // steps
constexpr std::uint64_t kRestoreEvery = 997;  // steps

std::string bytes_of(const fleet::Outputs& out) {
    Writer writer;
    writer.put(out);
    return writer.take();
}

std::string first_difference(const std::string& a, const std::string& b) {
    std::size_t at = 0;
    while (at < std::min(a.size(), b.size()) && a[at] == b[at]) ++at;
    return "at byte " + std::to_string(at) + " of " + std::to_string(a.size()) + " and " +
           std::to_string(b.size());
}

}  // namespace

void Shadow::follow(fleet::Fleet& judged) {
    fleet_.reset();
    recorder_.clear();
    judged.journal_into(&recorder_);
}

std::string Shadow::step(std::unique_ptr<fleet::Fleet>& judged, const fleet::Outputs& out) {
    ++steps_;
    inputs += recorder_.inputs();
    const std::string journal = recorder_.take();
    input_bytes += journal.size();
    const std::string found = compare(*judged, journal, out);
    if (!found.empty() || steps_ % kRestoreEvery != 0) return found;
    const std::string bytes = judged->snapshot();
    ++snapshots;
    snapshot_bytes += bytes.size();
    auto shadow = fleet::Fleet::from_snapshot(plant_, bytes);
    auto other = fleet::Fleet::from_snapshot(plant_, bytes);
    if (!shadow || !other) return "its snapshot is refused: " + shadow.error().what;
    if ((*shadow)->snapshot() != bytes) {
        return "a snapshot of the restored fleet differs " +
               first_difference(bytes, (*shadow)->snapshot());
    }
    fleet_ = std::move(*shadow);
    if (steps_ / kRestoreEvery % 2 == 0) {
        judged = std::move(*other);
        judged->journal_into(&recorder_);
    }
    return {};
}

std::string Shadow::compare(const fleet::Fleet& judged, const std::string& journal,
                            const fleet::Outputs& out) {
    if (!fleet_) return {};
    const auto entries = decode(journal);
    if (!entries) return "its journal is refused: " + entries.error().what;
    fleet::Outputs replayed;
    for (const Entry& entry : *entries) {
        apply(*fleet_, entry, [&](fleet::Outputs&& taken, Time) { replayed = std::move(taken); });
    }
    const std::string expected = bytes_of(out);
    if (const std::string found = bytes_of(replayed); found != expected) {
        return "its replay puts out something else " + first_difference(expected, found);
    }
    if (steps_ % kCompareEvery != 0) return {};
    const std::string expected_state = judged.snapshot();
    const std::string state = fleet_->snapshot();
    if (state == expected_state) return {};
    return "its replay is in another state " + first_difference(expected_state, state);
}

}  // namespace pulseline::fleet_judge
