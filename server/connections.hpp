#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace pulseline::server {

/// Counts under a key with a ceiling ("connections of one address"). A Slot gives its place back.
class Quota {
public:
    class Slot {
    public:
        Slot() = default;
        Slot(Quota* quota, std::string key) : quota_(quota), key_(std::move(key)) {}
        Slot(Slot&& other) noexcept
            : quota_(std::exchange(other.quota_, nullptr)), key_(std::move(other.key_)) {}
        Slot& operator=(Slot&& other) noexcept {
            std::swap(quota_, other.quota_);
            std::swap(key_, other.key_);
            return *this;
        }
        ~Slot() {
            if (quota_) quota_->release(key_);
        }
        explicit operator bool() const { return quota_ != nullptr; }

    private:
        Quota* quota_ = nullptr;
        std::string key_;
    };

    explicit Quota(std::size_t most) : most_(most) {}
    Slot take(const std::string& key) {
        auto& count = counts_[key];
        if (count >= most_) return {};
        ++count;
        return {this, key};
    }

private:
    void release(const std::string& key) {
        const auto found = counts_.find(key);
        if (found != counts_.end() && --found->second == 0) counts_.erase(found);
    }
    std::size_t most_;
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
