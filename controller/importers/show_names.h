// SPDX-License-Identifier: Apache-2.0
// Names that a studio file takes: letters, digits, space, '-', '_' and '.', each once.
#pragma once

#include <cctype>
#include <set>
#include <string>

namespace chiaro::importers {

class ShowNames {
 public:
  /// `wish` without what names may not have; with a number behind it where it is taken.
  std::string fresh(const std::string& wish) {
    std::string name;
    for (const char c : wish.substr(0, 60)) {
      const auto u = static_cast<unsigned char>(c);
      const bool plain =
          u < 128 && (std::isalnum(u) != 0 || c == ' ' || c == '-' || c == '_' || c == '.');
      name += plain ? c : '-';
    }
    while (!name.empty() && std::isalnum(static_cast<unsigned char>(name.front())) == 0)
      name.erase(0, 1);
    while (!name.empty() && name.back() == ' ') name.pop_back();
    if (name.empty()) name = "lamp";
    std::string each = name;
    for (int i = 2; !taken_.insert(each).second; ++i) each = name + " " + std::to_string(i);
    return each;
  }

 private:
  std::set<std::string> taken_;
};

}  // namespace chiaro::importers
