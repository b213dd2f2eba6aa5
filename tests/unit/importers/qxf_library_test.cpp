// SPDX-License-Identifier: Apache-2.0
// Every definition of Debian's `qlcplus-data`: it loads, or is refused with a reason.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>

#include "controller/importers/qxf.h"
#include "controller/studio/profiles/profiles.h"

namespace chiaro::importers {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> library() {
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::recursive_directory_iterator entry("/usr/share/qlcplus/fixtures", code), end;
       !code && entry != end; entry.increment(code))
    if (entry->path().extension() == ".qxf") files.push_back(entry->path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool has(const studio::Mode& mode, core::Dof dof) {
  return std::any_of(mode.channels.begin(), mode.channels.end(),
                     [&](const studio::Channel& c) { return c.dof == dof; });
}

TEST(QxfLibrary, NineteenOfTwentyAreUsableAndTheRestSayWhyNot) {
  const auto files = library();
  ASSERT_GE(files.size(), 1300u) << "install the Debian package qlcplus-data";
  std::size_t usable = 0, modes = 0, heads = 0;
  std::map<std::string, int> reasons;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    const auto read = read_qxf(text_of(file), file.string());
    ASSERT_TRUE(read.ok()) << core::to_string(read.problems());
    const auto made = profile_of(*read, file.string());
    if (!made.ok()) {
      ASSERT_FALSE(made.problems().empty());
      EXPECT_FALSE(made.problems().front().what.empty());
      ++reasons[made.problems().front().what];
      continue;
    }
    ++usable;
    modes += made->profile.modes.size();
    for (const studio::Mode& mode : made->profile.modes) {
      bool serves = has(mode, core::Dof::intensity) || has(mode, core::Dof::pan) ||
                    has(mode, core::Dof::tilt);
      for (const core::DofInfo& dof : core::dofs())
        serves = serves || (core::is_colour(dof.dof) && has(mode, dof.dof));
      EXPECT_TRUE(serves) << mode.name;
      if (has(mode, core::Dof::pan) && has(mode, core::Dof::tilt)) ++heads;
    }
    // What is written is what was made.
    const auto again = studio::profiles::parse_profile(profile_yaml(made->profile, "a test"),
                                                       made->profile.name, "again.yaml");
    ASSERT_TRUE(again.ok()) << core::to_string(again.problems());
    EXPECT_EQ(profile_yaml(*again, ""), profile_yaml(made->profile, ""));
  }
  for (const auto& [reason, count] : reasons) std::cout << count << " refused: " << reason << "\n";
  std::cout << usable << " of " << files.size() << " usable, " << modes << " modes, " << heads
            << " with a head\n";
  EXPECT_GE(static_cast<double>(usable), 0.95 * static_cast<double>(files.size()));
  EXPECT_GE(heads, 1000u);
}

}  // namespace
}  // namespace chiaro::importers
