// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/file_lock.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace chiaro::daemon {
namespace {

std::string owner_of(int descriptor) {
  std::array<char, 32> text{};
  const auto got = ::pread(descriptor, text.data(), text.size() - 1, 0);
  return got > 0 ? " (process " + std::string(text.data()) + ")" : "";
}

}  // namespace

core::Result<std::unique_ptr<FileLock>> FileLock::take(const std::filesystem::path& file,
                                                       const std::string& what) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0640);
  if (descriptor < 0)
    return core::Problem{{file.string()},
                         std::string("cannot open the lock: ") + std::strerror(errno),
                         "CHIARO_RUNTIME names the folder to use"};
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    const std::string owner = owner_of(descriptor);
    ::close(descriptor);
    return core::Problem{{file.string()},
                         "another " + what + " is running" + owner,
                         "stop it first, or set CHIARO_RUNTIME to another folder"};
  }
  const std::string owner = std::to_string(::getpid());
  if (::ftruncate(descriptor, 0) != 0 || ::pwrite(descriptor, owner.data(), owner.size(), 0) < 0) {
    // The number is a courtesy to people; the lock holds without it.
  }
  return std::unique_ptr<FileLock>(new FileLock(descriptor));
}

FileLock::~FileLock() { ::close(descriptor_); }

core::Result<core::Done> make_runtime_folder(const std::filesystem::path& folder) {
  std::error_code code;
  using std::filesystem::perms;
  if (std::filesystem::create_directories(folder, code))
    std::filesystem::permissions(folder, perms::owner_all | perms::group_read | perms::group_exec,
                                 code);
  if (code && !std::filesystem::is_directory(folder))
    return core::Problem{{folder.string()},
                         "cannot make the folder: " + code.message(),
                         "CHIARO_RUNTIME names another"};
  return core::Done{};
}

}  // namespace chiaro::daemon
