// SPDX-License-Identifier: Apache-2.0
// The HTTP camera against a small server on a real loopback socket: snapshots, an endless stream,
// and a camera that goes away and comes back.
#include <arpa/inet.h>
#include <atomic>
#include <functional>
#include <future>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

#include "drivers/registry.h"
#include "tests/support/fake_clock.h"

namespace chiaro::drivers {
namespace {

using namespace std::chrono_literals;

/// Answers one connection after the other with what `answer` sends.
class Server {
 public:
  using Answer = std::function<void(const Server&, int socket, int connection)>;
  explicit Server(Answer answer) : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address);
    ::listen(listener_, 4);
    socklen_t size = sizeof address;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this, answer = std::move(answer)] { serve(answer); });
  }
  ~Server() {
    ending_ = true;
    thread_.join();
    ::close(listener_);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/camera"; }
  bool ending() const { return ending_; }
  /// False when the far end has gone.
  static bool send(int socket, const std::string& text) {
    return ::send(socket, text.data(), text.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(text.size());
  }

 private:
  void serve(const Answer& answer) {
    for (int connection = 0; !ending_;) {
      pollfd one{listener_, POLLIN, 0};
      if (::poll(&one, 1, 20) <= 0) continue;
      const int socket = ::accept(listener_, nullptr, nullptr);
      std::string head;
      char byte = 0;
      while (head.find("\r\n\r\n") == std::string::npos && ::recv(socket, &byte, 1, 0) == 1)
        head += byte;
      answer(*this, socket, connection++);
      ::close(socket);
    }
  }

  const int listener_;
  std::uint16_t port_ = 0;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

/// One pixel of that grey, as a picture file.
std::string picture(int grey) { return "P6 1 1 255\n" + std::string(3, static_cast<char>(grey)); }
std::string snapshot(int grey) {
  const std::string body = picture(grey);
  return "HTTP/1.1 200 OK\r\nContent-Type: image/x-portable-pixmap\r\nContent-Length: " +
         std::to_string(body.size()) + "\r\n\r\n" + body;
}
const std::string kStreamHead =
    "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=frame\r\n\r\n--frame\r\n";
std::string part_of(const std::string& body) {
  return "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body + "\r\n--frame\r\n";
}
std::string part(int grey) { return part_of(picture(grey)); }

class AnHttpCamera : public testing::Test {
 protected:
  void connect(Server::Answer answer) {
    server_ = std::make_unique<Server>(std::move(answer));
    CameraSettings settings;
    settings.source = server_->url();
    settings.stop = &stop_;
    camera_ = std::move(*make_camera(settings, clock_));
  }
  /// The grey of the picture that comes; -1 = none, with the reason in `why_`.
  int grab() {
    const auto frame = camera_->grab(10s);
    why_ = frame ? "" : frame.problems()[0].what;
    taken_ = frame ? frame->taken : ports::TimePoint{};
    return frame ? frame->picture.at(0, 0)[0] : -1;
  }

  support::FakeClock clock_{support::FakeClock::Sleep::jumps};
  std::atomic<bool> stop_{false};
  std::unique_ptr<Server> server_;
  std::unique_ptr<ports::Camera> camera_;
  std::string why_;
  ports::TimePoint taken_;
};

TEST_F(AnHttpCamera, AsksAgainForEachSnapshot) {
  connect([](const Server&, int socket, int connection) {
    Server::send(socket, snapshot(10 + connection));
  });
  EXPECT_EQ(grab(), 10) << why_;
  EXPECT_EQ(grab(), 11) << why_;
}

TEST_F(AnHttpCamera, OfAStreamGivesTheNewestPictureThatIsWhole) {
  std::promise<void> seen;
  auto looked = seen.get_future().share();
  connect([looked](const Server&, int socket, int) {
    Server::send(socket, kStreamHead + part(1) + part(2));
    looked.wait();
    Server::send(socket, part_of("torn") + part(4));
  });
  EXPECT_EQ(grab(), 2) << why_;
  EXPECT_EQ(taken_, clock_.now());
  seen.set_value();
  EXPECT_EQ(grab(), 4) << why_;
}

TEST_F(AnHttpCamera, DropsWhatHasWaitedWhileNobodyLooked) {
  std::promise<void> waiting;
  connect([&](const Server& server, int socket, int) {
    Server::send(socket, kStreamHead + part(1));
    Server::send(socket, part(7) + part(7));
    waiting.set_value();
    while (!server.ending() && Server::send(socket, part(9))) ::poll(nullptr, 0, 1);
  });
  ASSERT_GE(grab(), 1) << why_;
  waiting.get_future().wait();
  clock_.advance(1s);
  EXPECT_EQ(grab(), 9) << why_;
}

TEST_F(AnHttpCamera, IsLostWhenItsStreamEndsAndBackAtTheNextLook) {
  connect([](const Server& server, int socket, int connection) {
    Server::send(socket, kStreamHead + part(20 + connection));
    while (connection > 0 && !server.ending()) ::poll(nullptr, 0, 1);
  });
  EXPECT_EQ(grab(), 20) << why_;
  EXPECT_EQ(grab(), -1);
  EXPECT_NE(why_.find("ended its stream"), std::string::npos) << why_;
  EXPECT_EQ(grab(), 21) << why_;
}

TEST_F(AnHttpCamera, JoinsAStreamThatComesInChunks) {
  connect([](const Server& server, int socket, int) {
    const std::string body = "--frame\r\n" + part(33);
    Server::send(socket,
                 "HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\nContent-Type: "
                 "multipart/x-mixed-replace; boundary=\"frame\"\r\n\r\n");
    for (const char byte : body) Server::send(socket, std::string("1\r\n") + byte + "\r\n");
    while (!server.ending()) ::poll(nullptr, 0, 1);
  });
  EXPECT_EQ(grab(), 33) << why_;
}

TEST_F(AnHttpCamera, SaysWhatItWasAnsweredAndStopsWhenTold) {
  connect([](const Server& server, int socket, int connection) {
    if (connection == 0) Server::send(socket, "HTTP/1.1 401 Unauthorized\r\n\r\n");
    while (connection > 0 && !server.ending()) ::poll(nullptr, 0, 1);
  });
  EXPECT_EQ(grab(), -1);
  EXPECT_NE(why_.find("401"), std::string::npos) << why_;
  stop_ = true;  // the second connection never answers
  EXPECT_EQ(grab(), -1);
}

}  // namespace
}  // namespace chiaro::drivers
