// SPDX-License-Identifier: Apache-2.0
#include "tests/support/fake_network.h"

#include <algorithm>
#include <array>

namespace chiaro::support {
namespace {

constexpr std::size_t kHeld = 4096, kLongest = 1472;

struct Held {
  std::size_t size = 0;
  std::uint16_t from_port = 0;
  std::array<std::uint8_t, kLongest> bytes;
};

bool is_multicast(const std::string& address) {
  const int first = std::atoi(address.c_str());
  return first >= 224 && first <= 239;
}

class FakeDatagram;

}  // namespace

struct FakeNetwork::Wire {
  mutable std::mutex mutex;
  std::vector<FakeDatagram*> sockets;
  std::vector<std::string> interfaces{"", "lo"};
  bool unplugged = false;
  std::uint64_t sent = 0, dropped = 0;
  std::uint16_t next_port = 49152;
};

namespace {

class FakeDatagram final : public ports::DatagramSocket {
 public:
  FakeDatagram(std::shared_ptr<FakeNetwork::Wire> wire, std::uint16_t port)
      : wire_(std::move(wire)), port_(port) {}
  ~FakeDatagram() override {
    const std::scoped_lock lock(wire_->mutex);
    std::erase(wire_->sockets, this);
  }

  bool send(const ports::Endpoint& to, std::span<const std::uint8_t> datagram) override {
    const std::scoped_lock lock(wire_->mutex);
    if (wire_->unplugged || datagram.size() > kLongest) return false;
    ++wire_->sent;
    for (FakeDatagram* socket : wire_->sockets)
      if (socket->hears(to)) socket->deliver(port_, datagram);
    return true;
  }

  std::optional<std::size_t> receive(std::span<std::uint8_t> into, ports::Endpoint* from) override {
    const std::scoped_lock lock(wire_->mutex);
    if (count_ == 0) return std::nullopt;
    const Held& held = ring_[first_];
    first_ = (first_ + 1) % kHeld;
    --count_;
    const std::size_t size = std::min(held.size, into.size());
    std::copy_n(held.bytes.begin(), size, into.begin());
    if (from != nullptr) *from = {"127.0.0.1", held.from_port};
    return size;
  }

  core::Result<core::Done> join(const std::string& group) override {
    const std::scoped_lock lock(wire_->mutex);
    if (!is_multicast(group)) return core::Problem{{}, group + " is not a multicast group", ""};
    groups_.push_back(group);
    return core::Done{};
  }

  std::uint16_t port() const { return port_; }
  /// Only sockets with a chosen port are receivers; they hold what arrives.
  void become_receiver() { ring_.resize(kHeld); }

 private:
  bool hears(const ports::Endpoint& to) const {
    if (to.port != port_ || ring_.empty()) return false;
    return !is_multicast(to.address) ||
           std::find(groups_.begin(), groups_.end(), to.address) != groups_.end();
  }
  void deliver(std::uint16_t from_port, std::span<const std::uint8_t> datagram) {
    if (count_ == kHeld) {
      ++wire_->dropped;
      return;
    }
    Held& held = ring_[(first_ + count_++) % kHeld];
    held.size = datagram.size();
    held.from_port = from_port;
    std::copy(datagram.begin(), datagram.end(), held.bytes.begin());
  }

  std::shared_ptr<FakeNetwork::Wire> wire_;
  std::uint16_t port_;
  std::vector<std::string> groups_;
  std::vector<Held> ring_;
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace

FakeNetwork::FakeNetwork() : wire_(std::make_shared<Wire>()) {}
FakeNetwork::~FakeNetwork() = default;

core::Result<std::unique_ptr<ports::DatagramSocket>> FakeNetwork::open_datagram(
    const Options& options) {
  const std::scoped_lock lock(wire_->mutex);
  const auto& known = wire_->interfaces;
  if (std::find(known.begin(), known.end(), options.interface) == known.end())
    return core::Problem{{}, "there is no network interface '" + options.interface + "'", ""};
  const bool taken =
      std::any_of(wire_->sockets.begin(), wire_->sockets.end(),
                  [&](const FakeDatagram* s) { return s->port() == options.local_port; });
  if (options.local_port != 0 && taken && !options.share_port)
    return core::Problem{
        {}, "cannot use UDP port " + std::to_string(options.local_port) + ": in use", ""};
  const std::uint16_t port = options.local_port != 0 ? options.local_port : wire_->next_port++;
  auto socket = std::make_unique<FakeDatagram>(wire_, port);
  if (options.local_port != 0) socket->become_receiver();
  wire_->sockets.push_back(socket.get());
  return std::unique_ptr<ports::DatagramSocket>(std::move(socket));
}

std::optional<ports::Network::Address> FakeNetwork::address_of(const std::string& interface) {
  const std::scoped_lock lock(wire_->mutex);
  const auto& known = wire_->interfaces;
  if (std::find(known.begin(), known.end(), interface) == known.end()) return std::nullopt;
  return Address{"127.0.0.1", "127.255.255.255", {2, 0, 0, 0, 0, 1}};
}

void FakeNetwork::unplug(bool unplugged) {
  const std::scoped_lock lock(wire_->mutex);
  wire_->unplugged = unplugged;
}
void FakeNetwork::add_interface(const std::string& name) {
  const std::scoped_lock lock(wire_->mutex);
  wire_->interfaces.push_back(name);
}
std::uint64_t FakeNetwork::sent() const {
  const std::scoped_lock lock(wire_->mutex);
  return wire_->sent;
}
std::uint64_t FakeNetwork::dropped() const {
  const std::scoped_lock lock(wire_->mutex);
  return wire_->dropped;
}

}  // namespace chiaro::support
