#include "db/json_text.hpp"

#include <cmath>

namespace pulseline::db {

double finite(double value, const char* name) {
    if (std::isfinite(value)) return value;
    throw Error(Error::Kind::kBadValue,
                std::string("Nothing was stored: ") + name + " is no finite number.");
}

OrderedJson params_json(const Params& params) {
    OrderedJson json = OrderedJson::object();
    for (const Param& p : params) {
        std::visit([&](const auto& value) { json[p.name] = value; }, p.value);
        if (const auto* value = std::get_if<double>(&p.value)) finite(*value, p.name.c_str());
    }
    return json;
}

Params params_of(const OrderedJson& json) {
    Params params;
    for (const auto& [name, value] : json.items()) {
        if (value.is_boolean()) {
            params.push_back({name, value.get<bool>()});
        } else if (value.is_number_integer()) {
            params.push_back({name, value.get<std::int64_t>()});
        } else if (value.is_number()) {
            params.push_back({name, value.get<double>()});
        } else {
            params.push_back({name, value.get<std::string>()});
        }
    }
    return params;
}

std::string params_to_json(const Params& params) { return text_of(params_json(params)); }

Params params_from_json(const std::string& text) {
    return decoded(text, [](const OrderedJson& json) { return params_of(json); });
}

std::string texts_to_json(const std::vector<std::string>& texts) {
    return text_of(OrderedJson(texts));
}

std::vector<std::string> texts_from_json(const std::string& text) {
    return decoded(text,
                   [](const OrderedJson& json) { return json.get<std::vector<std::string>>(); });
}

std::string names_to_json(const plant::Names& names) { return text_of(OrderedJson(names)); }

plant::Names names_from_json(const std::string& text) {
    return decoded(text, [](const OrderedJson& json) { return json.get<plant::Names>(); });
}

std::string text_of(const OrderedJson& json) {
    return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

}  // namespace pulseline::db
