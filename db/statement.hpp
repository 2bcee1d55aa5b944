#pragma once

#include <soci/soci.h>

#include <tuple>

namespace pulseline::db {

/// One prepared statement, bound once to variables that must outlive it, run many times.
///
///     Statement put(sql, "INSERT INTO t VALUES (:a, :b)", std::tie(row.a, row.b));
///     row = ...; put.run();
///
///     Statement list(sql, "SELECT a, b FROM t WHERE c = :c", std::tie(c), std::tie(row.a, row.b));
///     for (list.start(); list.fetch();) use(row);
class Statement {
public:
    template <class... In, class... Out>
    Statement(soci::session& sql, const std::string& text, std::tuple<In&...> in = {},
              std::tuple<Out&...> out = {})
        : statement_(sql) {
        statement_.alloc();
        std::apply([&](auto&... field) { (statement_.exchange(soci::use(field)), ...); }, in);
        std::apply([&](auto&... field) { (statement_.exchange(soci::into(field)), ...); }, out);
        statement_.prepare(text);
        statement_.define_and_bind();
    }

    /// Runs it and fetches the first row, if it gives any.
    bool run() { return statement_.execute(true); }
    void start() { statement_.execute(false); }
    bool fetch() { return statement_.fetch(); }
    long long changed_rows() { return statement_.get_affected_rows(); }

private:
    soci::statement statement_;
};

}  // namespace pulseline::db
