// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/rdm.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <numeric>

namespace chiaro::drivers::rdm {
namespace {

constexpr std::uint8_t kStartCode = 0xcc, kSubStart = 0x01;
constexpr std::size_t kHead = 24;
/// 64 devices need about 500; a line that never grows quiet is broken.
constexpr int kMostMessages = 20000;
constexpr int kTries = 3;

void put(Bytes& bytes, Uid value, int count) {
  for (int i = count - 1; i >= 0; --i)
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i) & 0xff));
}
Uid get(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t count) {
  Uid value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8u | bytes[at + i];
  return value;
}
std::uint16_t sum_of(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint16_t>(std::accumulate(bytes.begin(), bytes.end(), 0u));
}
/// What a device says of itself is for people: no control characters.
std::string text_in(const Bytes& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes)
    if (byte >= ' ' && byte < 0x7f) text += static_cast<char>(byte);
  return text.substr(0, 32);
}

}  // namespace

std::string to_string(Uid uid) {
  char text[16];
  std::snprintf(text, sizeof text, "%04x:%08x", static_cast<unsigned>(uid >> 32u & 0xffffu),
                static_cast<unsigned>(uid & 0xffffffffu));
  return text;
}

std::optional<Uid> uid_in(const std::string& text) {
  if (text.size() != 13 || text[4] != ':') return std::nullopt;
  const std::string digits = text.substr(0, 4) + text.substr(5);
  Uid uid = 0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), uid, 16);
  if (code != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return uid;
}

Bytes packet(const Message& message) {
  Bytes bytes{kStartCode, kSubStart, static_cast<std::uint8_t>(kHead + message.data.size())};
  put(bytes, message.to, 6);
  put(bytes, message.from, 6);
  bytes.push_back(message.number);
  bytes.push_back(message.port);
  bytes.push_back(0);  // messages that wait
  put(bytes, 0, 2);    // the root device
  bytes.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(message.command) |
                                            (message.answer ? 1u : 0u)));
  put(bytes, message.parameter, 2);
  bytes.push_back(static_cast<std::uint8_t>(message.data.size()));
  bytes.insert(bytes.end(), message.data.begin(), message.data.end());
  put(bytes, sum_of(bytes), 2);
  return bytes;
}

std::optional<Message> parse(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHead + 2 || bytes[0] != kStartCode || bytes[1] != kSubStart)
    return std::nullopt;
  const std::size_t length = bytes[2];
  if (length < kHead || bytes.size() < length + 2 || length != kHead + bytes[23] ||
      get(bytes, length, 2) != sum_of(bytes.first(length)))
    return std::nullopt;
  Message message;
  message.to = get(bytes, 3, 6);
  message.from = get(bytes, 9, 6);
  message.number = bytes[15];
  message.port = bytes[16];
  message.command = static_cast<Command>(bytes[20] & 0xfeu);
  message.answer = (bytes[20] & 1u) != 0;
  message.parameter = static_cast<std::uint16_t>(get(bytes, 21, 2));
  message.data.assign(bytes.begin() + kHead, bytes.begin() + static_cast<std::ptrdiff_t>(length));
  return message;
}

std::optional<Uid> parse_branch_answer(std::span<const std::uint8_t> bytes) {
  // Up to seven FE, which a line may swallow, and an AA lead in.
  std::size_t at = 0;
  while (at < bytes.size() && at < 8 && bytes[at] == 0xfe) ++at;
  if (bytes.size() < at + 17 || bytes[at] != 0xaa) return std::nullopt;
  const auto coded = bytes.subspan(at + 1, 16);
  const auto decoded = [&](std::size_t i) {
    return static_cast<Uid>(coded[2 * i] & coded[2 * i + 1]);
  };
  for (std::size_t i = 0; i < 8; ++i)
    if ((coded[2 * i] | 0xaa) != coded[2 * i] || (coded[2 * i + 1] | 0x55) != coded[2 * i + 1])
      return std::nullopt;
  if ((decoded(6) << 8u | decoded(7)) != sum_of(coded.first(12))) return std::nullopt;
  Uid uid = 0;
  for (std::size_t i = 0; i < 6; ++i) uid = uid << 8u | decoded(i);
  return uid;
}

std::optional<Message> Controller::say(Uid to, Command command, Parameter parameter, Bytes data) {
  const auto asked = static_cast<std::uint16_t>(parameter);
  for (int i = 0; i < (to == kEverybody ? 1 : kTries) && !gone_; ++i) {
    const std::uint8_t number = number_++;
    ++messages_;
    const auto answer =
        line_.exchange(packet({to, own_, number, 1, command, false, asked, data}), false);
    gone_ = !answer;
    if (gone_ || to == kEverybody) return std::nullopt;
    const auto heard = parse(*answer);
    if (!heard || heard->from != to || !heard->answer || heard->number != number ||
        heard->parameter != asked)
      continue;
    constexpr std::uint8_t kAck = 0;
    if (heard->port == kAck) return heard;
    return std::nullopt;  // refused, or asks for patience: no answer that we could use
  }
  return std::nullopt;
}

bool Controller::mute(Uid uid) {
  return say(uid, Command::discover, Parameter::mute, {}).has_value();
}

bool Controller::search(Uid least, Uid most, std::vector<Uid>& found) {
  while (!gone_ && messages_ < kMostMessages) {
    Bytes range;
    put(range, least, 6);
    put(range, most, 6);
    ++messages_;
    const auto branch = static_cast<std::uint16_t>(Parameter::unique_branch);
    const auto answer = line_.exchange(
        packet({kEverybody, own_, number_++, 1, Command::discover, false, branch, range}), true);
    gone_ = !answer;
    if (gone_ || answer->empty()) return !gone_;
    const auto one = parse_branch_answer(*answer);
    if (one && *one >= least && *one <= most && mute(*one)) {
      if (std::find(found.begin(), found.end(), *one) == found.end()) found.push_back(*one);
      continue;  // others may have hidden behind it
    }
    if (least == most) {  // garbled every time: it may be there all the same
      if (mute(least)) found.push_back(least);
      return !gone_;
    }
    const Uid middle = least + (most - least) / 2;
    return search(least, middle, found) && search(middle + 1, most, found);
  }
  return false;
}

core::Result<std::vector<Uid>> Controller::discover() {
  std::vector<Uid> found;
  messages_ = 0;
  (void)say(kEverybody, Command::discover, Parameter::unmute, {});
  if (!search(0, kEverybody - 1, found))
    return core::Problem{{},
                         gone_ ? "the adapter went away" : "the line never grows quiet",
                         gone_ ? "plug it in again"
                               : "look for a missing terminator or an RDM splitter that echoes"};
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

core::Result<Device> Controller::ask(Uid uid) {
  Device device;
  device.uid = uid;
  const auto info = say(uid, Command::get, Parameter::device_info, {});
  if (info && info->data.size() >= 19) {
    const std::span<const std::uint8_t> data(info->data);
    device.answered = true;
    device.model = static_cast<std::uint16_t>(get(data, 2, 2));
    device.category = static_cast<std::uint16_t>(get(data, 4, 2));
    device.software = static_cast<std::uint32_t>(get(data, 6, 4));
    device.footprint = static_cast<std::uint16_t>(get(data, 10, 2));
    device.mode = data[12];
    device.modes = data[13];
    device.address = static_cast<std::uint16_t>(get(data, 14, 2));
    if (device.address > 512) device.address = 0;  // 0xffff: it takes no slots
  }
  const auto words = [&](Parameter parameter) {
    const auto answer = say(uid, Command::get, parameter, {});
    return answer ? text_in(answer->data) : "";
  };
  device.maker = words(Parameter::maker);
  device.name = words(Parameter::model);
  device.label = words(Parameter::label);
  if (gone_) return core::Problem{{}, "the adapter went away", "plug it in again"};
  return device;
}

core::Result<core::Done> Controller::identify(Uid uid, bool on) {
  const auto said =
      say(uid, Command::set, Parameter::identify, {static_cast<std::uint8_t>(on ? 1 : 0)});
  if (said || uid == kEverybody) return core::Done{};
  return core::Problem{{},
                       to_string(uid) + " does not answer",
                       gone_ ? "plug the adapter in again" : "`chiaro rdm` lists who does"};
}

}  // namespace chiaro::drivers::rdm
