// SPDX-License-Identifier: Apache-2.0
// `soak_listen INTERFACE UNIVERSES SECONDS [HZ]`: hears every sACN data packet that reaches the
// interface, by the kernel's own time stamps, and prints one line of numbers:
//   packets missing late p50 p99 p99.9 max off99.9 dropped
// Gaps between two packets of a universe in ms; off99.9: how far from the period 99.9 % of them
// stay; late: gaps half a period too long; missing: jumps of the sequence; dropped: packets that
// this listener itself lost (then the run does not count).
#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

namespace {

constexpr std::size_t kBatch = 256, kBytes = 700, kUdp = 14 + 20 + 8;

struct Universe {
  std::int64_t last_ns = 0;
  std::uint8_t sequence = 0;
  bool heard = false;
};

struct Tally {
  std::vector<Universe> universes = std::vector<Universe>(65536);
  std::vector<float> gaps_ms;
  std::uint64_t packets = 0, missing = 0, late = 0;

  void hear(const unsigned char* packet, std::size_t size, std::int64_t at_ns, double period_ms) {
    if (size < kUdp + 126 || std::memcmp(packet + kUdp + 4, "ASC-E1.17", 9) != 0) return;
    if (packet[kUdp + 21] != 0x04 || packet[kUdp + 43] != 0x02) return;  // data packets alone
    Universe& u = universes[packet[kUdp + 113] * 256u + packet[kUdp + 114]];
    const std::uint8_t sequence = packet[kUdp + 111];
    ++packets;
    if (u.heard) {
      const double gap = static_cast<double>(at_ns - u.last_ns) * 1e-6;
      gaps_ms.push_back(static_cast<float>(gap));
      missing += static_cast<std::uint8_t>(sequence - u.sequence - 1);
      if (gap > 1.5 * period_ms) ++late;
    }
    u = {at_ns, sequence, true};
  }
};

int listen_on(const char* interface) {
  const int descriptor = socket(AF_PACKET, SOCK_RAW, htons(ETH_P_IP));
  const int on = 1, room = 64 << 20;
  setsockopt(descriptor, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  setsockopt(descriptor, SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof room);
  sockaddr_ll here{};
  here.sll_family = AF_PACKET;
  here.sll_protocol = htons(ETH_P_IP);
  here.sll_ifindex = static_cast<int>(if_nametoindex(interface));
  if (bind(descriptor, reinterpret_cast<sockaddr*>(&here), sizeof here) != 0) {
    std::perror("soak_listen");
    std::exit(3);
  }
  return descriptor;
}

std::int64_t stamp_of(msghdr& header) {
  for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c))
    if (c->cmsg_level == SOL_SOCKET && c->cmsg_type == SCM_TIMESTAMPNS) {
      timespec time{};
      std::memcpy(&time, CMSG_DATA(c), sizeof time);
      return time.tv_sec * 1000000000LL + time.tv_nsec;
    }
  return 0;
}

double share(std::vector<float>& sorted, double of) {
  if (sorted.empty()) return 0;
  const auto at = static_cast<std::size_t>(of * static_cast<double>(sorted.size() - 1));
  return sorted[at];
}

}  // namespace

int main(int count, char** words) {
  if (count < 4) return std::fprintf(stderr, "soak_listen INTERFACE UNIVERSES SECONDS [HZ]\n"), 2;
  const double seconds = std::atof(words[3]);
  const double period_ms = 1000 / (count > 4 ? std::atof(words[4]) : 40.0);
  const int descriptor = listen_on(words[1]);
  Tally tally;
  tally.gaps_ms.reserve(static_cast<std::size_t>(std::atof(words[2]) * seconds * 50) + 1000);
  static std::array<std::array<unsigned char, kBytes>, kBatch> bytes;
  static std::array<std::array<unsigned char, 64>, kBatch> control;
  static std::array<iovec, kBatch> vectors;
  static std::array<mmsghdr, kBatch> messages;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < end) {
    for (std::size_t i = 0; i < kBatch; ++i) {
      vectors[i] = {bytes[i].data(), kBytes};
      messages[i] = {};
      messages[i].msg_hdr.msg_iov = &vectors[i];
      messages[i].msg_hdr.msg_iovlen = 1;
      messages[i].msg_hdr.msg_control = control[i].data();
      messages[i].msg_hdr.msg_controllen = control[i].size();
    }
    pollfd wait{descriptor, POLLIN, 0};
    if (poll(&wait, 1, 100) <= 0) continue;
    const int got = recvmmsg(descriptor, messages.data(), kBatch, MSG_DONTWAIT, nullptr);
    for (int i = 0; i < got; ++i) {
      auto& message = messages[static_cast<std::size_t>(i)];
      tally.hear(bytes[static_cast<std::size_t>(i)].data(), message.msg_len,
                 stamp_of(message.msg_hdr), period_ms);
    }
    usleep(2000);  // batches: the listener is to take little of the machine
  }
  tpacket_stats statistics{};
  socklen_t size = sizeof statistics;
  getsockopt(descriptor, SOL_PACKET, PACKET_STATISTICS, &statistics, &size);
  auto& gaps = tally.gaps_ms;
  std::sort(gaps.begin(), gaps.end());
  std::vector<float> off;
  for (const float gap : gaps) off.push_back(std::abs(gap - static_cast<float>(period_ms)));
  std::sort(off.begin(), off.end());
  std::printf("%llu %llu %llu %.3f %.3f %.3f %.3f %.3f %u\n",
              static_cast<unsigned long long>(tally.packets),
              static_cast<unsigned long long>(tally.missing),
              static_cast<unsigned long long>(tally.late), share(gaps, 0.5), share(gaps, 0.99),
              share(gaps, 0.999), gaps.empty() ? 0 : gaps.back(), share(off, 0.999),
              statistics.tp_drops);
}
