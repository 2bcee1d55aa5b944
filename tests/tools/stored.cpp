// What tests and benchmarks do with a database file while no server has it.
//   stored fill FILE EVENTS ORDERS: adds a past of so many events and finished orders of six days.
//   stored check FILE: one JSON line of the faults found, and what is stored of each order.
//   stored sizes FILE: one JSON line of the file's bytes and the free ones among them, and of each
//   table its rows and the bytes of what they hold.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "db/database.hpp"

namespace {

using Json = nlohmann::ordered_json;
using pulseline::db::Database;

// Six days are the worst case: all of it is young enough to be kept in memory by the fleet.
constexpr const char* kPast = R"sql(
CREATE TEMP TABLE past AS
WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < :orders)
SELECT i, :from + i * (6 * 86400000000000 / :orders) AS at_ns,
       (SELECT id FROM vehicles ORDER BY position LIMIT 1) AS vehicle,
       (SELECT id FROM stations
        WHERE position = (SELECT MIN(position) FROM stations) + i % (SELECT COUNT(*) FROM stations)) AS station
FROM n)sql";
constexpr const char* kPastIds = R"sql(
CREATE TEMP TABLE past_id AS SELECT i,
       printf('%s-%s-7%03x-8000-%012x', substr(ms, 1, 8), substr(ms, 9, 4), i & 4095, i) AS id
FROM (SELECT i, printf('%012x', at_ns / 1000000) AS ms FROM past))sql";
constexpr const char* kOrders = R"sql(
INSERT INTO orders (id, number, client_order_id, wanted_vehicle, assigned_vehicle, priority, current_step, state,
                    cancel_requested, pause_requested, reason_code, reason_params, created_by, created_ns,
                    started_ns, ended_ns, revision)
SELECT id, i, 'past-' || i, vehicle, vehicle, 0, 2, CASE WHEN i % 20 = 0 THEN 'Aborted' ELSE 'Ended' END,
       0, 0, '', '{}', 'mes', at_ns, at_ns + 1000000000, at_ns + 60000000000, 7
FROM past JOIN past_id USING (i))sql";
constexpr const char* kSteps = R"sql(
INSERT INTO job_order_steps (order_id, position, station, mode, state, leg, stop, attempts)
SELECT id, position, station, 'linear', 'done', id, id, 1
FROM past JOIN past_id USING (i) JOIN (SELECT 0 AS position UNION ALL SELECT 1))sql";
constexpr const char* kStops = R"sql(
INSERT INTO stop_records
SELECT id, id, id, 1, vehicle, station, 1, 'linear', 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0002, 0.0003, 'box', 0.025,
       0.025, 0.0035, 1, 1, 'dual_camera', '[]', 0, at_ns + 60000000000
FROM past JOIN past_id USING (i))sql";
constexpr const char* kKeys = R"sql(
INSERT INTO idempotency_keys SELECT 'mes', 'past-' || i, printf('%064x', i), id, at_ns
FROM past JOIN past_id USING (i))sql";
constexpr const char* kEvents = R"sql(
WITH RECURSIVE n(seq) AS (SELECT 1 UNION ALL SELECT seq + 1 FROM n WHERE seq < :events)
INSERT INTO events
SELECT seq, at_ns + seq % 10, 'job_order.state', id, id, vehicle, 'mes',
       '{"from":"AllowedToStart","to":"Running"}'
FROM n JOIN past ON past.i = 1 + (seq - 1) * :orders / :events JOIN past_id ON past_id.i = past.i)sql";

int fill(const std::string& path, std::int64_t events, std::int64_t orders) {
    Database database(path);
    auto& sql = database.sql();
    const std::int64_t from =
        std::chrono::duration_cast<std::chrono::nanoseconds>(
            (std::chrono::system_clock::now() - std::chrono::hours(24 * 6)).time_since_epoch())
            .count();
    database.transaction([&] {
        sql << "DELETE FROM events";
        sql << "DELETE FROM orders";
        sql << kPast, soci::use(orders, "orders"), soci::use(from, "from");
        sql << "CREATE UNIQUE INDEX temp.past_by_i ON past (i)";
        sql << kPastIds;
        sql << "CREATE UNIQUE INDEX temp.past_id_by_i ON past_id (i)";
        for (const char* statement : {kOrders, kSteps, kStops, kKeys}) sql << statement;
        sql << kEvents, soci::use(events, "events"), soci::use(orders, "orders");
    });
    return 0;
}

Json rows(soci::session& sql, const std::string& query) {
    Json all = Json::array();
    const soci::rowset<soci::row> found = (sql.prepare << query);
    for (const soci::row& row : found) {
        Json one;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const auto& name = row.get_properties(i).get_name();
            if (row.get_indicator(i) == soci::i_null) {
                one[name] = nullptr;
            } else if (row.get_properties(i).get_data_type() == soci::dt_string) {
                one[name] = row.get<std::string>(i);
            } else if (row.get_properties(i).get_data_type() == soci::dt_double) {
                one[name] = row.get<double>(i);
            } else if (row.get_properties(i).get_data_type() == soci::dt_integer) {
                one[name] = row.get<int>(i);
            } else {
                one[name] = row.get<long long>(i);
            }
        }
        all.push_back(std::move(one));
    }
    return all;
}

// Each finds rows that may not be.
constexpr std::pair<const char*, const char*> kFaults[] = {
    {"event sequence has a gap",
     "SELECT CAST(COUNT(*) AS TEXT) AS count, CAST(MIN(seq) AS TEXT) AS first, CAST(MAX(seq) AS "
     "TEXT) AS last "
     "FROM events HAVING COUNT(*) > 0 AND (MIN(seq) <> 1 OR MAX(seq) <> COUNT(*))"},
    {"event times go back",
     "SELECT CAST(b.seq AS TEXT) AS seq FROM events a JOIN events b ON b.seq = a.seq + 1 WHERE "
     "b.at_ns < a.at_ns"},
    {"order without exactly one created event",
     "SELECT id FROM orders WHERE (SELECT COUNT(*) FROM events WHERE type = 'job_order.created' "
     "AND order_id = id) "
     "<> 1"},
    {"created event without order",
     "SELECT order_id FROM events WHERE type = 'job_order.created' AND order_id NOT IN (SELECT id "
     "FROM orders)"},
    {"client name used twice",
     "SELECT client_order_id FROM orders WHERE client_order_id <> '' GROUP BY 1 HAVING COUNT(*) > "
     "1"},
    {"order numbers have a gap",
     "SELECT CAST(MAX(number) AS TEXT) AS last FROM orders HAVING MAX(number) <> COUNT(*)"},
    {"done step without exactly one good stop",
     "SELECT order_id, CAST(position AS TEXT) AS position FROM job_order_steps s WHERE state = "
     "'done' AND "
     "(SELECT COUNT(*) FROM stop_records r WHERE r.order_id = s.order_id AND r.step = s.position "
     "AND inside = 1) "
     "<> 1"},
    {"ended order with an open step",
     "SELECT order_id FROM job_order_steps WHERE state <> 'done' AND order_id IN "
     "(SELECT id FROM orders WHERE state = 'Ended')"},
    {"two final events of one order",
     "SELECT order_id FROM events WHERE type = 'job_order.state' AND (params LIKE "
     "'%\"to\":\"Ended\"%' OR "
     "params LIKE '%\"to\":\"Aborted\"%') GROUP BY order_id HAVING COUNT(*) > 1"},
    {"two open orders of one vehicle",
     "SELECT assigned_vehicle FROM orders WHERE assigned_vehicle <> '' AND state = 'Running' GROUP "
     "BY 1 "
     "HAVING COUNT(*) > 1"},
};

int check(const std::string& path) {
    Database database(path);
    auto& sql = database.sql();
    Json faults = Json::array();
    for (const auto& row : rows(sql, "PRAGMA integrity_check")) {
        if (row.front() != "ok") faults.push_back({{"fault", "integrity_check"}, {"rows", row}});
    }
    for (const auto& row : rows(sql, "PRAGMA foreign_key_check")) {
        faults.push_back({{"fault", "foreign_key_check"}, {"rows", row}});
    }
    for (const auto& [fault, query] : kFaults) {
        const Json found = rows(sql, query);
        if (!found.empty()) faults.push_back({{"fault", fault}, {"rows", found}});
    }
    const Json orders =
        rows(sql,
             "SELECT o.id, o.state, o.client_order_id, o.cancel_requested, o.revision, "
             "COALESCE(k.key, '') AS key FROM orders o LEFT JOIN idempotency_keys k "
             "ON k.order_id = o.id");
    const Json loads =
        rows(sql, "SELECT id, CAST(mass_kg AS TEXT) AS mass_kg FROM load_sheets WHERE retired = 0");
    Json events = Json::array();
    for (const auto& row : rows(sql,
                                "SELECT CAST(seq AS TEXT) AS seq, type, order_id FROM events "
                                "ORDER BY events.seq")) {
        events.push_back({row["type"], row["order_id"]});
    }
    Json report{{"faults", std::move(faults)},
                {"orders", std::move(orders)},
                {"loads", loads},
                {"events", std::move(events)}};
    std::cout << report.dump() << '\n';
    return 0;
}

/// What the columns of a table hold, without what SQLite needs to keep it.
std::string content_of(soci::session& sql, const std::string& table) {
    std::string sum = "0";
    for (const auto& column : rows(sql, "SELECT name FROM pragma_table_info('" + table + "')")) {
        // Numbers take 1 to 8 bytes; times and measures, which are most of them, the latter.
        const auto name = "\"" + column["name"].get<std::string>() + "\"";
        sum += " + CASE typeof(" + name + ") WHEN 'text' THEN length(CAST(" + name +
               " AS BLOB)) WHEN 'blob' THEN length(" + name + ") WHEN 'integer' THEN CASE WHEN " +
               name + " BETWEEN -32768 AND 32767 THEN 2 ELSE 8 END ELSE 8 END";
    }
    return "COALESCE(SUM(" + sum + "), 0)";
}

int sizes(const std::string& path) {
    Database database(path);
    auto& sql = database.sql();
    const auto pragma = [&](const char* name) {
        long long value = 0;
        sql << std::string("PRAGMA ") + name, soci::into(value);
        return value;
    };
    Json tables;
    for (const auto& table : rows(sql, "SELECT name FROM sqlite_master WHERE type = 'table'")) {
        const auto name = table["name"].get<std::string>();
        long long count = 0;
        long long bytes = 0;
        sql << "SELECT COUNT(*), " + content_of(sql, name) + " FROM \"" + name + "\"",
            soci::into(count), soci::into(bytes);
        tables[name] = {{"rows", count}, {"bytes", bytes}};
    }
    const long long page = pragma("page_size");
    const Json report{{"bytes", page * pragma("page_count")},
                      {"free_bytes", page * pragma("freelist_count")},
                      {"tables", std::move(tables)}};
    std::cout << report.dump() << '\n';
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::string verb = argc > 1 ? argv[1] : "";
        if (verb == "fill" && argc == 5)
            return fill(argv[2], std::atoll(argv[3]), std::atoll(argv[4]));
        if (verb == "check" && argc == 3) return check(argv[2]);
        if (verb == "sizes" && argc == 3) return sizes(argv[2]);
        std::cerr << "stored fill FILE EVENTS ORDERS | stored check FILE | stored sizes FILE\n";
    } catch (const std::exception& e) {
        std::cerr << "stored: " << e.what() << '\n';
    }
    return 2;
}
