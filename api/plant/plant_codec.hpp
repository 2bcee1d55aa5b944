#pragma once

#include <string>

#include "api/json/object_reader.hpp"
#include "core/plant/plant.hpp"

/// Plant <-> JSON; the schema is api/plant.schema.json.
namespace pulseline::api::plant_file {

enum class PlantForm {
    kFile,  // halls name their occupancy_yaml
    kApi,   // halls tell the size and place of their grid instead, edges always for whom they are
            // (openapi.yaml, Plant)
};

json::Json encode_plant(const plant::Plant& plant, PlantForm form);

/// Reads the file form; grids stay empty. Every field at fault is kept in `errors`; the plant is
/// worth something only when there are none.
plant::Plant decode_plant(const json::Json& json, json::FieldErrors& errors);

/// What is known of a load, but neither its id nor its place. `load.id`: by which it is called
/// where no name is there.
json::Json encode_load_sheet(const plant::Load& load);
void decode_load_sheet(json::ObjectReader& in, plant::Load& load);

/// The file form as text: one element a line, so that a diff shows what changed. Doubles print so
/// that reading them gives the same value.
std::string plant_to_json(const plant::Plant& plant);

}  // namespace pulseline::api::plant_file
