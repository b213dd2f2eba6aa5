// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/http_client.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace chiaro::drivers {
namespace {

using Clock = std::chrono::steady_clock;

/// Owns a file descriptor.
class Socket {
 public:
  explicit Socket(int descriptor) : descriptor_(descriptor) {}
  ~Socket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

/// How long a request may still take, and whether somebody wants it to end.
struct Patience {
  Clock::time_point deadline;
  const std::atomic<bool>* stop = nullptr;

  /// True once `events` may go on; false when patience ended. Looks at `stop` ten times a second.
  bool wait(int descriptor, short events) const {
    for (;;) {
      const auto left = deadline - Clock::now();
      if (left <= Clock::duration::zero() || (stop != nullptr && *stop)) return false;
      const auto slice = std::chrono::ceil<std::chrono::milliseconds>(left).count();
      pollfd one{descriptor, events, 0};
      const int ready = ::poll(&one, 1, static_cast<int>(std::min<long>(slice, 100)));
      if (ready > 0) return true;
      if (ready < 0 && errno != EINTR) return false;
    }
  }
};

core::Problem out_of_reach(const HttpUrl& url, const std::string& why) {
  return {{},
          url.host + ":" + std::to_string(url.port) + " is out of reach: " + why,
          "check that the program or device is running and the address is right"};
}

using AddressList = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

core::Result<AddressList> resolve(const HttpUrl& url) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error =
      ::getaddrinfo(url.host.c_str(), std::to_string(url.port).c_str(), &hints, &found);
  if (error != 0) return out_of_reach(url, ::gai_strerror(error));
  return AddressList(found, &::freeaddrinfo);
}

core::Result<std::unique_ptr<Socket>> connect(const HttpUrl& url, const Patience& patience) {
  auto addresses = resolve(url);
  if (!addresses) return addresses.problems();
  auto socket =
      std::make_unique<Socket>(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (socket->get() < 0) return out_of_reach(url, std::strerror(errno));
  const int yes = 1;
  ::setsockopt(socket->get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  if (::connect(socket->get(), (*addresses)->ai_addr, (*addresses)->ai_addrlen) != 0) {
    if (errno != EINPROGRESS) return out_of_reach(url, std::strerror(errno));
    if (!patience.wait(socket->get(), POLLOUT)) return out_of_reach(url, "no answer in time");
    int error = 0;
    socklen_t size = sizeof error;
    ::getsockopt(socket->get(), SOL_SOCKET, SO_ERROR, &error, &size);
    if (error != 0) return out_of_reach(url, std::strerror(error));
  }
  return socket;
}

std::string words_of(const HttpRequest& request, const HttpUrl& url) {
  std::string text = request.method + " " + url.target + " HTTP/1.1\r\nHost: " + url.host + ":" +
                     std::to_string(url.port) + "\r\nConnection: close\r\n";
  if (!request.token.empty()) text += "Authorization: Bearer " + request.token + "\r\n";
  if (!request.body.empty() || request.method != "GET")
    text += "Content-Type: " + request.type +
            "\r\nContent-Length: " + std::to_string(request.body.size()) + "\r\n";
  return text + "\r\n" + request.body;
}

bool send_all(int socket, const std::string& text, const Patience& patience) {
  std::size_t sent = 0;
  while (sent < text.size()) {
    const auto n = ::send(socket, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (n > 0) {
      sent += static_cast<std::size_t>(n);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!patience.wait(socket, POLLOUT)) return false;
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

core::Result<HttpReply> receive(int socket, const HttpUrl& url, const Patience& patience) {
  std::string bytes;
  std::array<char, 65536> some;
  for (;;) {
    const auto n = ::recv(socket, some.data(), some.size(), 0);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno != EAGAIN && errno != EWOULDBLOCK)
      return out_of_reach(url, std::strerror(errno));
    if (n < 0) {
      if (!patience.wait(socket, POLLIN)) return out_of_reach(url, "no whole answer in time");
      continue;
    }
    bytes.append(some.data(), static_cast<std::size_t>(n));
    if (bytes.size() > kMostHttpBody) return out_of_reach(url, "its answer has no end");
    auto reply = parse_http_reply(bytes, n == 0);
    if (!reply || reply->status != 0) return reply;
  }
}

/// Joins the chunks of a body as they come.
class Unchunker {
 public:
  /// Takes what it can of `raw` and gives what of it is body.
  std::string take(std::string& raw) {
    std::string body;
    while (!ended_) {
      const std::size_t some = std::min(left_, raw.size());
      body.append(raw, 0, some);
      raw.erase(0, some);
      left_ -= some;
      if (left_ > 0) break;
      const std::size_t skip = behind_ ? 2 : 0;  // each chunk ends with an empty line
      const auto line = raw.find("\r\n", skip);
      if (line == std::string::npos) {
        ended_ = raw.size() > 64;
        break;
      }
      std::size_t size = 0;
      const auto read = std::from_chars(raw.data() + skip, raw.data() + line, size, 16);
      ended_ = read.ec != std::errc() || size == 0 || size > kMostHttpBody;
      raw.erase(0, line + 2);
      left_ = ended_ ? 0 : size;
      behind_ = true;
    }
    return body;
  }
  /// Its last chunk has come, or it is no chunked body at all.
  bool ended() const { return ended_; }

 private:
  std::size_t left_ = 0;
  bool behind_ = false, ended_ = false;
};

class OpenStream final : public HttpStream {
 public:
  OpenStream(std::unique_ptr<Socket> socket, const std::atomic<bool>* stop)
      : socket_(std::move(socket)), stop_(stop) {}

  /// Reads until the head is there.
  core::Result<core::Done> read_head(const HttpUrl& url, const Patience& patience) {
    constexpr std::size_t kMostHead = 65536;
    while (raw_.find("\r\n\r\n") == std::string::npos) {
      if (raw_.size() > kMostHead) return out_of_reach(url, "its answer is not HTTP");
      if (!receive_some() || (!any_ && !patience.wait(socket_->get(), POLLIN)))
        return out_of_reach(url, "no answer in time");
    }
    const auto blank = raw_.find("\r\n\r\n");
    const std::string head = raw_.substr(0, blank + 4);
    raw_.erase(0, blank + 4);
    const auto parsed = parse_http_head(head);
    if (!parsed) return parsed.problems();
    status_ = parsed->status;
    type_ = parsed->type;
    length_ = parsed->length;
    chunked_ = parsed->chunked;
    return core::Done{};
  }

  int status() const override { return status_; }
  const std::string& type() const override { return type_; }
  std::optional<std::size_t> length() const override { return length_; }

  std::optional<std::size_t> read(std::span<char> into, ports::Duration timeout) override {
    if (const auto held = give(into); !held || *held > 0) return held;
    if (!receive_some()) return std::nullopt;
    if (!any_) {
      const Patience patience{Clock::now() + timeout, stop_};
      if (!patience.wait(socket_->get(), POLLIN)) return 0;
      if (!receive_some()) return std::nullopt;
    }
    return give(into);
  }

 private:
  std::optional<std::size_t> give(std::span<char> into) {
    if (chunked_) {
      body_ += unchunker_.take(raw_);
      if (body_.empty() && unchunker_.ended()) return std::nullopt;
    } else if (!raw_.empty()) {
      body_ += std::exchange(raw_, {});
    }
    const std::size_t some = std::min(into.size(), body_.size());
    std::copy_n(body_.begin(), some, into.begin());
    body_.erase(0, some);
    return some;
  }
  /// What waits at the socket; false when nothing ever will.
  bool receive_some() {
    std::array<char, 65536> bytes;
    any_ = false;
    const auto n = ::recv(socket_->get(), bytes.data(), bytes.size(), 0);
    if (n < 0) return errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK;
    if (n == 0) return false;
    any_ = true;
    raw_.append(bytes.data(), static_cast<std::size_t>(n));
    return true;
  }

  std::unique_ptr<Socket> socket_;
  const std::atomic<bool>* stop_;
  std::string raw_, body_;
  Unchunker unchunker_;
  bool chunked_ = false, any_ = false;
  int status_ = 0;
  std::string type_;
  std::optional<std::size_t> length_;
};

}  // namespace

core::Result<std::unique_ptr<HttpStream>> open_http_stream(const std::string& address,
                                                           ports::Duration timeout,
                                                           const std::atomic<bool>* stop) {
  const auto url = parse_http_url(address);
  if (!url) return url.problems();
  const Patience patience{Clock::now() + timeout, stop};
  auto socket = connect(*url, patience);
  if (!socket) return socket.problems();
  HttpRequest request;
  request.url = address;
  if (!send_all((*socket)->get(), words_of(request, *url), patience))
    return out_of_reach(*url, "the request could not be sent");
  auto stream = std::make_unique<OpenStream>(std::move(*socket), stop);
  if (const auto head = stream->read_head(*url, patience); !head) return head.problems();
  return std::unique_ptr<HttpStream>(std::move(stream));
}

core::Result<HttpUrl> parse_http_url(const std::string& url) {
  const core::Problem wrong{{},
                            "'" + url + "' is not an address such as http://127.0.0.1:8090/path",
                            "write http://, the host, and the port after a colon"};
  const std::string scheme = "http://";
  if (url.compare(0, scheme.size(), scheme) != 0) return wrong;
  HttpUrl result;
  const auto slash = url.find('/', scheme.size());
  std::string host =
      url.substr(scheme.size(), slash == std::string::npos ? slash : slash - scheme.size());
  if (slash != std::string::npos) result.target = url.substr(slash);
  if (const auto colon = host.find(':'); colon != std::string::npos) {
    const auto* end = host.data() + host.size();
    const auto read = std::from_chars(host.data() + colon + 1, end, result.port);
    if (read.ec != std::errc() || read.ptr != end || result.port == 0) return wrong;
    host.resize(colon);
  }
  const bool clean = std::all_of(url.begin(), url.end(), [](char c) { return c > ' ' && c < 127; });
  if (host.empty() || !clean) return wrong;
  result.host = host;
  return result;
}

core::Result<HttpReply> http_request(const HttpRequest& request, ports::Duration timeout,
                                     const std::atomic<bool>* stop) {
  const auto url = parse_http_url(request.url);
  if (!url) return url.problems();
  const Patience patience{Clock::now() + timeout, stop};
  const auto socket = connect(*url, patience);
  if (!socket) return socket.problems();
  if (!send_all((*socket)->get(), words_of(request, *url), patience))
    return out_of_reach(*url, "the request could not be sent");
  return receive((*socket)->get(), *url, patience);
}

}  // namespace chiaro::drivers
