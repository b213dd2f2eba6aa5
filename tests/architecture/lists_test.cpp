// SPDX-License-Identifier: Apache-2.0
// Every "one file pair per …" folder has an explicit list; here list and folder are compared, so
// that neither can be forgotten.
#include <algorithm>
#include <cctype>
#include <gtest/gtest.h>
#include <regex>
#include <set>

#include "tests/architecture/project.h"

namespace chiaro::architecture {
namespace {

namespace fs = std::filesystem;

/// Lists of values, not of files.
const std::set<std::string> kValueLists{
    "controller/core/dofs.def", "controller/design/impressions.def",
    "controller/design/vocabulary.def", "controller/panel/routes.def",
    "tests/architecture/include_table.def"};

struct Entry {
  std::string kind, name;
};

/// The entries of a list: KIND(name, …) at the start of a line.
std::vector<Entry> entries(const File& list) {
  static const std::regex kEntry(R"(^([A-Z_]+)\(\s*([a-z0-9_]+)\s*[,)])");
  std::vector<Entry> found;
  for (const auto& line : list.lines)
    if (std::smatch match; std::regex_search(line, match, kEntry))
      found.push_back({match[1].str(), match[2].str()});
  return found;
}

std::vector<File> lists() {
  std::vector<File> found;
  for (const auto& file : files())
    if (file.extension() == ".def" && kValueLists.count(file.path) == 0) found.push_back(file);
  return found;
}

/// The folder that a list names: beside it or around it, called as the list is.
fs::path folder_of(const File& list) {
  const auto path = root() / list.path;
  if (path.parent_path().filename() == path.stem()) return path.parent_path();
  return fs::path(path).replace_extension();
}

/// What the folder's entries are called. What they share is named after one of them in general:
/// terms/term.cpp, lights/light_model.cpp.
std::set<std::string> entries_in(const fs::path& folder) {
  auto shared = folder.filename().string();
  shared.pop_back();
  std::set<std::string> names;
  for (const auto& at : fs::directory_iterator(folder)) {
    const auto stem = at.path().stem().string();
    if (at.path().extension() == ".cpp" && stem != shared && !starts_with(stem, shared + "_"))
      names.insert(stem);
  }
  return names;
}

std::set<std::string> drivers_on_disk() {
  std::set<std::string> names;
  for (const auto& kind : fs::directory_iterator(root() / "drivers"))
    if (kind.is_directory() && kind.path().filename() != "common")
      for (const auto& driver : fs::directory_iterator(kind.path()))
        if (driver.is_directory())
          names.insert(kind.path().filename().string() + "/" + driver.path().filename().string());
  return names;
}

TEST(Lists, EveryListHoldsEntriesAndNoneTwice) {
  for (const auto& list : lists()) {
    std::set<std::string> names;
    const auto found = entries(list);
    EXPECT_FALSE(found.empty()) << list.path;
    for (const auto& entry : found)
      EXPECT_TRUE(names.insert(entry.kind + " " + entry.name).second)
          << list.path << ": " << entry.name << " stands twice";
  }
}

TEST(Lists, EqualTheirFolders) {
  for (const auto& list : lists()) {
    if (list.path == "drivers/drivers.def") continue;  // folders, not files: the next test
    const auto folder = folder_of(list);
    ASSERT_TRUE(fs::is_directory(folder)) << list.path << " needs the folder " << folder;
    std::set<std::string> listed;
    for (const auto& entry : entries(list)) listed.insert(entry.name);
    EXPECT_EQ(listed, entries_in(folder)) << list.path;
  }
}

/// A contract test names the list that it runs over: in its opening or in an #include.
bool names(const File& test, const std::string& list) {
  return std::any_of(test.lines.begin(), test.lines.end(),
                     [&](const std::string& line) { return line.find(list) != std::string::npos; });
}

TEST(Lists, EveryOneHasContractTestsOverItsLines) {
  for (const auto& list : lists()) {
    bool read = false;
    for (const auto& file : files())
      read = read || (starts_with(file.path, "tests/contract/") && names(file, list.name()));
    EXPECT_TRUE(read) << list.path;
  }
}

TEST(Lists, EveryDriverFolderHasItsLine) {
  std::set<std::string> listed;
  for (const auto& list : lists())
    if (list.path == "drivers/drivers.def")
      for (auto entry : entries(list)) {
        std::transform(entry.kind.begin(), entry.kind.end(), entry.kind.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        listed.insert(entry.kind + "/" + entry.name);
      }
  EXPECT_EQ(listed, drivers_on_disk());
}

}  // namespace
}  // namespace chiaro::architecture
