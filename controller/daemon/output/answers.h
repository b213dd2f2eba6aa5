// SPDX-License-Identifier: Apache-2.0
// What may be said to the hand over its socket, one line each, and its answers, one line of JSON
// each. They come after the loop has acted.
//
//   status                              blackout on|off          reload    release
//   motion stop|release|arm|disarm      motion home LAMP
//   mark KIND on|off LAMP               marks off
//   level PERCENT|release LAMP          master NAME PERCENT          blind on|off
//   cue go|back|off|list    cue to N    cue remove N
//   record start FILE|stop|status
//   cue record N [fade S] [follow S] [name WORDS]
//
// KIND: highlight, flash, solo, park, move-in-black. LAMP: a fixture's name, or * for all. N: a
// cue's number; `record` keeps what is on stage now.
#pragma once

#include <atomic>
#include <filesystem>
#include <poll.h>
#include <string>

#include "controller/daemon/output/hand.h"
#include "controller/daemon/output/housekeeper.h"

namespace chiaro::daemon {

/// One thread at a time, which waits for the loop where it must; blackouts come from any thread.
class Answers {
 public:
  /// `release` is set when somebody asks the hand to say goodbye and end.
  Answers(Hand& hand, Housekeeper& housekeeper, std::atomic<bool>& release,
          std::filesystem::path state_folder)
      : hand_(hand),
        housekeeper_(housekeeper),
        release_(release),
        state_folder_(std::move(state_folder)) {}
  Answers(const Answers& other)
      : Answers(other.hand_, other.housekeeper_, other.release_, other.state_folder_) {}

  std::string to(const std::string& line);
  /// No more waiting for the loop: it ends. Any thread.
  void end() { ending_ = true; }

 private:
  std::string blackout(bool on);
  std::string motion(const std::string& word);
  std::string home(const std::string& lamp);
  std::string mark(const std::string& words);
  std::string unmark();
  std::string level(const std::string& words);
  std::string master(const std::string& words);
  std::string blind(bool on);
  std::string tape(const std::string& words);
  std::string wish_for(const std::string& lamp, Wish wish);
  std::string cue(const std::string& words);
  std::string cue_list() const;
  std::string cue_moves(Wish::Kind kind, double number);
  std::string record(double number, const std::string& words);
  std::string remove(double number);
  std::string keep(std::unique_ptr<rig::CueList> list);
  std::string status() const;
  std::string cue_now(const rig::Sent& sent) const;
  /// True when the loop has obeyed and its report of that is here.
  bool done(const Wish& wish);
  /// The loop never waits for us, so we look, for a second at most.
  template <class Condition>
  bool wait(Condition condition) const {
    for (int i = 0; i < 1000 && !ending_; ++i) {
      if (condition()) return true;
      ::poll(nullptr, 0, 1);
    }
    return false;
  }

  Hand& hand_;
  Housekeeper& housekeeper_;
  std::atomic<bool>& release_;
  const std::filesystem::path state_folder_;
  std::atomic<bool> ending_{false};
};

}  // namespace chiaro::daemon
