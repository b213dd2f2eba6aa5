// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/artnet_node.h"

#include <algorithm>
#include <map>

namespace chiaro::drivers::artnet {

Node::Node(std::vector<int> port_addresses, Identity identity)
    : identity_(std::move(identity)), dice_(1) {
  for (const int address : port_addresses) {
    inputs_.emplace_back();
    inputs_.back().port_address = address;
  }
  // Boxes must not all answer together: the dice begin where no two boxes are alike.
  for (const std::uint8_t byte : identity_.mac) dice_ = dice_ * 31u + byte;
}

Node::Heard Node::hear(std::span<const std::uint8_t> datagram, const ports::Endpoint& from,
                       ports::TimePoint now) {
  const auto operation = operation_of(datagram);
  if (operation == Operation::poll) {
    constexpr std::size_t kMostAskers = 32;  // more are nobody's controllers
    if (asked_by_.size() < kMostAskers &&
        std::find(asked_by_.begin(), asked_by_.end(), from) == asked_by_.end())
      asked_by_.push_back(from);
    dice_ = dice_ * 1664525u + 1013904223u;
    if (!answer_at_) answer_at_ = now + kReplyWithin * (dice_ >> 16u) / 65536;
    return Heard::poll;
  }
  if (operation == Operation::sync) {
    synced_ = now;
    for (Input& input : inputs_) input.shown = input.merged;
    return Heard::sync;
  }
  const auto packet = parse_dmx(datagram);
  if (!packet) return Heard::other;
  for (Input& input : inputs_)
    if (input.port_address == packet->port_address) return take(input, *packet, from, now);
  return Heard::other_port;
}

Node::Heard Node::take(Input& input, const HeardDmx& packet, const ports::Endpoint& from,
                       ports::TimePoint now) {
  auto& sources = input.sources;
  std::erase_if(sources, [&](const Source& s) { return now - s.heard > kMergeTimeout; });
  auto source = std::find_if(sources.begin(), sources.end(),
                             [&](const Source& s) { return s.address == from.address; });
  if (source == sources.end()) {
    if (sources.size() == 2) return Heard::third_source;
    sources.push_back({from.address, 0, now, {}});
    source = std::prev(sources.end());
  } else if (!in_sequence(source->sequence, packet.sequence)) {
    return Heard::out_of_sequence;
  }
  source->sequence = packet.sequence;
  source->heard = now;
  // A shorter packet leaves the slots behind it as they were.
  std::copy(packet.levels.begin(), packet.levels.end(), source->levels.begin());
  show(input, now);
  return Heard::levels;
}

/// ArtSync counts only while it comes, and never for a port that merges two senders.
bool Node::synchronised(ports::TimePoint now) const {
  return synced_ && now - *synced_ <= kSyncTimeout;
}

void Node::show(Input& input, ports::TimePoint now) const {
  if (input.sources.empty()) return;
  input.merged = input.sources.front().levels;
  for (const Source& source : input.sources)
    for (std::size_t i = 0; i < kSlots; ++i)
      input.merged[i] = std::max(input.merged[i], source.levels[i]);
  if (!synchronised(now) || input.sources.size() > 1) input.shown = input.merged;
}

const std::array<std::uint8_t, kSlots>& Node::levels(std::size_t i, ports::TimePoint now) {
  Input& input = inputs_[i];
  const auto gone =
      std::erase_if(input.sources, [&](const Source& s) { return now - s.heard > kMergeTimeout; });
  if (gone > 0) show(input, now);
  if (synced_ && !synchronised(now)) input.shown = input.merged;
  return input.shown;
}

std::vector<std::string> Node::sources(std::size_t i) const {
  std::vector<std::string> names;
  for (const Source& source : inputs_[i].sources) names.push_back(source.address);
  return names;
}

/// One answer for each four ports of one net and sub-net, numbered by its bind index.
std::vector<Node::Answer> Node::answers(ports::TimePoint now) {
  if (!answer_at_ || now < *answer_at_) return {};
  answer_at_.reset();
  std::map<int, std::vector<const Input*>> by_sub_net;
  for (const Input& input : inputs_) by_sub_net[input.port_address >> 4].push_back(&input);
  std::vector<Answer> answers;
  std::uint8_t index = 0;
  for (const auto& [sub_net, inputs] : by_sub_net)
    for (std::size_t first = 0; first < inputs.size(); first += 4) {
      Reply reply;
      reply.ip = identity_.ip;
      reply.mac = identity_.mac;
      reply.short_name = identity_.name;
      reply.long_name = identity_.name;
      reply.report = "#0001 [0000] ready";
      reply.net = static_cast<std::uint8_t>(sub_net >> 4);
      reply.sub_net = static_cast<std::uint8_t>(sub_net & 15);
      reply.bind_index = ++index;
      for (std::size_t i = first; i < std::min(first + 4, inputs.size()); ++i)
        reply.ports.push_back({static_cast<std::uint8_t>(inputs[i]->port_address & 15), true, false,
                               inputs[i]->sources.size() > 1});
      for (const auto& asker : asked_by_)
        answers.push_back({{asker.address, kPort}, reply_packet(reply)});
    }
  asked_by_.clear();
  return answers;
}

}  // namespace chiaro::drivers::artnet
