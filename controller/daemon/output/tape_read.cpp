// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "controller/core/hash.h"
#include "controller/daemon/output/tape_file.h"
#include "controller/daemon/output/tape_marks.h"

namespace chiaro::daemon {
namespace {

std::uint64_t fixed(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8u | bytes[i];
  return value;
}

bool take(std::ifstream& in, std::span<std::uint8_t> into) {
  in.read(reinterpret_cast<char*>(into.data()), static_cast<std::streamsize>(into.size()));
  return in.gcount() == static_cast<std::streamsize>(into.size());
}

}  // namespace

TapeReader::TapeReader(const std::filesystem::path& file)
    : file_(file), in_(file, std::ios::binary) {}

core::Result<std::unique_ptr<TapeReader>> TapeReader::open(const std::filesystem::path& file) {
  std::unique_ptr<TapeReader> reader(new TapeReader(file));
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    return core::Problem{{file.string()}, what, remedy, false};
  };
  if (!reader->in_)
    return refuse("this recording cannot be opened", "is the path right, and is it yours to read?");
  std::array<std::uint8_t, tape::kMagic.size() + 10> bytes{};
  const bool whole = take(reader->in_, bytes);
  if (!std::equal(tape::kMagic.begin(), tape::kMagic.end(), bytes.begin(),
                  [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }))
    return refuse("this is no recording of Chiaro's", "`chiaro record FILE` makes one");
  const std::span<const std::uint8_t> rest(bytes.data() + tape::kMagic.size(), 10);
  if (rest[0] != tape::kVersion)
    return refuse("this recording has version " + std::to_string(rest[0]) + ", and version " +
                      std::to_string(tape::kVersion) + " is known here",
                  "replay it with the Chiaro that made it, or a newer one");
  std::vector<std::uint8_t> name(whole ? rest[9] : 0u);
  if (!whole || !take(reader->in_, name))
    return refuse("this recording was cut off before its first frame", "nothing can be replayed");
  reader->head_.started = static_cast<std::int64_t>(fixed(rest.subspan(1, 8)));
  reader->head_.studio.assign(name.begin(), name.end());
  return reader;
}

void TapeReader::break_off(const std::string& what) {
  const double seconds = std::chrono::duration<double>(at_).count();
  broke_off_.push_back({{file_.string()},
                        what + ", " + std::to_string(seconds).substr(0, 8) + " s from its begin",
                        "what comes before is whole and can be replayed",
                        true});
  block_.clear();
  read_ = 0;
  sent_.clear();
}

bool TapeReader::next_block() {
  std::array<std::uint8_t, 16> front{};
  in_.read(reinterpret_cast<char*>(front.data()), front.size());
  if (in_.gcount() == 0) return false;  // its end
  const std::span<const std::uint8_t> bytes(front);
  const std::uint64_t size = fixed(bytes.subspan(4, 4));
  const bool marked = std::equal(tape::kBlock.begin(), tape::kBlock.end(), front.begin(),
                                 [](char a, std::uint8_t b) { return a == static_cast<char>(b); });
  if (in_.gcount() == static_cast<std::streamsize>(front.size()) &&
      (!marked || size > tape::kLargestBlock)) {
    break_off("the recording is damaged");
    return false;
  }
  block_.clear();
  read_ = 0;
  // A piece at a time: a damaged size must not ask for memory that the file does not fill.
  for (std::uint64_t left = in_ ? size : 0; left > 0 && in_;) {
    const std::size_t piece = std::min<std::uint64_t>(left, 1u << 20u);
    block_.resize(block_.size() + piece);
    if (!take(in_, std::span(block_).last(piece))) break;
    left -= piece;
  }
  if (!in_) {
    break_off("the recording was cut off");
    return false;
  }
  if (core::Fingerprint().add(block_).value() == fixed(bytes.subspan(8, 8))) return true;
  break_off("the recording is damaged");
  return false;
}

bool TapeReader::number(std::uint64_t& value) {
  value = 0;
  for (unsigned shift = 0; shift < 64 && read_ < block_.size(); shift += 7) {
    const std::uint8_t byte = block_[read_++];
    value |= std::uint64_t{byte & 0x7fu} << shift;
    if ((byte & 0x80u) == 0) return true;
  }
  return false;
}

bool TapeReader::read_changes(ports::DmxFrame& frame) {
  std::size_t at = 0;
  for (;;) {
    std::uint64_t skip = 0, count = 0;
    if (!number(skip) || !number(count)) return false;
    if (count == 0) return skip == 0;
    if (skip > ports::kSlots - at || count > ports::kSlots - at - skip ||
        count > block_.size() - read_)
      return false;
    at += skip;
    std::copy_n(block_.begin() + static_cast<std::ptrdiff_t>(read_), count,
                frame.levels.begin() + static_cast<std::ptrdiff_t>(at));
    at += count;
    read_ += count;
  }
}

bool TapeReader::read_tick() {
  std::uint64_t since = 0, universes = 0;
  if (!number(since) || !number(universes)) return false;
  if (since > static_cast<std::uint64_t>(tape::kLongest - at_.count())) return false;
  at_ += ports::Duration(static_cast<std::int64_t>(since));
  if (universes == 0) return !sent_.empty();
  sent_.clear();
  for (std::uint64_t i = 1; i < universes; ++i) {
    std::uint64_t universe = 0;
    if (!number(universe) || universe == 0 || universe > 0xffff) return false;
    ports::DmxFrame& frame = frames_[static_cast<std::uint16_t>(universe)];
    frame.universe = static_cast<std::uint16_t>(universe);
    if (!read_changes(frame)) return false;
    sent_.push_back(&frame);
  }
  return true;
}

bool TapeReader::next() {
  if (!broke_off_.empty()) return false;
  if (read_ == block_.size() && !next_block()) return false;
  if (read_tick()) return true;
  break_off("the recording is damaged");
  return false;
}

}  // namespace chiaro::daemon
