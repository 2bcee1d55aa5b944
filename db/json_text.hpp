#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/plant/plant.hpp"
#include "db/error.hpp"

/// JSON texts inside rows. Private to db: nobody else reads them. Doubles come back bit for bit; a
/// value that is not finite, or a text that is damaged, throws db::Error.
namespace pulseline::db {

using OrderedJson = nlohmann::ordered_json;  // params keep their order

/// The value, or db::Error naming it when it is not finite.
double finite(double value, const char* name);

OrderedJson params_json(const Params& params);
Params params_of(const OrderedJson& json);

std::string params_to_json(const Params& params);
Params params_from_json(const std::string& text);
std::string texts_to_json(const std::vector<std::string>& texts);
std::vector<std::string> texts_from_json(const std::string& text);
std::string names_to_json(const plant::Names& names);
plant::Names names_from_json(const std::string& text);

std::string text_of(const OrderedJson& json);

/// What `decode` makes of the text.
template <class Decode>
auto decoded(const std::string& text, Decode decode) {
    try {
        return decode(OrderedJson::parse(text));
    } catch (const OrderedJson::exception&) {
        throw Error(Error::Kind::kBadValue, "The database holds a damaged text; restore a backup.");
    }
}

}  // namespace pulseline::db
