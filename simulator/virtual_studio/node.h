// SPDX-License-Identifier: Apache-2.0
// The lamps' network node: listens to sACN and Art-Net on the interfaces that the studio's outputs
// name, as a bought node would, and decodes what it hears through the same patch that encoded it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "controller/patch/plan.h"
#include "controller/ports/network.h"
#include "controller/studio/studio.h"
#include "drivers/common/artnet_node.h"
#include "drivers/common/sacn_receiver.h"

namespace chiaro::simulator {

/// One thread at a time.
class Node {
 public:
  /// One socket per interface, joined to the group of each of its universes.
  static core::Result<Node> open(const studio::Studio& studio, ports::Network& network);

  /// Takes all datagrams that wait.
  void listen(ports::TimePoint now);
  /// True once any levels have been heard: before that, lamps on the wire are dark.
  bool heard() const { return heard_; }
  /// What the lamps are told, by fixture index. Without a live source they hold the last levels.
  std::vector<core::FixtureState> levels(ports::TimePoint now);

  /// Of universe number i: the names of its live sources, and the packets taken in.
  struct Report {
    std::uint16_t universe = 0;
    std::vector<std::string> sources;
  };
  std::vector<Report> report() const;
  std::uint64_t packets() const { return packets_; }
  std::uint64_t out_of_sequence() const { return out_of_sequence_; }

 private:
  explicit Node(patch::Plan plan);
  core::Result<core::Done> open_sacn(const studio::Studio& studio, ports::Network& network);
  core::Result<core::Done> open_artnet(const studio::Studio& studio, ports::Network& network);
  void listen_to_artnet(ports::TimePoint now);

  /// One Art-Net node on one interface.
  struct ArtNet {
    std::unique_ptr<ports::DatagramSocket> socket;
    drivers::artnet::Node node;
    std::vector<std::size_t> frames;  ///< which of frames_ each of its ports is
  };

  patch::Plan plan_;
  drivers::sacn::Receiver receiver_;
  std::vector<std::unique_ptr<ports::DatagramSocket>> sockets_;
  std::vector<ArtNet> artnet_;
  std::vector<ports::DmxFrame> frames_;
  std::uint64_t packets_ = 0, out_of_sequence_ = 0;
  bool heard_ = false;
};

}  // namespace chiaro::simulator
