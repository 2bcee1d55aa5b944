#include "server/agent/learned_moves.hpp"

#include <fstream>
#include <iterator>
#include <utility>

#include "api/json/object_reader.hpp"
#include "api/json/parse.hpp"
#include "api/plant/occupancy_file.hpp"

namespace pulseline::agent {
namespace {

using control::DrivenPass;
using control::Move;
using control::MoveKind;
using json::Json;

constexpr json::CountLimits kMost{0, 1000};

const char* to_string(MoveKind kind) {
    switch (kind) {
        case MoveKind::kAdvance:
            return "advance";
        case MoveKind::kLateral:
            return "lateral";
        case MoveKind::kTurn:
            return "turn";
    }
    return "";
}

Json encode(const DrivenPass& pass) {
    Json moves = Json::array();
    for (const Move& move : pass.moves) {
        moves.push_back({{"kind", to_string(move.kind)}, {"size", move.size}});
    }
    return {{"moves", std::move(moves)}, {"x_m", pass.measured.x_m},
            {"y_m", pass.measured.y_m},  {"heading_rad", pass.measured.heading_rad},
            {"sigma_m", pass.sigma_m},   {"sigma_rad", pass.sigma_rad}};
}

DrivenPass decode(json::ObjectReader in) {
    DrivenPass pass;
    in.items("moves", kMost, [&](const Json& item, const std::string& at) {
        json::ObjectReader move(item, at, in.errors());
        Move read;
        const auto kind = move.text("kind");
        read.kind = kind == "turn"      ? MoveKind::kTurn
                    : kind == "lateral" ? MoveKind::kLateral
                                        : MoveKind::kAdvance;
        if (kind != to_string(read.kind)) {
            in.errors().add(at + "/kind", {"not_one_of", {}}, "must be advance, lateral or turn");
        }
        read.size = move.number("size");
        pass.moves.push_back(read);
    });
    pass.measured = {in.number("x_m"), in.number("y_m"), in.number("heading_rad")};
    pass.sigma_m = in.number("sigma_m");
    pass.sigma_rad = in.number("sigma_rad");
    return pass;
}

Result<control::MotionCompensation> decode(const std::string& text) {
    const auto parsed = json::parse_json(text);
    if (!parsed) return fail(parsed.error());
    json::FieldErrors errors;
    json::ObjectReader in(*parsed, "", errors);
    std::vector<DrivenPass> passes;
    in.items("passes", kMost, [&](const Json& item, const std::string& at) {
        passes.push_back(decode(json::ObjectReader(item, at, errors)));
    });
    if (const auto status = errors.status(); !status) return fail(status.error());
    return control::MotionCompensation::restored(std::move(passes));
}

}  // namespace

LearnedMoves::LearnedMoves(const std::filesystem::path& folder, const std::string& vehicle)
    : file_(folder / (vehicle + ".moves.json")) {
    std::error_code unwritable;  // save() says so
    std::filesystem::create_directories(folder, unwritable);
}

Result<control::MotionCompensation> LearnedMoves::load() const {
    std::ifstream file(file_, std::ios::binary);
    if (!file) return control::MotionCompensation();
    auto read = decode(std::string(std::istreambuf_iterator<char>(file), {}));
    if (read) return read;
    return fail(Errc::kInvalid, "bad_learned_moves",
                file_.string() + " cannot be used: " + read.error().what +
                    ". Remove it; the vehicle learns its moves anew.",
                {}, {{"file", file_.string()}});
}

Status LearnedMoves::save(const control::MotionCompensation& compensation) const {
    Json passes = Json::array();
    for (const DrivenPass& pass : compensation.passes()) passes.push_back(encode(pass));
    return api::plant_file::write_file(file_, Json{{"passes", std::move(passes)}}.dump() + "\n");
}

}  // namespace pulseline::agent
