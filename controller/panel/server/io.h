// SPDX-License-Identifier: Apache-2.0
// Boost's headers in the one order that GCC 12 takes, for the server's sources only.
#pragma once

// clang-format off: the order matters. Boost.Asio 1.74 uses std::exchange without including it.
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <utility>
// clang-format on

#include "controller/panel/server/loop.h"

namespace chiaro::panel {

struct Loop::Io {
  boost::asio::io_context context{1};
};

}  // namespace chiaro::panel
