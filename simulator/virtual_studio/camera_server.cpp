// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/camera_server.h"

// clang-format off: the order matters. Boost.Asio 1.74 uses std::exchange without including it.
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <utility>
// clang-format on

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

namespace chiaro::simulator {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Code = beast::error_code;
using tcp = asio::ip::tcp;
using Bytes = std::shared_ptr<const std::string>;

Bytes answer(int status, const std::string& reason, const std::string& type,
             const std::string& body) {
  return std::make_shared<const std::string>(
      "HTTP/1.1 " + std::to_string(status) + " " + reason +
      "\r\nServer: chiaro-sim\r\nCache-Control: no-store\r\nConnection: close\r\nContent-Type: " +
      type + "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
}

}  // namespace

/// Somebody who waits for pictures. Lives on the I/O thread.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(tcp::socket socket, CameraServer::State& server)
      : stream_(std::move(socket)), server_(server) {}
  void read();
  void show(const Bytes& jpeg);

 private:
  void route(const std::string& target);
  void wait_for(std::size_t camera, bool streaming);
  void write(Bytes bytes, std::function<void()> then);

  beast::tcp_stream stream_;
  CameraServer::State& server_;
  beast::flat_buffer buffer_{16384};
  http::request<http::empty_body> request_;
  std::size_t camera_ = 0;
  bool streaming_ = false;
};

struct CameraServer::State {
  explicit State(Options given) : options(std::move(given)) {}

  void accept();
  void wait(const std::shared_ptr<Session>& session, std::size_t camera);
  void show(const Wish& wish, const Bytes& jpeg);

  struct Waiting {
    std::shared_ptr<Session> session;
    Wish wish;
  };
  Options options;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  std::thread thread;
  std::mutex mutex;  ///< guards what follows: read by the camera's thread
  std::vector<Waiting> waiting;
  std::uint64_t asked = 0;
};

// ---- a session
// -----------------------------------------------------------------------------------

void Session::read() {
  stream_.expires_after(std::chrono::seconds(30));
  http::async_read(stream_, buffer_, request_,
                   [self = shared_from_this()](const Code& code, std::size_t) {
                     if (!code) self->route(std::string(self->request_.target()));
                   });
}

void Session::route(const std::string& target) {
  const auto finish = [self = shared_from_this()] {
    Code ignored;
    self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  };
  if (request_.method() != http::verb::get)
    return write(answer(405, "Method Not Allowed", "text/plain", "only GET is known here\n"),
                 finish);
  if (target == "/status")
    return write(answer(200, "OK", "application/json", server_.options.status()), finish);
  const auto& cameras = server_.options.cameras;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (target == "/camera/" + cameras[i]) return wait_for(i, false);
    if (target == "/camera/" + cameras[i] + "/stream") return wait_for(i, true);
  }
  write(answer(404, "Not Found", "text/plain",
               "there are /status, /camera/NAME and /camera/NAME/stream here\n"),
        finish);
}

void Session::wait_for(std::size_t camera, bool streaming) {
  camera_ = camera;
  streaming_ = streaming;
  if (!streaming) return server_.wait(shared_from_this(), camera);
  write(std::make_shared<const std::string>(
            "HTTP/1.1 200 OK\r\nServer: chiaro-sim\r\nCache-Control: no-store\r\n"
            "Connection: close\r\nContent-Type: multipart/x-mixed-replace; boundary=frame\r\n"
            "\r\n--frame\r\n"),
        [self = shared_from_this()] { self->server_.wait(self, self->camera_); });
}

void Session::show(const Bytes& jpeg) {
  if (!streaming_) {
    return write(answer(200, "OK", "image/jpeg", *jpeg), [self = shared_from_this()] {
      Code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }
  write(std::make_shared<const std::string>(
            "Content-Type: image/jpeg\r\nContent-Length: " + std::to_string(jpeg->size()) +
            "\r\n\r\n" + *jpeg + "\r\n--frame\r\n"),
        [self = shared_from_this()] { self->server_.wait(self, self->camera_); });
}

void Session::write(Bytes bytes, std::function<void()> then) {
  stream_.expires_after(std::chrono::seconds(30));
  asio::async_write(stream_, asio::buffer(*bytes),
                    [self = shared_from_this(), bytes, then](const Code& code, std::size_t) {
                      self->stream_.expires_never();
                      if (!code) then();
                    });
}

// ---- the server
// ----------------------------------------------------------------------------------

void CameraServer::State::accept() {
  acceptor.async_accept([this](const Code& code, tcp::socket socket) {
    if (code == asio::error::operation_aborted) return;
    if (!code) std::make_shared<Session>(std::move(socket), *this)->read();
    accept();
  });
}

void CameraServer::State::wait(const std::shared_ptr<Session>& session, std::size_t camera) {
  {
    const std::lock_guard lock(mutex);
    waiting.push_back({session, {camera, ++asked}});
  }
  if (options.on_wish) options.on_wish();
}

void CameraServer::State::show(const Wish& wish, const Bytes& jpeg) {
  std::vector<std::shared_ptr<Session>> served;
  {
    const std::lock_guard lock(mutex);
    std::erase_if(waiting, [&](const Waiting& one) {
      const bool mine = one.wish.camera == wish.camera && one.wish.asked <= wish.asked;
      if (mine) served.push_back(one.session);
      return mine;
    });
  }
  for (const auto& session : served) session->show(jpeg);
}

core::Result<std::unique_ptr<CameraServer>> CameraServer::open(Options options) {
  auto state = std::make_shared<State>(std::move(options));
  const auto where = state->options.address + ":" + std::to_string(state->options.port);
  Code code;
  const auto address = asio::ip::make_address(state->options.address, code);
  const tcp::endpoint endpoint(address, state->options.port);
  if (!code) state->acceptor.open(endpoint.protocol(), code);
  if (!code) state->acceptor.set_option(asio::socket_base::reuse_address(true), code);
  if (!code) state->acceptor.bind(endpoint, code);
  if (!code) state->acceptor.listen(asio::socket_base::max_listen_connections, code);
  if (code)
    return core::Problem{{},
                         "the virtual camera cannot listen on " + where + ": " + code.message(),
                         code == asio::error::address_in_use
                             ? "another program has that port: end it, or choose one with --port"
                             : "choose another port with --port"};
  state->accept();
  state->thread = std::thread([state] { state->io.run(); });
  return std::unique_ptr<CameraServer>(new CameraServer(std::move(state)));
}

CameraServer::CameraServer(std::shared_ptr<State> state) : state_(std::move(state)) {}

CameraServer::~CameraServer() {
  state_->io.stop();
  state_->thread.join();
  state_->waiting.clear();
}

std::uint16_t CameraServer::port() const { return state_->acceptor.local_endpoint().port(); }

std::vector<CameraServer::Wish> CameraServer::wishes() const {
  const std::lock_guard lock(state_->mutex);
  std::map<std::size_t, std::uint64_t> newest;
  for (const auto& one : state_->waiting)
    newest[one.wish.camera] = std::max(newest[one.wish.camera], one.wish.asked);
  std::vector<Wish> result;
  for (const auto& [camera, asked] : newest) result.push_back({camera, asked});
  return result;
}

void CameraServer::show(const Wish& wish, std::string jpeg) {
  asio::post(state_->io, [state = state_.get(), wish,
                          bytes = std::make_shared<const std::string>(std::move(jpeg))] {
    state->show(wish, bytes);
  });
}

}  // namespace chiaro::simulator
