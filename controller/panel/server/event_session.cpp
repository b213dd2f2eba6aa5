// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/server/sessions.h"

namespace chiaro::panel {
namespace {

/// Messages that may wait for one listener; more means it does not keep up.
constexpr std::size_t kMostWaiting = 100;

}  // namespace

EventSession::EventSession(beast::tcp_stream stream, Server::State& server)
    : socket_(std::move(stream)), server_(server), open_(server.open) {}

EventSession::~EventSession() {
  if (*open_) server_.events.erase(this);
}

void EventSession::start(const http::request<http::string_body>& request) {
  beast::get_lowest_layer(socket_).expires_never();
  socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  socket_.read_message_max(4096);
  const auto kept = std::make_shared<http::request<http::string_body>>(request);
  socket_.async_accept(*kept, [self = shared_from_this(), kept](const Code& code) {
    if (code || !*self->open_) return;
    self->ready_ = true;
    self->server_.events.insert(self.get());
    self->tell(std::make_shared<const std::string>(state_event(self->server_.brain.state())));
    self->read();
  });
}

void EventSession::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](const Code& code, std::size_t) {
    self->buffer_.consume(self->buffer_.size());
    if (!code && *self->open_) return self->read();
    if (*self->open_) self->server_.events.erase(self.get());
  });
}

void EventSession::tell(const std::shared_ptr<const std::string>& message) {
  if (!ready_) return;
  if (waiting_.size() >= kMostWaiting) return beast::get_lowest_layer(socket_).close();
  waiting_.push_back(message);
  if (!writing_) write();
}

void EventSession::write() {
  writing_ = true;
  socket_.async_write(asio::buffer(*waiting_.front()),
                      [self = shared_from_this()](const Code& code, std::size_t) {
                        self->writing_ = false;
                        if (code || !*self->open_) return;
                        self->waiting_.pop_front();
                        if (!self->waiting_.empty()) self->write();
                      });
}

}  // namespace chiaro::panel
