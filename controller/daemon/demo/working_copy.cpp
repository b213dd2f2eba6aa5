// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/demo/working_copy.h"

#include <fstream>
#include <iterator>

namespace chiaro::daemon {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

core::Result<fs::path> working_copy(const fs::path& shipped, const fs::path& folder) {
  const fs::path copy = folder / shipped.filename();
  // Beside the copy, untouched: tells a copy with additions from one of an older release.
  const fs::path origin = folder / "as-shipped" / shipped.filename();
  std::error_code code;
  if (fs::exists(copy, code) && fs::exists(origin, code) && read(origin) == read(shipped))
    return copy;
  fs::create_directories(origin.parent_path(), code);
  for (const fs::path& to : {copy, origin}) {
    fs::copy_file(shipped, to, fs::copy_options::overwrite_existing, code);
    if (code)
      return core::Problem{
          {to, 0, 0},
          "the demo's copy of the studio file cannot be written: " + code.message(),
          "give this user the right to write there, or set CHIARO_STATE to a "
          "folder that can be written"};
    // Installed files are often read-only; the copy is there to be written.
    fs::permissions(to, fs::perms::owner_write, fs::perm_options::add, code);
  }
  return copy;
}

}  // namespace chiaro::daemon
