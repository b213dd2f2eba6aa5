// SPDX-License-Identifier: Apache-2.0
// Where readers put what is wrong, so that one reading finds every problem.
#pragma once

#include <string>
#include <utility>

#include "controller/core/result.h"
#include "controller/studio/reading/tree.h"

namespace chiaro::studio::reading {

class Report {
 public:
  explicit Report(std::string file) : file_(std::move(file)) {}

  core::Place place(const Tree& tree) const { return {file_, tree.line, tree.column}; }
  core::Place place(const Tree::Key& key) const { return {file_, key.line, key.column}; }
  /// `where` is a Tree or one of its keys.
  template <class Where>
  void error(const Where& where, std::string what, std::string remedy) {
    add({place(where), std::move(what), std::move(remedy), false});
  }
  void add(core::Problem problem);
  void add(const core::Problems& problems);

  const std::string& file() const { return file_; }
  /// In the order of the file.
  core::Problems sorted() const;
  bool any_error() const { return core::any_error(problems_); }

 private:
  std::string file_;
  core::Problems problems_;
};

}  // namespace chiaro::studio::reading
