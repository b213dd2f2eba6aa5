// SPDX-License-Identifier: Apache-2.0
// Question and answer on a terminal or a pipe: shows the default, asks again after a bad answer.
#pragma once

#include <functional>
#include <istream>
#include <ostream>
#include <string>

#include "controller/core/result.h"

namespace chiaro::daemon::interview {

class Dialogue {
 public:
  /// Borrows both for its life.
  Dialogue(std::istream& in, std::ostream& out) : in_(in), out_(out) {}

  /// Understands an answer, or says in one sentence why not.
  template <class T>
  using Understand = std::function<core::Result<T>(const std::string&)>;

  /// Asks until the answer is understood; an empty line takes `otherwise`. Once the input has
  /// ended, asks no more and answers with defaults: look at ended() before using anything.
  template <class T>
  T ask(const std::string& question, const std::string& otherwise,
        const Understand<T>& understand) {
    while (true) {
      const std::string line = answer(question, otherwise);
      core::Result<T> understood = understand(line);
      if (understood) return std::move(*understood);
      if (ended_) return T{};
      complain(understood.problems());
    }
  }
  std::string ask(const std::string& question, const std::string& otherwise) {
    return ask<std::string>(question, otherwise, [](const std::string& line) { return line; });
  }
  void say(const std::string& line);
  /// Each problem with its remedy, a line each.
  void complain(const core::Problems& problems);
  bool ended() const { return ended_; }

 private:
  std::string answer(const std::string& question, const std::string& otherwise);

  std::istream& in_;
  std::ostream& out_;
  bool ended_ = false;
};

/// For the functions that understand: a sentence for the person.
inline core::Problem unclear(std::string what, std::string remedy = "") {
  return {{}, std::move(what), std::move(remedy), false};
}

}  // namespace chiaro::daemon::interview
