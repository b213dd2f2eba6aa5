// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/whole_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace chiaro::daemon {
namespace {

bool write_all(int descriptor, const std::string& text, FileCalls& calls) {
  std::size_t done = 0;
  while (done < text.size()) {
    const auto wrote = calls.write(descriptor, text.data() + done, text.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return false;
    done += static_cast<std::size_t>(wrote);
  }
  return true;
}

core::Problem trouble(const std::filesystem::path& file) {
  return {{file.string()},
          std::string("cannot write: ") + std::strerror(errno),
          "is there room, and is the folder yours? --state names another",
          false};
}

/// The new text under a name of its own, on the disk. A failure leaves no half of it behind.
bool write_fresh(const std::filesystem::path& fresh, const std::string& text, FileCalls& calls) {
  const int descriptor = calls.open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0640);
  if (descriptor < 0) return false;
  const bool written = write_all(descriptor, text, calls) && calls.fsync(descriptor) == 0;
  const int why = errno;
  calls.close(descriptor);
  if (written) return true;
  calls.unlink(fresh.c_str());
  errno = why;
  return false;
}

/// Moves each version one further. `file` itself stays in place the whole time: it gets a second
/// name. That some generation is missing is no trouble.
void shift(const std::filesystem::path& file, int generations, FileCalls& calls) {
  for (int g = generations - 2; g >= 1; --g)
    (void)calls.rename(generation_of(file, g).c_str(), generation_of(file, g + 1).c_str());
  if (generations > 1) (void)calls.link(file.c_str(), generation_of(file, 1).c_str());
}

}  // namespace

int FileCalls::open(const char* path, int flags, unsigned mode) {
  return ::open(path, flags, mode);
}
std::ptrdiff_t FileCalls::write(int descriptor, const char* bytes, std::size_t size) {
  return ::write(descriptor, bytes, size);
}
int FileCalls::fsync(int descriptor) { return ::fsync(descriptor); }
int FileCalls::close(int descriptor) { return ::close(descriptor); }
int FileCalls::rename(const char* from, const char* to) { return std::rename(from, to); }
int FileCalls::link(const char* from, const char* to) { return ::link(from, to); }
int FileCalls::unlink(const char* path) { return ::unlink(path); }

std::filesystem::path generation_of(const std::filesystem::path& file, int generation) {
  return generation == 0 ? file
                         : std::filesystem::path(file.string() + "." + std::to_string(generation));
}

core::Result<core::Done> write_whole(const std::filesystem::path& file, const std::string& text,
                                     int generations, FileCalls& calls) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  const std::filesystem::path fresh = file.string() + ".new";
  if (!write_fresh(fresh, text, calls)) return trouble(fresh);
  shift(file, generations, calls);
  if (calls.rename(fresh.c_str(), file.c_str()) != 0) return trouble(file);
  // Without this the rename itself may be lost in a power cut.
  const int folder = calls.open(file.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC, 0);
  if (folder < 0) return trouble(file.parent_path());
  const bool kept = calls.fsync(folder) == 0;
  const int why = errno;
  calls.close(folder);
  errno = why;
  if (!kept) return trouble(file.parent_path());
  return core::Done{};
}

core::Result<core::Done> write_whole(const std::filesystem::path& file, const std::string& text,
                                     int generations) {
  FileCalls calls;
  return write_whole(file, text, generations, calls);
}

}  // namespace chiaro::daemon
