#include "api/http/plant/documents.hpp"

#include "api/http/plant/grid_png.hpp"
#include "api/http/wire/common_json.hpp"
#include "api/http/wire/etag.hpp"
#include "api/plant/plant_codec.hpp"

namespace pulseline::api {

Documents make_documents(const plant::Plant& plant) {
    Documents documents;
    documents.plant_json = dump(plant_file::encode_plant(plant, plant_file::PlantForm::kApi));
    documents.plant_etag = etag_of(plant.revision);
    for (const plant::Hall& hall : plant.halls) {
        if (!hall.grid.empty()) documents.grid_png[hall.id.str()] = grid_png(hall.grid);
    }
    documents.openapi_json = kOpenApiJson;
    return documents;
}

}  // namespace pulseline::api
