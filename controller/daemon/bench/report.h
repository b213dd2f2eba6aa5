// SPDX-License-Identifier: Apache-2.0
// What `chiaro bench` found: figures under headings, each with its unit, its bar where the design
// sets one, and what it means.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace chiaro::daemon::bench {

/// What the design asks for; nothing where it asks for nothing.
struct Bar {
  std::optional<double> most, least;
};
inline Bar at_most(double value) { return {value, {}}; }
inline Bar at_least(double value) { return {{}, value}; }

struct Figure {
  std::string heading, name;
  double value = 0;
  std::string unit;
  Bar bar;
  std::string note;
};

class Report {
 public:
  void heading(const std::string& text) { heading_ = text; }
  void add(std::string name, double value, std::string unit, Bar bar = {}, std::string note = "");
  std::string to_text() const;
  std::string to_json(const std::string& studio, bool quick) const;

 private:
  std::string heading_;
  std::vector<Figure> figures_;
};

}  // namespace chiaro::daemon::bench
