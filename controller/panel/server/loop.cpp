// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/server/loop.h"

#include "controller/panel/server/io.h"

namespace chiaro::panel {
namespace {

/// Keeps itself alive through its own pending wait.
class Repeater : public std::enable_shared_from_this<Repeater> {
 public:
  Repeater(boost::asio::io_context& context, ports::Duration period, std::function<void()> work)
      : timer_(context), period_(period), work_(std::move(work)) {}
  void arm() {
    timer_.expires_after(period_);
    timer_.async_wait([self = shared_from_this()](const boost::system::error_code& code) {
      if (code) return;
      self->work_();
      self->arm();
    });
  }

 private:
  boost::asio::steady_timer timer_;
  ports::Duration period_;
  std::function<void()> work_;
};

}  // namespace

Loop::Loop() : io_(std::make_unique<Io>()) {}
Loop::~Loop() = default;

void Loop::post(std::function<void()> work) { boost::asio::post(io_->context, std::move(work)); }

void Loop::every(ports::Duration period, std::function<void()> work) {
  std::make_shared<Repeater>(io_->context, period, std::move(work))->arm();
}

void Loop::run() {
  const auto guard = boost::asio::make_work_guard(io_->context);
  io_->context.run();
}

void Loop::stop() { io_->context.stop(); }

}  // namespace chiaro::panel
