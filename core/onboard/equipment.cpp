#include "core/onboard/equipment.hpp"

#include <sstream>
#include <utility>
#include <variant>

namespace pulseline::onboard {

std::string sentence_of(const Reason& reason) {
    std::ostringstream text;
    text << reason.code;
    const char* between = ": ";
    for (const Param& param : reason.params) {
        text << std::exchange(between, ", ") << param.name << ' ';
        if (const auto* name = std::get_if<std::string>(&param.value)) text << *name;
        if (const auto* real = std::get_if<double>(&param.value)) text << *real;
    }
    return text.str();
}

}  // namespace pulseline::onboard
