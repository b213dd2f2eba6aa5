// SPDX-License-Identifier: Apache-2.0
// modifiers: [bare, {softbox: [0.6, 0.9], loss: 1.3 stops}] - the first is fitted now.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

Modifier read_modifier(const Tree& tree, Report& report) {
  if (tree.kind == Tree::Kind::scalar) {
    choice<bool>(&tree, {{"bare", true}}, report);
    return {"bare", 0, 0, 0};
  }
  Section section(tree, "a modifier", report);
  Modifier modifier;
  int kinds = 0;
  for (const char* kind : {"softbox", "umbrella", "diffuser"})
    if (const Tree* size = section.find(kind)) {
      ++kinds;
      modifier.name = kind;
      if (const auto v = numbers(size, 2, {0.02, 10}, "[width, height] in metres", report)) {
        modifier.width = (*v)[0];
        modifier.height = (*v)[1];
      }
    }
  if (section.valid() && kinds != 1)
    report.error(tree, "expected one modifier here",
                 "bare, or {softbox: [0.6, 0.9], loss: 1.3 stops}; umbrella and diffuser likewise");
  into(modifier.loss_stops,
       quantity(section.need("loss", "1.3 stops"), Measure::stops, {0, 12}, report));
  section.refuse_unknown();
  return modifier;
}

}  // namespace

std::vector<Modifier> read_modifiers(const Tree* tree, Context& context) {
  std::vector<Modifier> modifiers;
  if (tree == nullptr) return modifiers;
  if (tree->kind != Tree::Kind::sequence) {
    context.report.error(*tree, "'modifiers' needs a list, the fitted one first",
                         "[bare, {softbox: [0.6, 0.9], loss: 1.3 stops}]");
    return modifiers;
  }
  for (const Tree& item : tree->items) modifiers.push_back(read_modifier(item, context.report));
  return modifiers;
}

}  // namespace chiaro::studio::sections
