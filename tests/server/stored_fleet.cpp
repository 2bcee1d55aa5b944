#include "tests/server/stored_fleet.hpp"

namespace pulseline::server::testing {
namespace {

constexpr const char* kPerson = "tester";

const plant::Plant& the_plant() {
    static const plant::Plant plant = fleet::testing::small_plant();  // vehicles outlive servers
    return plant;
}

}  // namespace

StoredFleet::StoredFleet(const std::string& path, Ledger& ledger, Time now, Vehicles vehicles)
    : ledger_(ledger), vehicles_(std::move(vehicles)), database_(path), store_(database_) {
    auto stored = store_.load();
    // A start that failed may have stored more than it could tell; never less than was told.
    if (stored.last_event_seq < ledger_.last_event) ++ledger_.gaps;
    ledger_.last_event = stored.last_event_seq;
    clock_.at = std::max(to_ns(now), to_ns(stored.last_time));
    for (const auto& vehicle : the_plant().vehicles) {
        const auto home = plant::find_station(the_plant(), vehicle.home)->pose;
        vehicles_.emplace(vehicle.id, fleet::testing::FakeVehicle(the_plant(), vehicle.id, home));
    }
    const auto connect = [this] {
        for (const auto& [id, vehicle] : vehicles_) {
            runtime_->input(id,
                            [id = id](fleet::Fleet& f, Time at) { f.vehicle_connected(id, at); });
        }
    };
    FleetRuntime::Ports ports{the_plant(), store_, clock_, metrics_, {}, {}, connect};
    ports.deliver = [this](FleetRuntime::Job job) {
        const std::lock_guard lock(mutex_);
        delivered_.push_back(std::move(job));
        wake_.notify_one();
    };
    ports.publish = [this](const FleetRuntime::Published& batch) { publish(batch); };
    runtime_ = std::make_unique<FleetRuntime>(ports, 7);
    if (const auto started = runtime_->start(std::move(stored)); !started) {
        throw db::Error(db::Error::Kind::kFailed, started.error().what);
    }
    connect();
}

StoredFleet::~StoredFleet() { runtime_.reset(); }

void StoredFleet::run_delivered_until(const std::function<bool()>& done) {
    while (!done()) {
        runtime_->listening();
        FleetRuntime::Job job;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [this] { return !delivered_.empty(); });
            job = std::move(delivered_.front());
            delivered_.pop_front();
        }
        job();
    }
}

template <class F>
auto StoredFleet::ask(F f) -> Result<std::invoke_result_t<F, fleet::Fleet&, Time>> {
    using Answer = Result<std::invoke_result_t<F, fleet::Fleet&, Time>>;
    std::optional<Answer> answer;
    runtime_->command(std::move(f), [&](Answer got) { answer = std::move(got); });
    run_delivered_until([&] { return answer.has_value(); });
    return std::move(*answer);
}

void StoredFleet::publish(const FleetRuntime::Published& batch) {
    for (const auto& event : batch.outputs.records.events) {
        if (event.seq != ledger_.last_event + 1) ++ledger_.gaps;
        ledger_.last_event = event.seq;
    }
    for (const auto& message : batch.outputs.messages) {
        vehicles_.at(message.vehicle).receive(message);
    }
}

void StoredFleet::report_vehicles() {
    for (auto& [id, vehicle] : vehicles_) vehicle.step();
    ask([this](fleet::Fleet& fleet, Time now) {
        for (const auto& [id, vehicle] : vehicles_) fleet.vehicle_state(id, vehicle.state, now);
        return 0;
    });
}

void StoredFleet::create(const std::string& key, std::mt19937& random) {
    fleet::NewOrder order;
    order.vehicle = plant::VehicleId(random() % 2 == 0 ? "V1" : "V2");
    order.actor = kPerson;
    order.idempotency_client = kPerson;
    order.idempotency_key = key;
    order.body_sha256 = key;
    // Each vehicle to and fro on its own half.
    const int first = order.vehicle.str() == "V1" ? 1 : 3;
    order.steps.push_back({first + static_cast<int>(random() % 2), plant::MotionMode::kAuto});
    auto& asked = ledger_.orders[key];
    const auto answer =
        ask([&](fleet::Fleet& fleet, Time now) { return fleet.create(order, now); });
    asked.refused = !answer || !answer->has_value();
    if (asked.refused) return;
    asked.accepted = true;
    asked.order = (*answer)->order.id;
    asked.revision = std::max(asked.revision, (*answer)->order.revision);
}

void StoredFleet::change(std::mt19937& random) {
    std::vector<Ledger::Asked*> known;
    for (auto& [key, asked] : ledger_.orders) {
        if (asked.accepted) known.push_back(&asked);
    }
    if (known.empty()) return;
    auto& asked = *known[known.size() - 1 - random() % std::min<std::size_t>(known.size(), 4)];
    const auto how = random() % 4;
    const auto answer = ask([&](fleet::Fleet& fleet, Time now) {
        if (how == 0) return fleet.cancel_order(asked.order, std::nullopt, kPerson, now);
        if (how == 1) return fleet.pause_order(asked.order, std::nullopt, kPerson, now);
        return fleet.resume_order(asked.order, std::nullopt, kPerson, now);
    });
    if (answer && *answer) asked.revision = std::max(asked.revision, (*answer)->revision);
}

void StoredFleet::let_go() {
    ask([](fleet::Fleet& fleet, Time now) {
        return fleet.resume_fleet(fleet.view(now).needs_resume, kPerson, now);
    });
}

void StoredFleet::step(int number) {
    std::mt19937 random(static_cast<unsigned>(number));
    pass(std::chrono::milliseconds(200));
    report_vehicles();
    const auto what = random() % 10;
    if (what < 3) {
        create("order-" + std::to_string(number), random);
    } else if (what < 5) {
        change(random);
    } else if (what < 6) {
        let_go();
    } else if (what < 7) {
        const plant::VehicleId id(random() % 2 == 0 ? "V1" : "V2");
        runtime_->input(id, [id](fleet::Fleet& f, Time at) { f.vehicle_disconnected(id, at); });
        runtime_->input(id, [id](fleet::Fleet& f, Time at) { f.vehicle_connected(id, at); });
        report_vehicles();
    }
}

/// The other threads may be late on a busy machine: nobody asks again before they had their turn.
void StoredFleet::await_store() {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
    while (!runtime_->writable() && std::chrono::steady_clock::now() < until) {
        FleetRuntime::Job job;
        {
            std::unique_lock lock(mutex_);
            wake_.wait_for(lock, std::chrono::milliseconds(1),
                           [this] { return !delivered_.empty(); });
            if (delivered_.empty()) continue;
            job = std::move(delivered_.front());
            delivered_.pop_front();
        }
        job();
    }
}

bool StoredFleet::works_again() {
    std::mt19937 random(1);
    const std::string key = "after-" + std::to_string(clock_.at);
    for (int tries = 0; tries < 400; ++tries) {
        pass(std::chrono::milliseconds(1100));  // it tries the store once a second
        report_vehicles();
        let_go();
        create(key, random);
        if (ledger_.orders[key].accepted) return true;
        await_store();
    }
    return false;
}

}  // namespace pulseline::server::testing
