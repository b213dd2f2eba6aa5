// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/study/tags.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <tuple>

namespace chiaro::daemon::study {
namespace {

namespace fs = std::filesystem;

bool starts_with(const std::string& text, const std::string& with) {
  return text.rfind(with, 0) == 0;
}

bool is_test_file(const std::string& file) {
  return starts_with(file, "tests/") && file.find("_test.cpp") != std::string::npos;
}

/// "Suite.Name" when the line opens a test.
std::string test_opened_by(const std::string& line) {
  static const std::regex kTest(R"(^TEST(?:_[FP])?\((\w+), *(\w+)\))");
  std::smatch match;
  return std::regex_search(line, match, kTest) ? match[1].str() + "." + match[2].str() : "";
}

/// These files' tags are examples.
bool talks_of_tags(const std::string& name) {
  return name == "tags.h" || name == "tags.cpp" || name == "study_test.cpp";
}

}  // namespace

std::vector<int> items_in(const std::string& line) {
  static const std::regex kTag(R"(\[(I-\d[^\]]*)\])"), kPart(R"(I-(\d+)(?:\.\.I-(\d+))?)");
  std::vector<int> items;
  for (std::sregex_iterator tag(line.begin(), line.end(), kTag), end; tag != end; ++tag) {
    const std::string inside = (*tag)[1].str();
    for (std::sregex_iterator part(inside.begin(), inside.end(), kPart); part != end; ++part) {
      const int from = std::stoi((*part)[1].str());
      const int to = (*part)[2].matched ? std::stoi((*part)[2].str()) : from;
      for (int i = from; i <= to && i <= kThesisItems; ++i) items.push_back(i);
    }
  }
  return items;
}

std::vector<Tag> tags_in(const std::string& file, const std::string& text) {
  std::vector<Tag> tags, waiting;
  std::string test;  // the one whose body we are in
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (const std::string opened = test_opened_by(line); !opened.empty()) {
      test = opened;
      for (Tag& tag : waiting) tags.push_back({tag.item, file, test});
      waiting.clear();
    }
    for (const int item : items_in(line))
      (is_test_file(file) && test.empty() ? waiting : tags).push_back({item, file, test});
    if (starts_with(line, "}")) test.clear();
  }
  return tags;
}

std::vector<Tag> tags_below(const fs::path& root) {
  std::vector<Tag> tags;
  for (const char* folder : {"controller", "simulator", "drivers", "calibration", "tests"}) {
    if (!fs::is_directory(root / folder)) continue;
    fs::recursive_directory_iterator walk(root / folder);
    for (auto at = fs::begin(walk); at != fs::end(walk); ++at) {
      if (at->path().filename() == "node_modules") at.disable_recursion_pending();
      const std::string extension = at->path().extension().string();
      if (extension != ".h" && extension != ".cpp" && extension != ".def") continue;
      if (talks_of_tags(at->path().filename().string())) continue;
      std::ifstream in(at->path());
      std::stringstream text;
      text << in.rdbuf();
      const auto found = tags_in(at->path().lexically_relative(root).generic_string(), text.str());
      tags.insert(tags.end(), found.begin(), found.end());
    }
  }
  const auto key = [](const Tag& t) { return std::tie(t.item, t.file, t.test); };
  std::sort(tags.begin(), tags.end(), [&](const Tag& a, const Tag& b) { return key(a) < key(b); });
  tags.erase(std::unique(tags.begin(), tags.end(),
                         [&](const Tag& a, const Tag& b) { return key(a) == key(b); }),
             tags.end());
  return tags;
}

}  // namespace chiaro::daemon::study
