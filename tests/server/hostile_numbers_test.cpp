// Every number of every message of a vehicle is set to what no vehicle can mean, and goes the whole
// way: decoder, fleet, and the encoders of what the fleet puts out.
#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <charconv>

#include "api/vda5050/connection.hpp"
#include "api/vda5050/factsheet.hpp"
#include "api/vda5050/frame.hpp"
#include "api/vda5050/instant_actions.hpp"
#include "api/vda5050/order.hpp"
#include "api/vda5050/visualization.hpp"
#include "tests/api/vda5050/samples.hpp"
#include "tests/server/message_path.hpp"

namespace pulseline::server::testing {
namespace {

using vda5050::Json;

// Each with its opposite, for where two of them meet.
constexpr std::array<std::array<const char*, 2>, 12> kHostile{
    {{"1.7e308", "-1.7e308"},
     {"-1.7e308", "1.7e308"},
     {"1e300", "-1e300"},
     {"-1e300", "1e300"},
     {"5e-324", "-5e-324"},
     {"1e-300", "5e-324"},
     {"-0", "-0.0"},
     {"NaN", "Infinity"},
     {"nan", "-inf"},
     {"1e999", "-1e999"},
     {"9223372036854775808", "-9223372036854775809"},
     {"18446744073709551616", "-18446744073709551616"}}};

/// A message in pieces: behind piece i stands number i. Numbers are found wherever they are, also
/// within texts and in JSON within texts.
class Numbers {
public:
    explicit Numbers(Json message) {
        mark(message);
        std::string rest = message.dump();
        for (std::size_t at = rest.find(kMark); at != std::string::npos; at = rest.find(kMark)) {
            pieces_.push_back(rest.substr(0, at));
            rest.erase(0, at + kMark.size());
        }
        pieces_.push_back(rest);
        // A number stands without the quotes that its mark was given.
        for (std::size_t i = 0; i < numbers_.size(); ++i) {
            if (numbers_[i].is_text) continue;
            for (const std::string_view quote : {"\\\"", "\""}) {
                if (!pieces_[i].ends_with(quote)) continue;
                pieces_[i].erase(pieces_[i].size() - quote.size());
                pieces_[i + 1].erase(0, quote.size());
                break;
            }
        }
    }
    std::size_t size() const { return numbers_.size(); }

    /// Number i as `first`, the next one as `second` unless that is null.
    std::string with(std::size_t i, const char* first, const char* second = nullptr) const {
        std::string text = pieces_[0];
        for (std::size_t k = 0; k < numbers_.size(); ++k) {
            text += k == i ? first : k == i + 1 && second != nullptr ? second : numbers_[k].text;
            text += pieces_[k + 1];
        }
        return text;
    }
    std::string unchanged() const { return with(size(), ""); }
    /// What stands before the number, for messages of tests.
    std::string before(std::size_t i) const {
        const auto& piece = pieces_[i];
        return piece.substr(piece.size() - std::min<std::size_t>(piece.size(), 60));
    }

private:
    static constexpr std::string_view kMark = "#number#";
    struct Number {
        std::string text;
        bool is_text;
    };

    static bool is_number(const std::string& text) {
        double read = 0;
        const auto end = text.data() + text.size();
        return !text.empty() && std::from_chars(text.data(), end, read).ptr == end;
    }
    void mark(Json& value) {
        if (value.is_number()) {
            numbers_.push_back({value.dump(), false});
            value = kMark;
        } else if (value.is_string() && is_number(value.get_ref<const std::string&>())) {
            numbers_.push_back({value.get<std::string>(), true});
            value = kMark;
        } else if (value.is_string() && value.get_ref<const std::string&>().starts_with('{')) {
            Json inner = Json::parse(value.get_ref<const std::string&>());
            mark(inner);
            value = inner.dump();
        } else if (value.is_structured()) {
            for (auto& item : value) mark(item);
        }
    }

    std::vector<Number> numbers_;
    std::vector<std::string> pieces_;
};

std::string frame(const char* topic, const std::string& payload) {
    return std::string(R"({"topic":")") + topic + R"(","retain":false,"payload":)" + payload + "}";
}

void try_all(MessagePath& path, const char* topic, const std::string& payload,
             std::size_t least_numbers) {
    const Numbers numbers(Json::parse(payload));
    EXPECT_GE(numbers.size(), least_numbers);
    ASSERT_TRUE(path.give(frame(topic, numbers.unchanged())).taken);
    ASSERT_EQ(path.go_on(), "");
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        for (const auto& [value, opposite] : kHostile) {
            for (const char* next : {static_cast<const char*>(nullptr), opposite}) {
                path.reset();
                const auto outcome = path.give(frame(topic, numbers.with(i, value, next)));
                const auto where = [&] {
                    return numbers.before(i) + " " + value + (next ? next : "");
                };
                EXPECT_EQ(outcome.broken, "") << where();
                if (outcome.taken) {
                    EXPECT_EQ(path.go_on(), "") << where();
                }
            }
        }
    }
}

TEST(HostileNumbers, OfAVehicleThatIsLostAndSeesACode) {
    MessagePath path(Situation::kLost);
    Json payload = Json::parse(path.state_payload());
    for (auto& entry : payload["information"]) {
        for (auto& reference : entry["infoReferences"])
            if (reference["referenceKey"] == "angle_rad") reference["referenceValue"] = "0.785";
    }
    try_all(path, "state", payload.dump(), 20);
}

TEST(HostileNumbers, OfAVehicleThatDrives) {
    MessagePath path(Situation::kDriving);
    try_all(path, "state", path.state_payload(), 25);
}

TEST(HostileNumbers, OfAVehicleThatHasMeasuredItsStop) {
    MessagePath path(Situation::kAtStop);
    const std::string payload = path.state_payload();
    ASSERT_NE(payload.find("sigma_heading_rad"), std::string::npos);
    try_all(path, "state", payload, 25);
}

TEST(HostileNumbers, OfAPlacedVehiclesOtherMessages) {
    MessagePath path(Situation::kPlaced);
    const vda5050::Header header{7, "2026-01-31T12:00:00.123Z", "test", "V1"};
    const auto type = vda5050::testing::vehicle_type();
    vda5050::FactsheetSource source;
    source.type = &type;
    source.node_actions = {"measureStop", "adjustToMarker"};
    try_all(path, "factsheet", vda5050::encode_factsheet(source, header), 20);
    path.reset();
    try_all(path, "visualization",
            vda5050::encode_visualization({{1, 2, 3}, true, 0.4, -0.1}, "h1", header), 6);
    path.reset();
    try_all(path, "connection",
            vda5050::encode_connection(vda5050::ConnectionState::kOnline, header), 1);
}

TEST(HostileNumbers, OfAStateAreRefusedByTheNameOfTheirField) {
    MessagePath path(Situation::kLost);
    const Numbers numbers(Json::parse(path.state_payload()));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        for (const char* value : {"1.7e308", "-1e300", "1e999"}) {
            path.reset();
            const auto outcome = path.give(frame("state", numbers.with(i, value)));
            EXPECT_FALSE(outcome.taken) << numbers.before(i) << value;
        }
    }
    Json payload = Json::parse(path.state_payload());
    payload["information"].back()["infoReferences"][0]["referenceValue"] = "1e300";
    const auto at = "/information/" + std::to_string(payload["information"].size() - 1);
    EXPECT_EQ(path.give(frame("state", payload.dump())).refused,
              at + "/infoReferences/0/referenceValue out_of_range");
}

/// What the server sends, as an agent reads it.
TEST(HostileNumbers, OfOrdersAndActionsNeverComeOutOfTheDecoder) {
    const auto header = vda5050::testing::header();
    const Numbers orders(Json::parse(vda5050::encode_order(vda5050::testing::order(), header)));
    const Numbers actions(
        Json::parse(vda5050::encode_instant_actions(vda5050::testing::instant_actions(), header)));
    int taken = 0;
    const auto read = [&](const std::string& text) {
        const auto value = json::parse_json(text, {32, 100'000});
        if (!value) return;
        if (const auto order = vda5050::decode_order(*value)) {
            EXPECT_NO_THROW((void)vda5050::encode_order(*order, header)) << text;
            ++taken;
        }
        if (const auto message = vda5050::decode_instant_actions(*value)) {
            EXPECT_NO_THROW((void)vda5050::encode_instant_actions(*message, header)) << text;
            ++taken;
        }
    };
    for (const Numbers* message : {&orders, &actions}) {
        for (std::size_t i = 0; i < message->size(); ++i) {
            for (const auto& [value, opposite] : kHostile) {
                read(message->with(i, value));
                read(message->with(i, value, opposite));
            }
        }
    }
    EXPECT_GT(taken, 100);
}

}  // namespace
}  // namespace pulseline::server::testing
