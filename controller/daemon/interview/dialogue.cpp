// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/interview/dialogue.h"

namespace chiaro::daemon::interview {

void Dialogue::say(const std::string& line) {
  if (!ended_) out_ << line << "\n";
}

std::string Dialogue::answer(const std::string& question, const std::string& otherwise) {
  if (ended_) return otherwise;
  out_ << question << (otherwise.empty() ? "" : " [" + otherwise + "]") << ": " << std::flush;
  std::string line;
  if (!std::getline(in_, line)) {
    ended_ = true;
    out_ << "\n";
    return otherwise;
  }
  const auto first = line.find_first_not_of(" \t\r");
  if (first == std::string::npos) return otherwise;
  return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

void Dialogue::complain(const core::Problems& problems) {
  for (const core::Problem& problem : problems) out_ << "  " << core::to_string(problem) << "\n";
}

}  // namespace chiaro::daemon::interview
