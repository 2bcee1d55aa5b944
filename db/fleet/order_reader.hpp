#pragma once

#include <optional>
#include <string>
#include <vector>

#include "db/fleet/fleet_rows.hpp"
#include "db/statement.hpp"

namespace pulseline::db {

/// Reads the steps of one order after another.
class StepReader {
public:
    explicit StepReader(soci::session& sql)
        : select_(sql,
                  std::string("SELECT ") + StepRow::kColumns +
                      " FROM job_order_steps WHERE order_id = :order_id ORDER BY position",
                  std::tie(order_id_), row_.fields()) {}

    std::vector<fleet::Step> steps_of(const std::string& order_id) {
        order_id_ = order_id;
        std::vector<fleet::Step> steps;
        for (select_.start(); select_.fetch();) steps.push_back(row_.get());
        return steps;
    }

private:
    std::string order_id_;
    StepRow row_;
    Statement select_;
};

}  // namespace pulseline::db
