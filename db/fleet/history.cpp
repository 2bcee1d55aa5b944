#include "db/fleet/history.hpp"

#include <soci/soci.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "db/fleet/fleet_rows.hpp"
#include "db/fleet/order_reader.hpp"
#include "db/names.hpp"

namespace pulseline::db {
namespace {

/// A SELECT put together from fixed conditions, each with its bound values. Values never become SQL
/// text.
class Select {
public:
    explicit Select(soci::session& sql) : statement_(sql) { statement_.alloc(); }

    void where(const std::string& condition, std::initializer_list<std::string> values) {
        conditions_ += (conditions_.empty() ? " WHERE " : " AND ") + condition;
        for (const std::string& value : values) bind(value);
    }
    void bind(const std::string& value) {
        texts_.push_back(value);
        statement_.exchange(soci::use(texts_.back()));
    }
    void where_number(const std::string& condition, std::int64_t value) {
        conditions_ += (conditions_.empty() ? " WHERE " : " AND ") + condition;
        numbers_.push_back(value);
        statement_.exchange(soci::use(numbers_.back()));
    }

    /// Runs it and calls visit() for each row fetched into `row`.
    template <class Row, class Visit>
    void each(Row& row, const std::string& table, const std::string& order_by, std::int64_t limit,
              Visit visit) {
        numbers_.push_back(limit);
        statement_.exchange(soci::use(numbers_.back()));
        std::apply([&](auto&... field) { (statement_.exchange(soci::into(field)), ...); },
                   row.fields());
        statement_.prepare(std::string("SELECT ") + Row::kColumns + " FROM " + table + conditions_ +
                           " ORDER BY " + order_by + " LIMIT ?");
        statement_.define_and_bind();
        statement_.execute(false);
        while (statement_.fetch()) visit();
    }

private:
    soci::statement statement_;
    std::string conditions_;
    std::deque<std::string> texts_;  // a deque never moves what is bound
    std::deque<std::int64_t> numbers_;
};

std::string placeholders(std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += i == 0 ? "?" : ", ?";
    return "(" + text + ")";
}

void where_one_of(Select& select, const std::string& column,
                  const std::vector<std::string>& values) {
    select.where(column + " IN " + placeholders(values.size()), {});
    for (const std::string& value : values) select.bind(value);
}

}  // namespace

std::vector<fleet::StopRecord> History::stops(const fleet::StopQuery& query) {
    return reading(connection_.path(), [&] {
        Select select(connection_.sql());
        if (!query.vehicle.empty()) select.where("vehicle = ?", {query.vehicle.str()});
        if (query.station_number) select.where_number("station_number = ?", *query.station_number);
        if (!query.order.empty()) select.where("order_id = ?", {query.order.str()});
        if (!query.before.empty()) select.where("id < ?", {query.before.str()});
        StopRow row;
        std::vector<fleet::StopRecord> result;
        select.each(row, "stop_records", "id DESC", std::max(0, query.limit),
                    [&] { result.push_back(row.get()); });
        return result;
    });
}

std::optional<fleet::StopRecord> History::stop(fleet::StopRecordId id) {
    return reading(connection_.path(), [&] {
        Select select(connection_.sql());
        select.where("id = ?", {id.str()});
        StopRow row;
        std::optional<fleet::StopRecord> result;
        select.each(row, "stop_records", "id", 1, [&] { result = row.get(); });
        return result;
    });
}

std::vector<fleet::Event> History::unmeasured_stops(const fleet::UnmeasuredQuery& query) {
    return reading(connection_.path(), [&] {
        Select select(connection_.sql());
        select.where("type = 'stop.not_measured'", {});  // in these words the index has it
        if (!query.vehicle.empty()) select.where("vehicle = ?", {query.vehicle.str()});
        if (query.station_number) {
            select.where_number("json_extract(params, '$.station') = ?", *query.station_number);
        }
        if (!query.order.empty()) select.where("order_id = ?", {query.order.str()});
        if (query.before) select.where_number("seq < ?", *query.before);
        EventRow row;
        std::vector<fleet::Event> result;
        select.each(row, "events", "seq DESC", std::max(0, query.limit),
                    [&] { result.push_back(row.get()); });
        return result;
    });
}

std::vector<fleet::LoadMove> History::load_moves(const fleet::LoadMoveQuery& query) {
    return reading(connection_.path(), [&] {
        Select select(connection_.sql());
        select.where("load = ?", {query.load.str()});
        if (query.before) select.where_number("id < ?", *query.before);
        LoadMoveRow row;
        std::vector<fleet::LoadMove> result;
        select.each(row, "load_moves", "id DESC", std::max(0, query.limit),
                    [&] { result.push_back(row.get()); });
        return result;
    });
}

bool History::has_load_sheet(const plant::LoadId& id) {
    return reading(connection_.path(), [&] {
        Select select(connection_.sql());
        select.where("id = ?", {id.str()});
        LoadSheetRow row;
        bool found = false;
        select.each(row, "load_sheets", "id", 1, [&] { found = true; });
        return found;
    });
}

std::vector<fleet::JobOrder> History::orders(const fleet::OrderQuery& query) {
    return reading(connection_.path(), [&] {
        Select select(connection_.sql());
        if (!query.states.empty()) {
            std::vector<std::string> states;
            for (const fleet::JobState state : query.states) states.emplace_back(stored(state));
            where_one_of(select, "state", states);
        }
        if (!query.vehicle.empty()) {
            select.where("(assigned_vehicle = ? OR wanted_vehicle = ?)",
                         {query.vehicle.str(), query.vehicle.str()});
        }
        select.where_number("removed = ?", query.removed ? 1 : 0);
        if (!query.before.empty()) select.where("id < ?", {query.before.str()});
        OrderRow row;
        StepReader steps(connection_.sql());
        std::vector<fleet::JobOrder> result;
        select.each(row, "orders", "id DESC", std::max(0, query.limit), [&] {
            result.push_back(row.get());
            result.back().steps = steps.steps_of(row.id);
        });
        return result;
    });
}

std::optional<fleet::JobOrder> History::order(fleet::JobOrderId id) {
    return reading(connection_.path(), [&] {
        Select select(connection_.sql());
        select.where("id = ?", {id.str()});
        OrderRow row;
        StepReader steps(connection_.sql());
        std::optional<fleet::JobOrder> result;
        select.each(row, "orders", "id", 1, [&] {
            result = row.get();
            result->steps = steps.steps_of(row.id);
        });
        return result;
    });
}

std::vector<fleet::Event> History::events_after(std::int64_t seq, int limit) {
    return reading(connection_.path(), [&] {
        Select select(connection_.sql());
        select.where_number("seq > ?", seq);
        EventRow row;
        std::vector<fleet::Event> result;
        select.each(row, "events", "seq", std::max(0, limit), [&] { result.push_back(row.get()); });
        return result;
    });
}

fleet::StopStatistics History::statistics(const std::vector<plant::VehicleId>& vehicles,
                                          plant::MotionMode mode, int newest) {
    fleet::StopStatistics statistics;
    if (vehicles.empty()) return statistics;
    return reading(connection_.path(), [&] {
        Select select(connection_.sql());
        std::vector<std::string> names;
        for (const auto& vehicle : vehicles) names.push_back(vehicle.str());
        where_one_of(select, "vehicle", names);
        select.where("mode = ?", {plant::to_string(mode)});
        StopRow row;
        select.each(row, "stop_records", "id DESC", std::max(0, newest), [&] {
            const double distance_m = std::hypot(row.numbers.dx_m, row.numbers.dy_m);
            const double turn_rad = std::abs(row.numbers.dheading_rad);
            ++statistics.stops;
            statistics.mean_m += distance_m;
            statistics.mean_rad += turn_rad;
            statistics.max_m = std::max(statistics.max_m, distance_m);
            statistics.max_rad = std::max(statistics.max_rad, turn_rad);
        });
        if (statistics.stops > 0) {
            statistics.mean_m /= statistics.stops;
            statistics.mean_rad /= statistics.stops;
        }
        return statistics;
    });
}

}  // namespace pulseline::db
