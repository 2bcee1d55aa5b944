#pragma once

#include <string>

namespace pulseline::db {

/// "INSERT INTO table (columns) VALUES (:c1, ...)".
std::string insert_into(const std::string& table, const std::string& columns);
/// The same, taking the row's values where `key` (one or more columns) is there already.
std::string upsert_into(const std::string& table, const std::string& columns,
                        const std::string& key);

}  // namespace pulseline::db
