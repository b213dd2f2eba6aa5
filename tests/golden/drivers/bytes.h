// SPDX-License-Identifier: Apache-2.0
// Bytes as standards print them.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace chiaro::golden {

inline std::vector<int> bytes_of(const std::string& hexadecimal) {
  std::istringstream in(hexadecimal);
  std::vector<int> bytes;
  for (std::string word; in >> word;) bytes.push_back(std::stoi(word, nullptr, 16));
  return bytes;
}

template <class Bytes>
std::vector<int> numbers(const Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

}  // namespace chiaro::golden
