// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/reading/tree.h"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "controller/studio/reading/text.h"

namespace chiaro::studio::reading {
namespace {

/// Leaves yaml-cpp's parser in the middle; never leaves this file.
struct Refusal {
  core::Problem problem;
};

/// Builds the tree from yaml-cpp's events rather than from its own nodes, so that the bounds hold
/// before memory is spent: an alias bomb of one kilobyte unfolds to gigabytes there.
class Builder : public YAML::EventHandler {
 public:
  explicit Builder(std::string file) : file_(std::move(file)) {}

  std::optional<Tree> root;
  core::Problems problems;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    leaf(node(Tree::Kind::nothing, mark), anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    Tree scalar = node(Tree::Kind::scalar, mark);
    scalar.text = value;
    scalar.quoted = tag == "!";
    leaf(std::move(scalar), anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto named = anchors_.find(anchor);
    if (named == anchors_.end())
      refuse(mark, "this alias stands inside the very part it repeats", "write the part out");
    nodes_ += named->second.nodes;
    check_size(mark);
    Tree copy = named->second.tree;
    if (!open_.empty()) copy.label = label_here(open_.back());
    copy.line = mark.line + 1;
    copy.column = mark.column + 1;
    place(std::move(copy));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(node(Tree::Kind::sequence, mark), anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(node(Tree::Kind::mapping, mark), anchor);
  }
  void OnMapEnd() override {
    find_duplicates(open_.back().tree);
    close();
  }

 private:
  struct Open {
    Tree tree;
    YAML::anchor_t anchor = 0;
    std::size_t nodes_before = 0;
    bool expects_value = false;  ///< mapping: a key has come, its value not yet
  };
  struct Anchored {
    Tree tree;
    std::size_t nodes = 0;
  };

  [[noreturn]] void refuse(const YAML::Mark& mark, std::string what, std::string remedy) const {
    throw Refusal{{{file_, mark.line + 1, mark.column + 1}, std::move(what), std::move(remedy)}};
  }
  void check_size(const YAML::Mark& mark) const {
    if (nodes_ > kMostNodes)
      refuse(mark, "the file holds more than " + std::to_string(kMostNodes) + " values",
             "a studio is far smaller: is this the right file?");
  }
  static std::string label_here(const Open& parent) {
    if (parent.tree.kind == Tree::Kind::sequence) return parent.tree.label;
    return parent.expects_value ? parent.tree.keys.back().text : "";
  }
  Tree node(Tree::Kind kind, const YAML::Mark& mark) {
    ++nodes_;
    check_size(mark);
    Tree tree;
    tree.kind = kind;
    if (!open_.empty()) tree.label = label_here(open_.back());
    tree.line = mark.line + 1;
    tree.column = mark.column + 1;
    return tree;
  }
  void leaf(Tree tree, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) anchors_[anchor] = {tree, 1};
    place(std::move(tree));
  }
  void open(Tree tree, YAML::anchor_t anchor) {
    if (open_.size() >= kMostDepth)
      throw Refusal{{{file_, tree.line, tree.column},
                     "lists and sections stand more than " + std::to_string(kMostDepth) +
                         " deep in one another",
                     "a studio file needs six: look for a bracket that is never closed"}};
    open_.push_back({std::move(tree), anchor, nodes_, false});
  }
  void close() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    if (closed.anchor != YAML::NullAnchor)
      anchors_[closed.anchor] = {closed.tree, nodes_ - closed.nodes_before + 1};
    place(std::move(closed.tree));
  }
  void place(Tree tree) {
    if (open_.empty()) {
      root = std::move(tree);
      return;
    }
    Open& parent = open_.back();
    if (parent.tree.kind == Tree::Kind::mapping && !parent.expects_value) {
      if (tree.kind != Tree::Kind::scalar)
        throw Refusal{{{file_, tree.line, tree.column},
                       "a key must be one word, not a list or a section",
                       "look for a stray '?', '[' or '{' here"}};
      parent.tree.keys.push_back({std::move(tree.text), tree.line, tree.column});
      parent.expects_value = true;
      return;
    }
    parent.expects_value = false;
    tree.label =
        parent.tree.kind == Tree::Kind::mapping ? parent.tree.keys.back().text : parent.tree.label;
    parent.tree.items.push_back(std::move(tree));
  }
  void find_duplicates(const Tree& mapping) {
    std::map<std::string_view, int> first_line;
    for (const Tree::Key& key : mapping.keys) {
      const auto [entry, fresh] = first_line.emplace(key.text, key.line);
      if (!fresh)
        problems.push_back({{file_, key.line, key.column},
                            in_quotes(key.text) + " stands here twice (first in line " +
                                std::to_string(entry->second) + ")",
                            "give one of them another name, or delete it"});
    }
  }

  std::string file_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Anchored> anchors_;
  std::size_t nodes_ = 0;
};

core::Problem whole_file(const std::string& file, std::string what, std::string remedy) {
  return {{file, 0, 0}, std::move(what), std::move(remedy)};
}

std::optional<core::Problem> not_text(const std::string& yaml, const std::string& file) {
  if (yaml.size() > kMostBytes)
    return whole_file(file,
                      "the file has " + std::to_string(yaml.size() >> 20u) + " MiB, at most " +
                          std::to_string(kMostBytes >> 20u) + " are read",
                      "a studio is far smaller: is this the right file?");
  if (std::all_of(yaml.begin(), yaml.end(),
                  [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }))
    return whole_file(file, "the file is empty", "`chiaro new` writes a first one");
  if (const auto bad = first_byte_not_text(yaml)) {
    const auto line =
        1 + std::count(yaml.begin(), yaml.begin() + static_cast<std::ptrdiff_t>(*bad), '\n');
    return core::Problem{{file, static_cast<int>(line), 0},
                         "this is not text (byte " + std::to_string(*bad + 1) + " of the file)",
                         "is this the right file? Save it as UTF-8 text"};
  }
  return std::nullopt;
}

}  // namespace

core::Result<Document> parse_tree(const std::string& yaml, const std::string& file) try {
  if (const auto problem = not_text(yaml, file)) return *problem;
  std::istringstream stream(yaml);
  YAML::Parser parser(stream);
  Builder builder(file);
  if (!parser.HandleNextDocument(builder) || !builder.root)
    return whole_file(file, "the file holds nothing but comments",
                      "`chiaro new` writes a first one");
  if (parser)
    return whole_file(file, "the file holds a second document after '---' or '...'",
                      "keep one studio in one file");
  return Document{std::move(*builder.root), std::move(builder.problems)};
} catch (const Refusal& refusal) {
  return refusal.problem;
} catch (const YAML::Exception& error) {
  return core::Problem{{file, error.mark.line + 1, error.mark.column + 1},
                       "this is not valid YAML: " + error.msg,
                       "look at this line and the one above for a missing space after ':', a tab, "
                       "an open quote or bracket, or a wrong indent"};
} catch (const std::exception& error) {
  return whole_file(file, std::string("this cannot be read as YAML: ") + error.what(),
                    "is this the right file?");
}

}  // namespace chiaro::studio::reading
