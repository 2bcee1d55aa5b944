#pragma once

#include <cstdint>
#include <string>

#include "core/fleet/state/job_order.hpp"
#include "core/plant/plant.hpp"

/// Stored names of enumerators. They never change, whatever the API calls these things one day; a
/// stored name that is not known throws db::Error.
namespace pulseline::db {

const char* stored(fleet::JobState state);
const char* stored(fleet::StepState state);
const char* stored(fleet::StepPhase phase);
const char* stored(fleet::Integration level);
const char* stored(fleet::PoseBasis::Kind kind);
const char* stored(plant::Tolerance::Shape shape);
void read(const std::string& name, fleet::JobState& to);
void read(const std::string& name, fleet::StepState& to);
void read(const std::string& name, fleet::StepPhase& to);
void read(const std::string& name, fleet::Integration& to);
void read(const std::string& name, fleet::PoseBasis::Kind& to);
void read(const std::string& name, plant::Tolerance::Shape& to);
void read(const std::string& name, plant::MotionMode& to);
void read(const std::string& name, plant::Kinematics& to);
void read(const std::string& name, plant::MarkerKind& to);
void read(const std::string& name, plant::AreaKind& to);
void read(const std::string& name, plant::LoadKind& to);

/// The value, or db::Error when nobody can go on counting from it.
std::int64_t count(std::int64_t value);

/// '' for an empty id.
template <class IdType>
std::string stored_id(const IdType& id) {
    return id.empty() ? std::string() : id.str();
}
[[noreturn]] void bad_id(const std::string& text);
template <class IdType>
void read_id(const std::string& text, IdType& to) {
    to = IdType();
    if (text.empty()) return;
    const auto id = IdType::parse(text);
    if (!id) bad_id(text);
    to = *id;
}

}  // namespace pulseline::db
