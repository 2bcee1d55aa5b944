#include "db/sql_text.hpp"

#include <algorithm>
#include <vector>

namespace pulseline::db {
namespace {

std::vector<std::string> split(const std::string& columns) {
    std::vector<std::string> names;
    for (std::size_t at = 0; at < columns.size();) {
        const std::size_t end = std::min(columns.find(',', at), columns.size());
        names.push_back(columns.substr(at, end - at));
        at = columns.find_first_not_of(", ", end);
        if (at == std::string::npos) break;
    }
    return names;
}

}  // namespace

std::string insert_into(const std::string& table, const std::string& columns) {
    std::string values;
    for (const std::string& name : split(columns)) values += (values.empty() ? ":" : ", :") + name;
    return "INSERT INTO " + table + " (" + columns + ") VALUES (" + values + ")";
}

std::string upsert_into(const std::string& table, const std::string& columns,
                        const std::string& key) {
    std::string changes;
    const std::vector<std::string> keys = split(key);
    for (const std::string& name : split(columns)) {
        bool is_key = false;
        for (const std::string& k : keys) is_key = is_key || k == name;
        if (is_key) continue;
        changes += (changes.empty() ? "" : ", ") + name + " = excluded." + name;
    }
    return insert_into(table, columns) + " ON CONFLICT (" + key + ") DO UPDATE SET " + changes;
}

}  // namespace pulseline::db
