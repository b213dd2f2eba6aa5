// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/server/files.h"
#include "controller/panel/server/sessions.h"

namespace chiaro::panel {
namespace {

Request request_from(const http::request<http::string_body>& message, const Target& target) {
  Request request;
  request.method = std::string(message.method_string());
  request.path = target.path;
  request.query = target.query;
  for (const auto& field : message) {
    std::string name(field.name_string());
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    request.headers[name] = std::string(field.value());
  }
  request.body = message.body();
  return request;
}

Response broken_request(const Code& code) {
  if (code == http::error::body_limit)
    return refuse({413, "the body is too large", "body", "send a smaller picture: 24 MB at most"});
  return refuse({400, "this is not HTTP: " + code.message(), "request", "send HTTP/1.1"});
}

}  // namespace

HttpSession::HttpSession(asio::ip::tcp::socket socket, Server::State& server)
    : stream_(std::move(socket)), server_(server), open_(server.open) {
  ++server_.connections;
}

HttpSession::~HttpSession() {
  if (*open_) --server_.connections;
}

void HttpSession::read() {
  parser_.emplace();
  parser_->body_limit(server_.options.most_body);
  stream_.expires_after(std::chrono::seconds(60));
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](const Code& code, std::size_t) {
                     if (*self->open_) self->on_read(code);
                   });
}

void HttpSession::on_read(const Code& code) {
  if (code == http::error::end_of_stream || code == beast::error::timeout) return;
  if (code == http::error::body_limit ||
      (code.category() == http::make_error_code(http::error::end_of_stream).category())) {
    keep_ = false;
    return send(broken_request(code));
  }
  if (!code) handle();
}

void HttpSession::handle() {
  ++server_.requests;
  const auto& message = parser_->get();
  keep_ = message.keep_alive();
  version_ = message.version();
  head_only_ = message.method() == http::verb::head;
  const auto target = parse_target({message.target().data(), message.target().size()});
  if (!target)
    return send(refuse({400, "the address is malformed", std::string(message.target()),
                        "percent-encode what is not plain ASCII"}));
  Request request = request_from(message, *target);
  if (head_only_) request.method = "GET";
  if (const auto refusal = forbidden(request, server_.access)) return send(refuse(*refusal));
  if (handed_over(request)) return;
  if (!request.path.starts_with("/api/") && request.path != "/metrics") {
    if (request.method == "GET") return send(file_answer(server_.options.web, request.path));
    return send(
        refuse({405, request.path + " does not take " + request.method, request.path, "use GET"}));
  }
  stream_.expires_never();
  answer(request, server_.brain, [self = shared_from_this()](Response response) {
    if (*self->open_) self->send(std::move(response));
  });
}

bool HttpSession::handed_over(const Request& request) {
  if (request.path == "/api/v1/events") {
    if (!websocket::is_upgrade(parser_->get())) {
      send(
          refuse({426, "events come over a WebSocket", request.path, "open ws://…/api/v1/events"}));
      return true;
    }
    std::make_shared<EventSession>(std::move(stream_), server_)->start(parser_->release());
    return true;
  }
  static const std::string kBefore = "/api/v1/cameras/", kAfter = "/stream";
  if (request.method != "GET" || !request.path.starts_with(kBefore) ||
      !request.path.ends_with(kAfter) || request.path.size() <= kBefore.size() + kAfter.size())
    return false;
  const std::string camera =
      request.path.substr(kBefore.size(), request.path.size() - kBefore.size() - kAfter.size());
  const auto names = camera_names(server_.brain.state());
  if (std::find(names.begin(), names.end(), camera) == names.end()) {
    send(refuse(unknown_name("camera", camera, names)));
    return true;
  }
  std::make_shared<StreamSession>(std::move(stream_), server_, camera)->start();
  return true;
}

void HttpSession::send(Response response) {
  const auto message = std::make_shared<http::response<http::string_body>>();
  message->result(static_cast<unsigned>(response.status));
  message->version(version_);
  message->set(http::field::server, "chiarod");
  message->set("X-Content-Type-Options", "nosniff");
  if (!response.type.empty()) message->set(http::field::content_type, response.type);
  for (const auto& [name, value] : response.headers) message->set(name, value);
  // The page cannot put a bearer token on pictures and event streams: a cookie carries it there.
  if (response.status == 204 && !server_.access.token.empty())
    message->set(http::field::set_cookie,
                 "chiaro=" + server_.access.token + "; Path=/; HttpOnly; SameSite=Strict");
  message->keep_alive(keep_);
  if (response.status != 204) {
    const std::size_t length = response.body.size();
    if (!head_only_) message->body() = std::move(response.body);
    message->content_length(length);
  }
  stream_.expires_after(std::chrono::seconds(60));
  const auto sent = [self = shared_from_this(), message](const Code& code, std::size_t) {
    if (code || !*self->open_) return;
    if (self->keep_) return self->read();
    Code ignored;
    self->stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  };
  if (!head_only_) return http::async_write(stream_, *message, sent);
  const auto head = std::make_shared<http::response_serializer<http::string_body>>(*message);
  http::async_write_header(
      stream_, *head, [sent, head](const Code& code, std::size_t bytes) { sent(code, bytes); });
}

}  // namespace chiaro::panel
