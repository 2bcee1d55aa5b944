#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/fleet/journal/recorder.hpp"

/// A second fleet beside the judged one: made from its snapshot in the midst of everything and fed
/// with its journal alone. Outputs and snapshots must be the same to the last byte. Now and then
/// the judged one is itself replaced by what its snapshot says, which no law may notice.
namespace pulseline::fleet_judge {

class Shadow {
public:
    explicit Shadow(const plant::Plant& plant) : plant_(plant) {}

    /// A server has started: nothing of the one before counts.
    void follow(fleet::Fleet& judged);
    /// The judged fleet's outputs were taken. Empty: all is the same; else what is not.
    std::string step(std::unique_ptr<fleet::Fleet>& judged, const fleet::Outputs& out);

    std::uint64_t inputs = 0;
    std::uint64_t input_bytes = 0;
    std::uint64_t snapshots = 0;
    std::uint64_t snapshot_bytes = 0;

private:
    std::string compare(const fleet::Fleet& judged, const std::string& journal,
                        const fleet::Outputs& out);

    const plant::Plant& plant_;
    fleet::journal::Recorder recorder_;
    std::unique_ptr<fleet::Fleet> fleet_;
    std::uint64_t steps_ = 0;
};

}  // namespace pulseline::fleet_judge
