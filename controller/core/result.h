// SPDX-License-Identifier: Apache-2.0
// How a stage answers when its input can be wrong: a value, or every problem found, each with its
// place and its remedy. Exceptions are not used across stages.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace chiaro::core {

/// Where in a user's file (1-based line and column; 0 = the file as a whole). Printed as
/// `file:line:column`.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
  friend bool operator==(const Place&, const Place&) = default;
};
std::string to_string(const Place& place);

/// One thing that is wrong: where, what (with what was expected), and what the person can do.
struct Problem {
  Place where;
  std::string what;
  std::string remedy;
  bool warning = false;  ///< warnings are printed but do not refuse the input
};
using Problems = std::vector<Problem>;

/// `file:line:column: what (remedy)`, one line.
std::string to_string(const Problem& problem);
/// One problem per line, in the order found.
std::string to_string(const Problems& problems);
bool any_error(const Problems& problems);

/// A value or at least one problem.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}                      // NOLINT: implicit by intent
  Result(Problems problems) : state_(std::move(problems)) {}         // NOLINT
  Result(Problem problem) : state_(Problems{std::move(problem)}) {}  // NOLINT

  explicit operator bool() const { return state_.index() == 0; }
  bool ok() const { return state_.index() == 0; }
  /// Precondition: ok(). Throws std::logic_error otherwise: that is our bug, not the user's.
  const T& value() const& { return const_cast<Result*>(this)->checked(); }
  T& value() & { return checked(); }
  T&& value() && { return std::move(checked()); }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T&& operator*() && { return std::move(checked()); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &checked(); }
  /// Empty when ok().
  const Problems& problems() const {
    static const Problems kNone;
    return ok() ? kNone : std::get<1>(state_);
  }

 private:
  T& checked() {
    if (!ok()) throw std::logic_error("Result read without a value: " + to_string(problems()));
    return std::get<0>(state_);
  }
  std::variant<T, Problems> state_;
};

/// For operations that give nothing but success.
struct Done {};

/// The known name nearest to `word` by edit distance, or "" when none is near enough to suggest.
std::string nearest_name(const std::string& word, const std::vector<std::string>& known);

}  // namespace chiaro::core
