#include "server/cli/access_commands.hpp"

#include <fmt/core.h>

#include <iostream>
#include <memory>

#include "api/access/access_control.hpp"
#include "server/base/server_clock.hpp"
#include "server/cli/exit_code.hpp"
#include "server/cli/storage.hpp"

namespace pulseline::server::cli {
namespace {

struct AccessInput {
    std::string database;
    std::string name;
    std::string role;
    bool password_stdin = false;
    std::string vehicle;
    bool all_vehicles = false;
    std::string scope = "api";
    std::string note;
    std::string id;
    bool json = false;
};

Error wrong(std::string what) { return {Errc::kInvalid, {"bad_option", {}}, std::move(what), {}}; }

/// Runs `act` on the access data of a database that no server holds.
template <class F>
int with_access(const AccessInput& input, F act) {
    auto storage = open_storage(input.database);
    if (!storage) return failed(storage.error());
    const Time now = ServerClock(Time{}).now();
    access::Store& store = (*storage)->access();
    api::access::AccessControl control(
        store, [&](const api::access::Change& change) { api::access::apply(store, change); }, now);
    return act(control, now);
}

int add_user(const AccessInput& input) {
    const auto role = access::parse_role(input.role);
    if (!role) return failed(wrong("--role is viewer, operator, engineer or admin"));
    if (!input.password_stdin) {
        return failed(
            wrong("give --password-stdin and write the password to standard input, so "
                  "that it is in no process list"));
    }
    std::string password;
    std::getline(std::cin, password);
    return with_access(input, [&](api::access::AccessControl& control, Time now) {
        const auto user = control.create_user(input.name, *role, password, now);
        if (!user) return failed(user.error());
        fmt::print("user {} is now {}\n", user->name, to_string(user->role));
        return 0;
    });
}

int list_users(const AccessInput& input) {
    return with_access(input, [](api::access::AccessControl& control, Time) {
        for (const auto& user : control.users()) {
            fmt::print("{}\t{}{}\n", user.name, to_string(user.role),
                       user.disabled ? "\tdisabled" : "");
        }
        return 0;
    });
}

/// A line "MAKER/SERIAL secret" for each vehicle of the plant, as agents read them.
int create_tokens_of_all_vehicles(const AccessInput& input) {
    auto storage = open_storage(input.database);
    if (!storage) return failed(storage.error());
    const auto plant = (*storage)->plant();
    if (!plant) return failed(wrong("this database has no plant; import one first"));
    access::Store& store = (*storage)->access();
    const Time now = ServerClock(Time{}).now();
    api::access::AccessControl control(
        store, [&](const api::access::Change& change) { api::access::apply(store, change); }, now);
    for (const auto& vehicle : plant->vehicles) {
        const auto made = control.create_vehicle_token(vehicle.manufacturer, vehicle.serial_number,
                                                       input.note, now);
        if (!made) return failed(made.error());
        fmt::print("{}/{} {}\n", vehicle.manufacturer, vehicle.serial_number, made->secret);
    }
    return 0;
}

int create_token(const AccessInput& input) {
    const int owners = (input.vehicle.empty() ? 0 : 1) + (input.role.empty() ? 0 : 1);
    if (owners + (input.all_vehicles ? 1 : 0) != 1) {
        return failed(wrong("give one of --vehicle MAKER/SERIAL, --all-vehicles and --role ROLE"));
    }
    if (input.all_vehicles) return create_tokens_of_all_vehicles(input);
    const auto role = access::parse_role(input.role);
    if (!input.role.empty() && !role) {
        return failed(wrong("--role is viewer, operator, engineer or admin"));
    }
    const auto slash = input.vehicle.find('/');
    if (!input.vehicle.empty() &&
        (slash == std::string::npos || slash == 0 || slash + 1 == input.vehicle.size())) {
        return failed(wrong("--vehicle is MAKER/SERIAL, as the vehicle writes them"));
    }
    return with_access(input, [&](api::access::AccessControl& control, Time now) {
        const auto made =
            role ? control.create_api_token(*role, input.scope, input.note, now)
                 : control.create_vehicle_token(input.vehicle.substr(0, slash),
                                                input.vehicle.substr(slash + 1), input.note, now);
        if (!made) return failed(made.error());
        // The secret alone on standard output, so that a script can take it; it is not kept.
        fmt::print(stderr, "token {} (shown once):\n", made->token.id);
        fmt::print("{}\n", made->secret);
        return 0;
    });
}

int list_tokens(const AccessInput& input) {
    return with_access(input, [](api::access::AccessControl& control, Time) {
        for (const auto& token : control.tokens()) {
            const std::string owner =
                token.role ? std::string("role ") + to_string(*token.role)
                           : "vehicle " + token.vehicle_manufacturer + "/" + token.vehicle_serial;
            fmt::print("{}\t{}\t{}{}\n", token.id, owner, token.note,
                       token.revoked ? "\trevoked" : "");
        }
        return 0;
    });
}

int revoke_token(const AccessInput& input) {
    return with_access(input, [&](api::access::AccessControl& control, Time) {
        const auto done = control.revoke_token(input.id);
        if (!done) return failed(done.error());
        fmt::print("token {} is revoked\n", input.id);
        return 0;
    });
}

CLI::App* command(CLI::App* parent, const std::shared_ptr<AccessInput>& input, const char* name,
                  const char* help, int& exit_code, int (*run)(const AccessInput&)) {
    auto* made = parent->add_subcommand(name, help);
    made->add_option("--db", input->database, "Database file")->required();
    made->callback([input, &exit_code, run] { exit_code = run(*input); });
    return made;
}

}  // namespace

void add_access_commands(CLI::App& app, int& exit_code) {
    const auto input = std::make_shared<AccessInput>();
    auto* user = app.add_subcommand("user", "People who sign in")->require_subcommand(1);
    auto* add = command(user, input, "add", "Add a user, or give one a new role and password",
                        exit_code, add_user);
    add->add_option("name", input->name, "Name to sign in with")->required();
    add->add_option("--role", input->role, "viewer, operator, engineer or admin")->required();
    add->add_flag("--password-stdin", input->password_stdin, "Read the password from one line");
    command(user, input, "list", "List users", exit_code, list_users);

    auto* token =
        app.add_subcommand("token", "Tokens of programs and vehicles")->require_subcommand(1);
    auto* create = command(token, input, "create", "Make a token; it is printed once", exit_code,
                           create_token);
    create->add_option("--vehicle", input->vehicle, "MAKER/SERIAL of the vehicle it is bound to");
    create->add_flag("--all-vehicles", input->all_vehicles,
                     "One for each vehicle of the plant, a line \"MAKER/SERIAL secret\" each");
    create->add_option("--role", input->role, "Role of a program's token");
    create->add_option("--scope", input->scope, "Scope of a program's token");
    create->add_option("--note", input->note, "What it is for");
    command(token, input, "list", "List tokens without their secrets", exit_code, list_tokens);
    auto* revoke = command(token, input, "revoke", "End a token", exit_code, revoke_token);
    revoke->add_option("id", input->id, "Id as listed")->required();
}

}  // namespace pulseline::server::cli
