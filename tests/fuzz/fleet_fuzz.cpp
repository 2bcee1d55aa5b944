// The bytes spoil states that a vehicle sends in the middle of its work, and these go the whole way
// that a message of a vehicle goes: decoder, fleet, and the encoders of what the fleet puts out.
// Ten bytes an edit: which value of the message, what is done to it, eight bytes of a number. A
// frame written out (it begins with a brace) goes in as it is.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "api/vda5050/frame.hpp"
#include "tests/server/message_path.hpp"

namespace {

using namespace pulseline;
using server::testing::MessagePath;
using server::testing::Situation;
using vda5050::Json;

struct Case {
    explicit Case(Situation situation)
        : path(situation), payload(Json::parse(path.state_payload())) {}
    MessagePath path;
    Json payload;
};

Case& case_of(unsigned char byte) {
    static const std::array<std::unique_ptr<Case>, 4> kCases{
        std::make_unique<Case>(Situation::kLost), std::make_unique<Case>(Situation::kPlaced),
        std::make_unique<Case>(Situation::kDriving), std::make_unique<Case>(Situation::kAtStop)};
    return *kCases[byte % kCases.size()];
}

void leaves(Json& value, std::vector<Json*>& found) {
    if (!value.is_structured() || value.empty()) {
        found.push_back(&value);
        return;
    }
    for (auto& item : value) leaves(item, found);
}

void edit(Json& payload, const unsigned char* bytes) {
    std::vector<Json*> values;
    leaves(payload, values);
    Json& value = *values[bytes[0] % values.size()];
    double number = 0;
    std::int64_t integer = 0;
    std::memcpy(&number, bytes + 2, sizeof number);
    std::memcpy(&integer, bytes + 2, sizeof integer);
    switch (bytes[1] % 9) {
        case 0:
            value = number;
            break;
        case 1:
            value = integer;
            break;
        case 2:
            value = std::to_string(number);
            break;
        case 3:
            value = integer % 2 == 0;
            break;
        case 4:
            value = nullptr;
            break;
        case 5:
            value = *values[static_cast<std::size_t>(bytes[2]) % values.size()];
            break;
        case 6:
            value = static_cast<double>(integer % 100'000) / 1000;
            break;
        case 7:
            value = integer % 64;
            break;
        default: {
            const Json measured{{"x_m", number}, {"y_m", integer % 100}, {"heading_rad", 0.1}};
            value = measured.dump();
        }
    }
}

void demand(const std::string& broken) {
    if (broken.empty()) return;
    std::fprintf(stderr, "a number that is none came out: %s\n", broken.c_str());
    std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    constexpr std::size_t kEdit = 10;
    if (size < 1) return 0;
    Case& chosen = case_of(data[0]);
    chosen.path.reset();
    if (data[0] == '{') {
        const auto outcome = chosen.path.give({reinterpret_cast<const char*>(data), size});
        demand(outcome.broken);
        if (outcome.taken) demand(chosen.path.go_on());
        return 0;
    }
    Json payload = chosen.payload;
    for (std::size_t at = 1, edits = 0; at + kEdit <= size && edits < 12; at += kEdit, ++edits) {
        edit(payload, data + at);
    }
    const auto frame = vda5050::encode_frame(vda5050::Topic::kState, false, payload.dump());
    const auto outcome = chosen.path.give(frame);
    demand(outcome.broken);
    if (outcome.taken) demand(chosen.path.go_on());
    return 0;
}
