// SPDX-License-Identifier: Apache-2.0
// One of a kind: a lock that its owner holds for life and that the kernel frees when it is killed.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "controller/core/result.h"

namespace chiaro::daemon {

class FileLock {
 public:
  /// `what` names the program for the person who starts a second one: "chiarod".
  static core::Result<std::unique_ptr<FileLock>> take(const std::filesystem::path& file,
                                                      const std::string& what);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

/// Makes the folder for boxes and sockets, for its owner and group alone.
core::Result<core::Done> make_runtime_folder(const std::filesystem::path& folder);

}  // namespace chiaro::daemon
