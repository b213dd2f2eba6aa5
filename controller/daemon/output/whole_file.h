// SPDX-License-Identifier: Apache-2.0
// Files that are either the old or the new version, whatever happens in between: kill -9 or a power
// cut at any system call, a full disk, a folder that is gone.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "controller/core/result.h"

namespace chiaro::daemon {

/// The system calls that it takes, so that a test may fail any of them, or end the program there.
/// Each answers like its namesake.
class FileCalls {
 public:
  virtual ~FileCalls() = default;
  virtual int open(const char* path, int flags, unsigned mode);
  virtual std::ptrdiff_t write(int descriptor, const char* bytes, std::size_t size);
  virtual int fsync(int descriptor);
  virtual int close(int descriptor);
  virtual int rename(const char* from, const char* to);
  virtual int link(const char* from, const char* to);
  virtual int unlink(const char* path);
};

/// Temporary file, fsync, rename, fsync of the folder (made when missing). With more than one
/// generation the versions before stay beside it, the newest as `file`.1.
core::Result<core::Done> write_whole(const std::filesystem::path& file, const std::string& text,
                                     int generations = 1);
core::Result<core::Done> write_whole(const std::filesystem::path& file, const std::string& text,
                                     int generations, FileCalls& calls);
/// `file` for 0, else `file`.N.
std::filesystem::path generation_of(const std::filesystem::path& file, int generation);

}  // namespace chiaro::daemon
