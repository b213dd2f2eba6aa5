// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/server/sessions.h"
// after sessions.h: Boost's order
#include <boost/asio/write.hpp>

namespace chiaro::panel {

StreamSession::StreamSession(beast::tcp_stream stream, Server::State& server, std::string camera)
    : stream_(std::move(stream)), server_(server), camera_(std::move(camera)), open_(server.open) {}

void StreamSession::start() {
  server_.streams.insert(shared_from_this());
  write(std::make_shared<const std::string>(
      "HTTP/1.1 200 OK\r\nServer: chiarod\r\nCache-Control: no-store\r\nConnection: close\r\n"
      "Content-Type: multipart/x-mixed-replace; boundary=frame\r\n\r\n--frame\r\n"));
}

void StreamSession::show(const std::shared_ptr<const std::string>& jpeg) {
  newest_ = jpeg;
  if (!writing_) next();
}

void StreamSession::next() {
  if (!newest_) return;
  const auto picture = std::move(newest_);
  newest_ = nullptr;
  write(std::make_shared<const std::string>(
      "Content-Type: image/jpeg\r\nContent-Length: " + std::to_string(picture->size()) +
      "\r\n\r\n" + *picture + "\r\n--frame\r\n"));
}

void StreamSession::write(std::shared_ptr<const std::string> bytes) {
  writing_ = true;
  stream_.expires_after(std::chrono::seconds(30));
  asio::async_write(stream_, asio::buffer(*bytes),
                    [self = shared_from_this(), bytes](const Code& code, std::size_t) {
                      self->writing_ = false;
                      if (!*self->open_) return;
                      if (code) {
                        self->server_.streams.erase(self);
                        return;
                      }
                      self->stream_.expires_never();
                      self->next();
                    });
}

}  // namespace chiaro::panel
