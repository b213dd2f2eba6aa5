// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/hand_link.h"

#include <vector>

#include "controller/daemon/box.h"
#include "controller/daemon/box_words.h"
#include "controller/daemon/file_lock.h"

namespace chiaro::daemon {

struct HandLink::Parts {
  std::filesystem::path folder;
  std::uint64_t fingerprint = 0;
  std::size_t fixtures = 0;
  std::unique_ptr<FileLock> lock;
  std::unique_ptr<BoxWriter> writer;
  std::vector<std::uint64_t> wanted_words, sent_words;
  BoxFormat format;  ///< of the hand's box
  std::unique_ptr<BoxReader> reader;
  std::uint64_t tried = 0;  ///< identity of the last box that was refused
  rig::Sent newest;
  bool any = false;
  std::string silence = "chiaro-output has not reported yet";

  void look_for_box();
};

HandLink::HandLink(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
HandLink::~HandLink() = default;

core::Result<std::unique_ptr<HandLink>> HandLink::open(const std::filesystem::path& folder,
                                                       const studio::Studio& studio) {
  if (const auto made = make_runtime_folder(folder); !made) return made.problems();
  auto parts = std::make_unique<Parts>();
  auto lock = FileLock::take(folder / "brain.lock", "chiarod");
  if (!lock) return lock.problems();
  const BoxFormat format = wanted_format(studio);
  auto writer = BoxWriter::create(folder / "wanted.box", format);
  if (!writer) return writer.problems();
  parts->folder = folder;
  parts->fingerprint = studio.fingerprint;
  parts->fixtures = studio.fixtures.size();
  parts->lock = std::move(*lock);
  parts->writer = std::move(*writer);
  parts->wanted_words.resize(format.words);
  parts->format = sent_format(studio);
  parts->sent_words.resize(parts->format.words);
  parts->newest = sized_sent(studio);
  return std::unique_ptr<HandLink>(new HandLink(std::move(parts)));
}

void HandLink::post(rig::Wanted wanted, ports::TimePoint now) {
  wanted.studio_fingerprint = parts_->fingerprint;
  wanted.posted_ns = now.time_since_epoch().count();
  to_words(wanted, parts_->fixtures, parts_->wanted_words);
  parts_->writer->post(parts_->wanted_words);
}

void HandLink::Parts::look_for_box() {
  const auto file = folder / "sent.box";
  const std::uint64_t identity = box_identity(file);
  if (identity == 0) {
    if (!reader) silence = "chiaro-output is not running";
    return;
  }
  if ((reader && !reader->replaced()) || identity == tried) return;
  auto opened = BoxReader::open(file, format);
  if (opened) {
    reader = std::move(*opened);
    silence.clear();
    return;
  }
  tried = identity;
  reader.reset();
  any = false;
  silence = opened.problems().front().what;
}

std::optional<rig::Sent> HandLink::report() {
  Parts& parts = *parts_;
  parts.look_for_box();
  if (parts.reader && parts.reader->read(parts.sent_words)) {
    from_words(parts.sent_words, parts.newest);
    parts.any = true;
  }
  if (!parts.any) return std::nullopt;
  return parts.newest;
}

bool HandLink::hand_alive(ports::TimePoint now) {
  const auto sent = report();
  return sent && now.time_since_epoch().count() - sent->sent_ns <= kHandSilent.count();
}

const std::string& HandLink::silence() const { return parts_->silence; }

std::optional<rig::Wanted> HandLink::adopted() {
  const auto sent = report();
  if (!sent) return std::nullopt;
  rig::Wanted wanted;
  wanted.sources = sent->sources;
  for (const auto hands : {rig::Source::cue, rig::Source::own})
    for (auto& state : wanted.sources[static_cast<std::size_t>(hands)].fixtures) state = {};
  wanted.masters = sent->masters;
  wanted.master_id = sent->master_id;
  wanted.blackout = sent->blackout;
  wanted.blackout_id = sent->blackout_id;
  wanted.marks = sent->marks;
  for (std::size_t i = 0; i < wanted.marks.size(); ++i)
    wanted.marks[i] = static_cast<rig::Marks>(wanted.marks[i] & ~sent->own_marks[i]);
  wanted.blind = sent->blind;
  wanted.motion_stop = sent->motion_stop;
  wanted.motion_armed = sent->motion_armed;
  return wanted;
}

}  // namespace chiaro::daemon
