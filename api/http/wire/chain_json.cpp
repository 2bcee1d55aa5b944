#include "api/http/wire/chain_json.hpp"

namespace pulseline::api {

Json chain_json(const Result<planning::LegChain>& chain) {
    if (!chain) return {{"markers", Json::array()}, {"reason", reason_json(chain.error().reason)}};
    Json json = {{"markers", list_json(chain->markers,
                                       [](const planning::LegChainMarker& one) {
                                           return Json{{"marker", one.marker.str()},
                                                       {"payload", one.payload},
                                                       {"place", point_json(one.place)},
                                                       {"at_m", one.at_m},
                                                       {"sigma_before_m", one.before_m},
                                                       {"sigma_after_m", one.after_m}};
                                       })},
                 {"arrival_sigma_m", chain->arrival_m},
                 {"worst_sigma_m", chain->worst_m},
                 {"limit_sigma_m", chain->limit_m}};
    if (!chain->markers.empty()) json["boundary"] = chain->markers.back().marker.str();
    return json;
}

}  // namespace pulseline::api
