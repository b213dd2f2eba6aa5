// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/reading/section.h"

#include <algorithm>

#include "controller/studio/reading/text.h"

namespace chiaro::studio::reading {

Section::Section(const Tree& tree, std::string what, Report& report)
    : tree_(tree), what_(std::move(what)), report_(report) {
  if (valid()) return;
  report_.error(tree, "expected a section with the settings of " + what_,
                "write 'name: value' lines, indented, or {name: value, …}");
}

const Tree* Section::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  for (std::size_t i = 0; i < tree_.keys.size(); ++i)
    if (tree_.keys[i].text == key) return &tree_.items[i];
  return nullptr;
}

const Tree* Section::need(std::string_view key, std::string_view example) {
  const Tree* found = find(key);
  if (found == nullptr && valid())
    report_.error(tree_, what_ + " has no " + in_quotes(key),
                  "add " + std::string(key) + ": " + std::string(example));
  return found;
}

void Section::refuse_unknown() const {
  for (const Tree::Key& key : tree_.keys)
    if (std::find(known_.begin(), known_.end(), key.text) == known_.end())
      report_.error(key, what_ + " has no setting " + in_quotes(key.text),
                    suggestion(key.text, known_));
}

std::optional<Variant> variant(const Tree* tree, const std::string& what,
                               const std::vector<std::string>& names, Report& report) {
  if (tree == nullptr) return std::nullopt;
  const auto index_of = [&](const std::string& word) -> std::optional<std::size_t> {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
  };
  if (tree->kind == Tree::Kind::scalar) {
    if (const auto index = index_of(std::string(trimmed(tree->text))))
      return Variant{*index, nullptr};
    report.error(*tree, in_quotes(tree->text) + " is not " + what, suggestion(tree->text, names));
    return std::nullopt;
  }
  if (tree->kind != Tree::Kind::mapping || tree->keys.empty()) {
    report.error(*tree, "expected " + what, "write one of " + any_of(names));
    return std::nullopt;
  }
  if (const auto index = index_of(tree->keys[0].text); !index) {
    report.error(tree->keys[0], in_quotes(tree->keys[0].text) + " is not " + what,
                 suggestion(tree->keys[0].text, names));
    return std::nullopt;
  } else if (tree->keys.size() == 1) {
    return Variant{*index, &tree->items[0]};
  }
  report.error(tree->keys[1], "expected only one kind of " + what.substr(what.find(' ') + 1),
               "keep " + in_quotes(tree->keys[0].text) + " or " + in_quotes(tree->keys[1].text) +
                   ", not both; close the bracket before the next setting");
  return std::nullopt;
}

}  // namespace chiaro::studio::reading
