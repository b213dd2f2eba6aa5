// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/system_network.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <netpacket/packet.h>
#include <sys/socket.h>
#include <unistd.h>

namespace chiaro::drivers {
namespace {

sockaddr_in address_of(const ports::Endpoint& endpoint) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(endpoint.port);
  inet_pton(AF_INET, endpoint.address.c_str(), &address.sin_addr);
  return address;
}

class SystemDatagram final : public ports::DatagramSocket {
 public:
  SystemDatagram(int descriptor, unsigned interface_index, std::string interface)
      : descriptor_(descriptor),
        interface_index_(interface_index),
        interface_(std::move(interface)) {}
  ~SystemDatagram() override { ::close(descriptor_); }
  SystemDatagram(const SystemDatagram&) = delete;
  SystemDatagram& operator=(const SystemDatagram&) = delete;

  bool send(const ports::Endpoint& to, std::span<const std::uint8_t> datagram) override {
    const sockaddr_in address = address_of(to);
    const auto sent =
        ::sendto(descriptor_, datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                 reinterpret_cast<const sockaddr*>(&address), sizeof address);
    return sent == static_cast<ssize_t>(datagram.size());
  }

  void send_all(std::span<ports::Outgoing> datagrams) override {
    while (!datagrams.empty()) {
      const auto taken = std::min(datagrams.size(), kTogether);
      send_together(datagrams.first(taken));
      datagrams = datagrams.subspan(taken);
    }
  }

  std::optional<std::size_t> receive(std::span<std::uint8_t> into, ports::Endpoint* from) override {
    sockaddr_in address{};
    socklen_t length = sizeof address;
    const auto got = ::recvfrom(descriptor_, into.data(), into.size(), MSG_DONTWAIT,
                                reinterpret_cast<sockaddr*>(&address), &length);
    if (got < 0) return std::nullopt;
    if (from != nullptr) {
      char text[INET_ADDRSTRLEN] = {};
      inet_ntop(AF_INET, &address.sin_addr, text, sizeof text);
      *from = {text, ntohs(address.sin_port)};
    }
    return static_cast<std::size_t>(got);
  }

  core::Result<core::Done> join(const std::string& group) override {
    ip_mreqn request{};
    inet_pton(AF_INET, group.c_str(), &request.imr_multiaddr);
    request.imr_ifindex = static_cast<int>(interface_index_);
    if (::setsockopt(descriptor_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) != 0 &&
        errno != EADDRINUSE)
      return core::Problem{{},
                           "cannot join multicast group " + group + " on interface '" + interface_ +
                               "': " + std::strerror(errno),
                           "check the interface with `ip link`"};
    return core::Done{};
  }

  int descriptor() const override { return descriptor_; }

 private:
  static constexpr std::size_t kTogether = 64;

  void send_together(std::span<ports::Outgoing> datagrams) {
    std::array<sockaddr_in, kTogether> to;
    std::array<iovec, kTogether> bytes;
    std::array<mmsghdr, kTogether> messages;
    for (std::size_t i = 0; i < datagrams.size(); ++i) {
      to[i] = address_of(*datagrams[i].to);
      const auto& datagram = datagrams[i].datagram;
      bytes[i] = {const_cast<std::uint8_t*>(datagram.data()), datagram.size()};
      messages[i] = {};
      messages[i].msg_hdr.msg_name = &to[i];
      messages[i].msg_hdr.msg_namelen = sizeof to[i];
      messages[i].msg_hdr.msg_iov = &bytes[i];
      messages[i].msg_hdr.msg_iovlen = 1;
    }
    for (std::size_t at = 0; at < datagrams.size();) {
      const int sent =
          ::sendmmsg(descriptor_, &messages[at], static_cast<unsigned>(datagrams.size() - at),
                     MSG_DONTWAIT | MSG_NOSIGNAL);
      for (int i = 0; i < sent; ++i, ++at)
        datagrams[at].sent = messages[at].msg_len == datagrams[at].datagram.size();
      if (sent <= 0) datagrams[at++].sent = false;  // the others may have a way
    }
  }

  int descriptor_;
  unsigned interface_index_;
  std::string interface_;
};

}  // namespace

core::Result<std::unique_ptr<ports::DatagramSocket>> SystemNetwork::open_datagram(
    const Options& options) {
  unsigned index = 0;
  if (!options.interface.empty() && (index = ::if_nametoindex(options.interface.c_str())) == 0)
    return core::Problem{{},
                         "there is no network interface '" + options.interface + "'",
                         "`ip link` lists their names"};
  const int descriptor = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0)
    return core::Problem{{},
                         std::string("cannot open a UDP socket: ") + std::strerror(errno),
                         "are too many files open?"};
  auto socket = std::make_unique<SystemDatagram>(descriptor, index, options.interface);
  const int on = 1;
  if (options.broadcast) ::setsockopt(descriptor, SOL_SOCKET, SO_BROADCAST, &on, sizeof on);
  if (options.share_port) ::setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (index != 0) {
    // Multicast leaves by the default route unless told otherwise: the commonest "sACN does not
    // work".
    ip_mreqn out{};
    out.imr_ifindex = static_cast<int>(index);
    ::setsockopt(descriptor, IPPROTO_IP, IP_MULTICAST_IF, &out, sizeof out);
  }
  ::setsockopt(descriptor, IPPROTO_IP, IP_MULTICAST_LOOP, &on, sizeof on);
  sockaddr_in local{};
  local.sin_family = AF_INET;
  local.sin_port = htons(options.local_port);
  if (::bind(descriptor, reinterpret_cast<const sockaddr*>(&local), sizeof local) != 0)
    return core::Problem{
        {},
        "cannot use UDP port " + std::to_string(options.local_port) + ": " + std::strerror(errno),
        errno == EADDRINUSE ? "another program has it; `ss -lunp` shows which"
                            : "choose a port above 1024"};
  return std::unique_ptr<ports::DatagramSocket>(std::move(socket));
}

std::optional<ports::Network::Address> SystemNetwork::address_of(const std::string& interface) {
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return std::nullopt;
  std::optional<Address> found;
  std::string name;
  const auto text = [](const sockaddr* address) {
    char dotted[INET_ADDRSTRLEN] = {};
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(address)->sin_addr, dotted,
              sizeof dotted);
    return std::string(dotted);
  };
  for (const ifaddrs* one = all; one != nullptr && !found; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    const bool loopback = (one->ifa_flags & IFF_LOOPBACK) != 0;
    if ((one->ifa_flags & IFF_UP) == 0) continue;
    if (interface.empty() ? loopback : interface != one->ifa_name) continue;
    found.emplace();
    found->own = text(one->ifa_addr);
    // The loopback has no broadcast address of its own, but answers to that of its network; an
    // address that was set by hand often has none either. The mask always tells.
    if (one->ifa_netmask != nullptr) {
      const auto at = reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr.s_addr;
      sockaddr_in all_of_them{};
      all_of_them.sin_addr.s_addr =
          at | ~reinterpret_cast<const sockaddr_in*>(one->ifa_netmask)->sin_addr.s_addr;
      found->broadcast = text(reinterpret_cast<const sockaddr*>(&all_of_them));
    } else {
      found->broadcast = "255.255.255.255";
    }
    name = one->ifa_name;
  }
  for (const ifaddrs* one = all; one != nullptr && found; one = one->ifa_next)
    if (one->ifa_addr != nullptr && one->ifa_addr->sa_family == AF_PACKET && name == one->ifa_name)
      std::copy_n(reinterpret_cast<const sockaddr_ll*>(one->ifa_addr)->sll_addr, 6,
                  found->mac.begin());
  ::freeifaddrs(all);
  return found;
}

}  // namespace chiaro::drivers
