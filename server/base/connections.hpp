#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace pulseline::server {

/// Counts under a key with a ceiling ("connections of one address"), and over all keys. A Slot
/// gives its place back.
class Quota {
public:
    class Slot {
    public:
        Slot() = default;
        Slot(Quota* quota, std::string key, std::size_t amount)
            : quota_(quota), key_(std::move(key)), amount_(amount) {}
        Slot(Slot&& other) noexcept
            : quota_(std::exchange(other.quota_, nullptr)),
              key_(std::move(other.key_)),
              amount_(other.amount_) {}
        Slot& operator=(Slot&& other) noexcept {
            std::swap(quota_, other.quota_);
            std::swap(key_, other.key_);
            std::swap(amount_, other.amount_);
            return *this;
        }
        ~Slot() {
            if (quota_) quota_->release(key_, amount_);
        }
        explicit operator bool() const { return quota_ != nullptr; }

    private:
        Quota* quota_ = nullptr;
        std::string key_;
        std::size_t amount_ = 1;
    };

    explicit Quota(std::size_t most, std::size_t most_of_all = SIZE_MAX)
        : most_(most), most_of_all_(most_of_all) {}
    Slot take(const std::string& key, std::size_t amount = 1) {
        const auto held = counts_.find(key);
        if (amount > most_ - (held == counts_.end() ? 0 : held->second)) return {};
        if (amount > most_of_all_ - all_) return {};
        counts_[key] += amount;
        all_ += amount;
        return {this, key, amount};
    }

private:
    void release(const std::string& key, std::size_t amount) {
        all_ -= amount;
        const auto found = counts_.find(key);
        if (found != counts_.end() && (found->second -= amount) == 0) counts_.erase(found);
    }
    std::size_t most_;
    std::size_t most_of_all_;
    std::size_t all_ = 0;
    std::map<std::string, std::size_t> counts_;
};

/// How open sessions hear that the server ends.
class StopList {
public:
    class Entry {
    public:
        Entry(StopList& list, std::function<void()> stop) : list_(list), id_(list.next_++) {
            list_.stops_[id_] = std::move(stop);
        }
        ~Entry() { list_.stops_.erase(id_); }
        Entry(const Entry&) = delete;
        Entry& operator=(const Entry&) = delete;

    private:
        StopList& list_;
        std::uint64_t id_;
    };

    void stop_all() {
        stopping_ = true;
        const auto stops = stops_;
        for (const auto& [id, stop] : stops) {
            if (stops_.contains(id)) stop();
        }
    }
    bool stopping() const { return stopping_; }

private:
    std::map<std::uint64_t, std::function<void()>> stops_;
    std::uint64_t next_ = 1;
    bool stopping_ = false;
};

}  // namespace pulseline::server
