// SPDX-License-Identifier: Apache-2.0
// Every Modbus TCP request that we can send, taken from a real loopback connection, as a stranger
// reads it: Wireshark's dissector must know each and find no fault.
#include <arpa/inet.h>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

#include "drivers/common/sacn_packet.h"
#include "drivers/common/system_devices.h"
#include "tests/support/fake_world.h"

namespace chiaro::drivers {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

/// A device that says yes to everything, written from the standard, and remembers the conversation.
class Device {
 public:
  Device() : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address);
    ::listen(listener_, 1);
    socklen_t size = sizeof address;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  /// Ends when the far end has closed.
  std::vector<std::pair<bool, Bytes>> conversation() {
    thread_.join();
    ::close(listener_);
    return said_;
  }
  std::uint16_t port() const { return port_; }

 private:
  void serve() {
    const int socket = ::accept(listener_, nullptr, nullptr);
    Bytes request(7);
    while (::recv(socket, request.data(), 7, MSG_WAITALL) == 7) {
      const std::size_t rest = sacn::get16(request, 4) - 1u;
      request.resize(7 + rest);
      if (::recv(socket, request.data() + 7, rest, MSG_WAITALL) != static_cast<ssize_t>(rest))
        break;
      said_.emplace_back(true, request);
      const Bytes reply = answer(request);
      said_.emplace_back(false, reply);
      if (::send(socket, reply.data(), reply.size(), MSG_NOSIGNAL) < 0) break;
      request.resize(7);
    }
    ::close(socket);
  }
  static Bytes answer(const Bytes& request) {
    Bytes reply(request.begin(), request.begin() + 12);
    if (request[7] == 3 || request[7] == 4) {
      const std::size_t bytes = 2u * sacn::get16(request, 10);
      reply.resize(9);
      reply[8] = static_cast<std::uint8_t>(bytes);
      reply.resize(9 + bytes, 0);
    }
    sacn::put16(reply, 4, reply.size() - 6);
    return reply;
  }

  const int listener_;
  std::uint16_t port_ = 0;
  std::vector<std::pair<bool, Bytes>> said_;  ///< true: by us
  std::thread thread_;
};

/// The conversation as a capture of TCP segments to and from port 502.
class Capture {
 public:
  explicit Capture(const std::filesystem::path& file) : out_(file, std::ios::binary) {
    for (const std::uint32_t value : {0xa1b2c3d4u, 0x00040002u, 0u, 0u, 65535u, 101u}) word(value);
  }
  void add(bool request, const Bytes& payload) {
    Bytes ip{0x45, 0, 0, 0, 0, 1, 0, 0, 20, 6, 0, 0, 127, 0, 0, 1, 127, 0, 0, 2};
    if (!request) std::swap(ip[15], ip[19]);
    const std::size_t total = 40 + payload.size();
    sacn::put16(ip, 2, total);
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < ip.size(); i += 2) sum += sacn::get16(ip, i);
    sacn::put16(ip, 10, static_cast<std::uint16_t>(~((sum & 0xffffu) + (sum >> 16u))));
    Bytes tcp(20);
    sacn::put16(tcp, 0, request ? 50000 : 502);
    sacn::put16(tcp, 2, request ? 502 : 50000);
    sacn::put16(tcp, 6, next_[request ? 1 : 0]);
    sacn::put16(tcp, 10, next_[request ? 0 : 1]);
    tcp[12] = 0x50;
    tcp[13] = 0x18;
    sacn::put16(tcp, 14, 65535);
    next_[request ? 1 : 0] += payload.size();
    word(0);
    word(++time_);
    word(static_cast<std::uint32_t>(total));
    word(static_cast<std::uint32_t>(total));
    for (const Bytes* part :
         {static_cast<const Bytes*>(&ip), static_cast<const Bytes*>(&tcp), &payload})
      out_.write(reinterpret_cast<const char*>(part->data()),
                 static_cast<std::streamsize>(part->size()));
  }

 private:
  void word(std::uint32_t value) {
    out_.write(reinterpret_cast<const char*>(&value), sizeof value);
  }
  std::ofstream out_;
  std::uint32_t time_ = 0;
  std::array<std::size_t, 2> next_{1000, 2000};
};

std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> bytes;
  for (std::size_t got = 0; (got = std::fread(bytes.data(), 1, bytes.size(), pipe)) > 0;)
    text.append(bytes.data(), got);
  ::pclose(pipe);
  return text;
}

TEST(ModbusTcpPackets, AreWholeAndRightToWireshark) {
  Device device;
  {
    SystemDevices devices;
    ports::ModbusLine line;
    line.host = "127.0.0.1";
    line.port = device.port();
    auto link = devices.open_modbus(line);
    ASSERT_TRUE(link) << core::to_string(link.problems());
    const std::vector<std::uint16_t> values{1, 2, 65535};
    std::array<std::uint16_t, 2> back{};
    using Outcome = ports::ModbusLink::Outcome;
    EXPECT_EQ((*link)->write(3, 0x10, values, 5s), Outcome::done);
    EXPECT_EQ((*link)->write_single(3, 0x15, 0x0102, 5s), Outcome::done);
    EXPECT_EQ((*link)->read(3, false, 0x20, back, 5s), Outcome::done);
    EXPECT_EQ((*link)->read(3, true, 0x21, back, 5s), Outcome::done);
  }
  const support::TemporaryFolder folder;
  const auto file = folder.path() / "modbus.pcap";
  const auto said = device.conversation();
  ASSERT_EQ(said.size(), 8u);
  {
    Capture capture(file);
    for (const auto& [request, bytes] : said) capture.add(request, bytes);
  }
  const std::string text = output_of("tshark -r " + file.string() + " -V 2>/dev/null");
  ASSERT_FALSE(text.empty()) << "tshark is needed: apt-get install tshark";
  EXPECT_EQ(text.find("Malformed"), std::string::npos) << text;
  EXPECT_EQ(text.find("Expert Info"), std::string::npos) << text;
  for (const char* word :
       {"Write Multiple Registers", "Write Single Register", "Read Holding Registers",
        "Read Input Registers", "Unit Identifier: 3", "Reference Number: 16", "Word Count: 3"})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
  const std::string fields = output_of("tshark -r " + file.string() +
                                       " -Y 'tcp.dstport==502' -T fields -e mbtcp.len "
                                       "-e mbtcp.unit_id -e modbus.func_code 2>/dev/null");
  EXPECT_EQ(fields, "13\t3\t16\n6\t3\t6\n6\t3\t3\n6\t3\t4\n");
}

}  // namespace
}  // namespace chiaro::drivers
