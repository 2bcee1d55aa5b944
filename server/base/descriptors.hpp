#pragma once

#include <cstddef>

#include "server/base/net.hpp"

namespace pulseline::server {

/// Raises the process's limit of open files as far as it may and gives it: service managers start
/// programs with 1,024, whatever number of connections was promised.
std::size_t raise_descriptor_limit();

/// One descriptor kept back, so that a server that has run out can still take a connection and
/// close it: its client learns at once what waiting would never tell.
class SpareDescriptor {
public:
    SpareDescriptor();
    ~SpareDescriptor();
    SpareDescriptor(const SpareDescriptor&) = delete;
    SpareDescriptor& operator=(const SpareDescriptor&) = delete;

    /// Refuses connections that wait, so many at most; gives how many.
    int refuse_waiting(tcp::acceptor& acceptor, int most);

private:
    int file_ = -1;
};

}  // namespace pulseline::server
