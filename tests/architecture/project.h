// SPDX-License-Identifier: Apache-2.0
// The project's own files, as the architecture tests walk them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace chiaro::architecture {

/// A text file of ours. `path` is relative to the project's root, with forward slashes.
struct File {
  std::string path;
  std::vector<std::string> lines;
  std::string extension() const { return std::filesystem::path(path).extension().string(); }
  std::string name() const { return std::filesystem::path(path).filename().string(); }
};

std::filesystem::path root();
/// Every text file of the project in path order; what is built or fetched is not ours.
const std::vector<File>& files();
/// C++ sources and headers among them.
bool is_cpp(const File& file);
bool starts_with(const std::string& text, const std::string& start);

}  // namespace chiaro::architecture
