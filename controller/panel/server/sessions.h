// SPDX-License-Identifier: Apache-2.0
// One connection each: plain HTTP, an event stream (WebSocket), a camera's pictures (MJPEG). Each
// keeps itself alive through its pending operation. Included by the server's sources only.
#pragma once

#include "controller/panel/server/io.h"
// after io.h
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "controller/panel/http.h"
#include "controller/panel/server/server.h"

namespace chiaro::panel {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using Code = boost::system::error_code;

class EventSession;
class StreamSession;

struct Server::State {
  State(Loop& l, const ServerOptions& o, Brain& b)
      : loop(l), options(o), brain(b), acceptor(l.io().context), retry(l.io().context) {}
  Loop& loop;
  ServerOptions options;
  Brain& brain;
  Access access;
  asio::ip::tcp::acceptor acceptor;
  asio::steady_timer retry;
  std::set<EventSession*> events;
  /// Owned here: between two pictures no operation keeps a stream alive.
  std::set<std::shared_ptr<StreamSession>> streams;
  std::size_t connections = 0;
  std::uint64_t requests = 0;
  /// Sessions may outlive the server by one turn of the loop: they ask this first.
  std::shared_ptr<bool> open = std::make_shared<bool>(true);
};

/// Reads requests one after another and answers each.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(asio::ip::tcp::socket socket, Server::State& server);
  ~HttpSession();
  void start() { read(); }

 private:
  using Parser = http::request_parser<http::string_body>;
  void read();
  void on_read(const Code& code);
  void handle();
  /// A WebSocket or an MJPEG stream takes the connection over.
  bool handed_over(const Request& request);
  void send(Response response);

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<Parser> parser_;
  Server::State& server_;
  std::shared_ptr<bool> open_;
  bool keep_ = false, head_only_ = false;
  unsigned version_ = 11;
};

/// Tells one listener; reads only to notice that it went.
class EventSession : public std::enable_shared_from_this<EventSession> {
 public:
  EventSession(beast::tcp_stream stream, Server::State& server);
  ~EventSession();
  void start(const http::request<http::string_body>& request);
  void tell(const std::shared_ptr<const std::string>& message);

 private:
  void read();
  void write();

  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer buffer_;
  std::deque<std::shared_ptr<const std::string>> waiting_;
  bool writing_ = false, ready_ = false;
  Server::State& server_;
  std::shared_ptr<bool> open_;
};

/// Pictures one after another; while one is on its way newer ones replace each other.
class StreamSession : public std::enable_shared_from_this<StreamSession> {
 public:
  StreamSession(beast::tcp_stream stream, Server::State& server, std::string camera);
  void start();
  void show(const std::shared_ptr<const std::string>& jpeg);
  const std::string& camera() const { return camera_; }

 private:
  void write(std::shared_ptr<const std::string> bytes);
  void next();

  beast::tcp_stream stream_;
  Server::State& server_;
  std::string camera_;
  std::shared_ptr<const std::string> newest_;
  bool writing_ = false;
  std::shared_ptr<bool> open_;
};

}  // namespace chiaro::panel
