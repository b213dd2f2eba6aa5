// SPDX-License-Identifier: Apache-2.0
// Modbus on real file descriptors: RTU through a pseudo terminal against a device written here from
// the standard, TCP on the loopback against libmodbus's own server.
#include <arpa/inet.h>
#include <cstdlib>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <modbus.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <thread>
#include <unistd.h>

#include "drivers/common/system_devices.h"

namespace chiaro::drivers {
namespace {

using namespace std::chrono_literals;
using Outcome = ports::ModbusLink::Outcome;
using Bytes = std::vector<std::uint8_t>;

/// CRC-16/MODBUS, low byte first on the wire.
std::uint16_t crc(const Bytes& bytes) {
  unsigned sum = 0xffff;
  for (const std::uint8_t byte : bytes) {
    sum ^= byte;
    for (int i = 0; i < 8; ++i) sum = (sum & 1u) != 0 ? sum >> 1u ^ 0xa001u : sum >> 1u;
  }
  return static_cast<std::uint16_t>(sum);
}

/// Unit 7 at the far end of a pseudo terminal: takes function 16, refuses registers above 99, and
/// leaves every other unit unanswered.
class RtuDevice {
 public:
  RtuDevice() : master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    ::grantpt(master_);
    ::unlockpt(master_);
    node_ = ::ptsname(master_);
    thread_ = std::thread([this] { serve(); });
  }
  ~RtuDevice() {
    stop_ = true;
    thread_.join();
    ::close(master_);
  }
  RtuDevice(const RtuDevice&) = delete;
  RtuDevice& operator=(const RtuDevice&) = delete;
  const std::string& node() const { return node_; }
  std::vector<Bytes> heard() {
    const std::scoped_lock lock(mutex_);
    return heard_;
  }

 private:
  void serve() {
    Bytes request;
    while (!stop_) {
      pollfd ready{master_, POLLIN, 0};
      if (::poll(&ready, 1, 20) <= 0) continue;
      std::array<std::uint8_t, 256> bytes;
      const auto got = ::read(master_, bytes.data(), bytes.size());
      if (got <= 0) continue;  // nobody has the other end open yet
      request.insert(request.end(), bytes.begin(), bytes.begin() + got);
      if (request.size() < 7 || request.size() < 9u + request[6]) continue;
      answer(request);
      request.clear();
    }
  }
  void answer(const Bytes& request) {
    {
      const std::scoped_lock lock(mutex_);
      heard_.push_back(request);
    }
    if (request[0] != 7) return;
    const bool refused = request[3] > 99;
    Bytes reply = refused ? Bytes{7, 0x90, 2} : Bytes(request.begin(), request.begin() + 6);
    const std::uint16_t sum = crc(reply);
    reply.push_back(static_cast<std::uint8_t>(sum & 0xffu));
    reply.push_back(static_cast<std::uint8_t>(sum >> 8u));
    (void)!::write(master_, reply.data(), reply.size());
  }
  int master_;
  std::string node_;
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::vector<Bytes> heard_;
  std::thread thread_;
};

TEST(ModbusRtu, IsSpokenAsTheStandardSaysOnAPseudoTerminal) {
  RtuDevice device;
  SystemDevices devices;
  ports::ModbusLine line;
  line.serial.node = device.node();
  auto link = devices.open_modbus(line);
  ASSERT_TRUE(link) << core::to_string(link.problems());
  const std::vector<std::uint16_t> values{0x1234, 10000};
  EXPECT_EQ((*link)->write(7, 3, values, 2s), Outcome::done);
  const auto heard = device.heard();
  ASSERT_EQ(heard.size(), 1u);
  Bytes expected{7, 16, 0, 3, 0, 2, 4, 0x12, 0x34, 0x27, 0x10};
  const std::uint16_t sum = crc(expected);
  expected.push_back(static_cast<std::uint8_t>(sum & 0xffu));
  expected.push_back(static_cast<std::uint8_t>(sum >> 8u));
  EXPECT_EQ(heard[0], expected);
  EXPECT_EQ((*link)->write(7, 100, values, 2s), Outcome::refused);
  EXPECT_EQ((*link)->write(8, 3, values, 50ms), Outcome::no_answer);
  EXPECT_EQ((*link)->write(7, 3, values, 2s), Outcome::done) << "a silence leaves nothing behind";
}

TEST(ModbusRtu, OfALineThatIsInUseIsRefused) {
  RtuDevice device;
  SystemDevices devices;
  ports::ModbusLine line;
  line.serial.node = device.node();
  const auto first = devices.open_modbus(line);
  ASSERT_TRUE(first);
  EXPECT_FALSE(devices.open_serial(line.serial, {}));
}

TEST(ModbusTcp, ReachesLibmodbussOwnServer) {
  modbus_t* server = modbus_new_tcp("127.0.0.1", 0);
  int listening = modbus_tcp_listen(server, 1);
  ASSERT_GE(listening, 0);
  sockaddr_in address{};
  socklen_t size = sizeof address;
  ASSERT_EQ(::getsockname(listening, reinterpret_cast<sockaddr*>(&address), &size), 0);
  modbus_mapping_t* registers = modbus_mapping_new(0, 0, 16, 16);
  registers->tab_input_registers[2] = 777;
  std::thread serving([&] {
    if (modbus_tcp_accept(server, &listening) < 0) return;
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> query{};
    for (int got = 0; (got = modbus_receive(server, query.data())) >= 0;)
      if (got > 0) modbus_reply(server, query.data(), got, registers);
  });
  {
    SystemDevices devices;
    ports::ModbusLine line;
    line.host = "127.0.0.1";
    line.port = ntohs(address.sin_port);
    auto link = devices.open_modbus(line);
    ASSERT_TRUE(link) << core::to_string(link.problems());
    const std::vector<std::uint16_t> values{1, 2, 65535};
    EXPECT_EQ((*link)->write(1, 4, values, 2s), Outcome::done);
    EXPECT_EQ((*link)->write_single(1, 0, 9, 2s), Outcome::done);
    std::array<std::uint16_t, 3> back{};
    EXPECT_EQ((*link)->read(1, false, 4, back, 2s), Outcome::done);
    EXPECT_EQ(back[2], 65535);
    EXPECT_EQ((*link)->read(1, true, 2, std::span(back).first(1), 2s), Outcome::done);
    EXPECT_EQ(back[0], 777);
    EXPECT_EQ((*link)->write(1, 15, values, 2s), Outcome::refused);
  }
  serving.join();
  ::close(listening);
  modbus_mapping_free(registers);
  modbus_free(server);
}

TEST(Tty, CarriesBytesBothWaysAtTheSpeedOfDmxAndIsGoneWhenItsEndIs) {
  int master = ::posix_openpt(O_RDWR | O_NOCTTY);
  ::grantpt(master);
  ::unlockpt(master);
  SystemDevices devices;
  ports::DeviceMatch match;
  match.node = ::ptsname(master);
  auto port = devices.open_serial(match, {250000, 8, 2, 'N'});
  ASSERT_TRUE(port) << core::to_string(port.problems());
  const Bytes sent{0, 0x0d, 0x0a, 0x11, 0x13, 0xff, 0x7e};  // nothing that a terminal would eat
  ASSERT_TRUE((*port)->write(sent));
  Bytes got(sent.size());
  EXPECT_EQ(::read(master, got.data(), got.size()), static_cast<ssize_t>(sent.size()));
  EXPECT_EQ(got, sent);
  ASSERT_EQ(::write(master, sent.data(), sent.size()), static_cast<ssize_t>(sent.size()));
  EXPECT_EQ((*port)->read(got, 1s), std::optional<std::size_t>(sent.size()));
  EXPECT_EQ((*port)->read(got, 1ms), std::optional<std::size_t>(0));
  EXPECT_FALSE(devices.open_serial(match, {})) << "one master on a line";
  ::close(master);
  EXPECT_EQ((*port)->read(got, 1s), std::nullopt);
  EXPECT_FALSE((*port)->write(sent));
}

}  // namespace
}  // namespace chiaro::drivers
