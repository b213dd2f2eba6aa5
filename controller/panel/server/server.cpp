// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/server/server.h"

#include "controller/panel/server/sessions.h"

namespace chiaro::panel {
namespace {

using asio::ip::tcp;

core::Problem not_bound(const ServerOptions& options, const Code& code) {
  const std::string place = options.address + ":" + std::to_string(options.port);
  if (code == asio::error::address_in_use)
    return {{},
            "port " + std::to_string(options.port) + " at " + options.address + " is in use",
            "another chiarod may be running: stop it, or give another --port"};
  if (code == asio::error::access_denied)
    return {{}, "this user may not listen on " + place, "give a --port of 1024 or more"};
  return {{},
          "cannot listen on " + place + ": " + code.message(),
          "give --listen an address of this machine"};
}

void accept_next(Server::State& state) {
  const auto open = state.open;
  state.acceptor.async_accept([&state, open](const Code& code, tcp::socket socket) {
    if (!*open || code == asio::error::operation_aborted) return;
    const std::size_t busy = state.connections + state.events.size() + state.streams.size();
    if (!code && busy < state.options.most_connections)
      std::make_shared<HttpSession>(std::move(socket), state)->start();
    if (!code) return accept_next(state);
    // Out of descriptors, say: try again shortly rather than spin.
    state.retry.expires_after(std::chrono::milliseconds(100));
    state.retry.async_wait([&state, open](const Code& stopped) {
      if (!stopped && *open) accept_next(state);
    });
  });
}

Code listen(tcp::acceptor& acceptor, const tcp::endpoint& endpoint) {
  Code code;
  acceptor.open(endpoint.protocol(), code);
  if (!code) acceptor.set_option(asio::socket_base::reuse_address(true), code);
  if (!code) acceptor.bind(endpoint, code);
  if (!code) acceptor.listen(asio::socket_base::max_listen_connections, code);
  return code;
}

}  // namespace

core::Result<std::unique_ptr<Server>> Server::open(Loop& loop, const ServerOptions& options,
                                                   Brain& brain) {
  Code code;
  const auto address =
      asio::ip::make_address(options.address == "localhost" ? "127.0.0.1" : options.address, code);
  if (code)
    return core::Problem{{},
                         "'" + options.address + "' is not an address",
                         "give --listen an address such as 127.0.0.1 or 0.0.0.0"};
  if (!address.is_loopback() && options.token.empty())
    return core::Problem{{},
                         "listening on " + options.address + " lets others reach the lights",
                         "give a --token of your choice as well"};
  auto state = std::make_unique<State>(loop, options, brain);
  state->access = {!address.is_loopback(), options.token};
  if (const Code failed = listen(state->acceptor, {address, options.port}))
    return not_bound(options, failed);
  accept_next(*state);
  return std::unique_ptr<Server>(new Server(std::move(state)));
}

Server::Server(std::unique_ptr<State> state) : state_(std::move(state)) {}

Server::~Server() {
  *state_->open = false;
  Code ignored;
  state_->acceptor.close(ignored);
}

std::uint16_t Server::port() const { return state_->acceptor.local_endpoint().port(); }

void Server::tell(const std::string& json) {
  const auto message = std::make_shared<const std::string>(json);
  const auto events = state_->events;
  for (EventSession* session : events) session->tell(message);
}

void Server::show(const std::string& camera, std::shared_ptr<const std::string> jpeg) {
  const auto streams = state_->streams;
  for (const auto& session : streams)
    if (session->camera() == camera) session->show(jpeg);
}

std::size_t Server::listeners() const { return state_->events.size(); }
std::size_t Server::watchers() const { return state_->streams.size(); }
std::uint64_t Server::requests() const { return state_->requests; }

bool is_loopback(const std::string& text) {
  Code code;
  const auto address = asio::ip::make_address(text, code);
  return text == "localhost" || (!code && address.is_loopback());
}

std::string state_event(const panel::State& state) {
  return R"({"type":"state","state":)" + state_to_json(state) + "}";
}

}  // namespace chiaro::panel
