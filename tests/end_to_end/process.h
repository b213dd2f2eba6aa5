// SPDX-License-Identifier: Apache-2.0
// Real processes for the end-to-end tests: run to their end, or in the background.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <sys/types.h>
#include <vector>

namespace chiaro::end_to_end {

using Environment = std::map<std::string, std::string>;

/// A program in the background, its output in files. Ended with SIGTERM, then SIGKILL, when it goes
/// out of scope; it dies with the test program too.
class Process {
 public:
  Process(const std::vector<std::string>& words, const Environment& environment,
          const std::filesystem::path& folder, const std::string& name);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  /// Blocks; the exit code, or 128 + the signal that ended it.
  int wait();
  /// Asks it to end and waits.
  int stop();
  std::string out() const;
  std::string err() const;

 private:
  pid_t pid_;
  int exit_ = -1;
  std::filesystem::path out_, err_;
};

struct Finished {
  int exit = -1;
  std::string out, err;
};
Finished run(const std::vector<std::string>& words, const Environment& environment,
             const std::filesystem::path& folder);

/// Looks again and again, a little apart, until `true`; false after `seconds` (a hang, not a
/// measure of speed: give plenty).
bool eventually(const std::function<bool()>& holds, double seconds = 90);

/// The running child of `parent` whose program is called `name`; -1 when there is none.
pid_t child_of(pid_t parent, const std::string& name);
std::string content_of(const std::filesystem::path& file);

}  // namespace chiaro::end_to_end
