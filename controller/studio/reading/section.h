// SPDX-License-Identifier: Apache-2.0
// A mapping of the file while it is read: remembers which keys were asked for, so that what nobody
// reads is refused with the nearest name that would have been.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "controller/studio/reading/report.h"
#include "controller/studio/reading/tree.h"

namespace chiaro::studio::reading {

class Section {
 public:
  /// `what` names it in messages ("a camera"). A node that is no mapping is reported, and every
  /// key of it then counts as absent without further complaint. Borrows both for its life.
  Section(const Tree& tree, std::string what, Report& report);

  /// Null when absent. Asking makes the key known.
  const Tree* find(std::string_view key);
  /// The same, but absence is an error; `example` shows the person what to write.
  const Tree* need(std::string_view key, std::string_view example);
  bool has(std::string_view key) { return find(key) != nullptr; }
  /// To be called when every key has been asked for.
  void refuse_unknown() const;
  bool valid() const { return tree_.kind == Tree::Kind::mapping; }
  const Tree& tree() const { return tree_; }

 private:
  const Tree& tree_;
  std::string what_;
  Report& report_;
  std::vector<std::string> known_;
};

/// One of several shapes: `{stand: {…}}`, or the bare word `bare`.
struct Variant {
  std::size_t index = 0;       ///< into the names given
  const Tree* body = nullptr;  ///< null when the bare word stood there
};
/// Exactly one key of `names`, or a bare word among `bare_words`, else a report.
std::optional<Variant> variant(const Tree* tree, const std::string& what,
                               const std::vector<std::string>& names, Report& report);

}  // namespace chiaro::studio::reading
