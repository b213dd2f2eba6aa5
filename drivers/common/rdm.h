// SPDX-License-Identifier: Apache-2.0
// RDM (ANSI E1.20): asking the lamps of a DMX line who they are. Messages, the search for every
// device by halving the range of identifiers, and the few questions that a patch needs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "controller/core/result.h"

namespace chiaro::drivers::rdm {

using Bytes = std::vector<std::uint8_t>;
/// Maker (16 bits) and device (32 bits).
using Uid = std::uint64_t;
inline constexpr Uid kEverybody = 0xffffffffffff;
/// "4368:00000001".
std::string to_string(Uid uid);
std::optional<Uid> uid_in(const std::string& text);

enum class Command : std::uint8_t { discover = 0x10, get = 0x20, set = 0x30 };
enum class Parameter : std::uint16_t {
  unique_branch = 0x0001,
  mute = 0x0002,
  unmute = 0x0003,
  device_info = 0x0060,
  model = 0x0080,
  maker = 0x0081,
  label = 0x0082,
  identify = 0x1000
};
struct Message {
  Uid to = 0, from = 0;
  std::uint8_t number = 0;  ///< answers carry it back
  std::uint8_t port = 1;    ///< in an answer: its kind; 0 = ack
  Command command = Command::get;
  bool answer = false;
  std::uint16_t parameter = 0;
  Bytes data;
};
/// With start code and checksum. Precondition: at most 231 bytes of data.
Bytes packet(const Message& message);
/// Nothing when length or checksum is wrong.
std::optional<Message> parse(std::span<const std::uint8_t> bytes);
/// Who answered a unique branch; nothing when several spoke at once.
std::optional<Uid> parse_branch_answer(std::span<const std::uint8_t> bytes);

/// A DMX line that RDM can be spoken on. One thread.
class Line {
 public:
  virtual ~Line() = default;
  /// What was answered, from its first byte on, however garbled; empty = nobody spoke; nullopt =
  /// the line is gone. A broadcast is not answered.
  virtual std::optional<Bytes> exchange(std::span<const std::uint8_t> packet, bool discovery) = 0;
};

struct Device {
  Uid uid = 0;
  bool answered = false;  ///< its device info came
  std::uint16_t model = 0, category = 0, footprint = 0, address = 0;
  std::uint32_t software = 0;
  std::uint8_t mode = 0, modes = 0;
  std::string maker, name, label;
};

/// Asks on one line; counts its messages.
class Controller {
 public:
  Controller(Line& line, Uid own) : line_(line), own_(own) {}
  /// Every device of the line, ascending. A problem when the line went away, or talks without end.
  core::Result<std::vector<Uid>> discover();
  core::Result<Device> ask(Uid uid);
  core::Result<core::Done> identify(Uid uid, bool on);

 private:
  /// Both ends included.
  bool search(Uid least, Uid most, std::vector<Uid>& found);
  bool mute(Uid uid);
  /// The answer to it; nothing when none came, or a refusal.
  std::optional<Message> say(Uid to, Command command, Parameter parameter, Bytes data);

  Line& line_;
  const Uid own_;
  std::uint8_t number_ = 0;
  bool gone_ = false;
  int messages_ = 0;
};

}  // namespace chiaro::drivers::rdm
