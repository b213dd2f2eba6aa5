// SPDX-License-Identifier: Apache-2.0
// subject: or subjects: - what is lit. A mesh, or the shipped bust standing in for any sitter.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

constexpr const char* kBust = "subjects/bust.ply";

/// front: -y, or [0, -1, 0].
std::optional<core::Vec3> read_front(const Tree* tree, Report& report) {
  if (tree == nullptr || tree->kind != Tree::Kind::scalar) return direction(tree, report);
  return choice<core::Vec3>(tree,
                            {{"x", {1, 0, 0}},
                             {"-x", {-1, 0, 0}},
                             {"y", {0, 1, 0}},
                             {"-y", {0, -1, 0}},
                             {"z", {0, 0, 1}},
                             {"-z", {0, 0, -1}}},
                            report);
}

void read_stand_in(const Tree& stand_in, Section& section, Subject& subject, Context& context) {
  Report& report = context.report;
  if (!choice<bool>(&stand_in, {{"person", true}}, report)) return;
  subject.stand_in = true;
  into(subject.eye_height,
       quantity(section.need("eye_height", "1.55 m"), Measure::length, {0.3, 3}, report));
  subject.mesh = existing_file(stand_in, kBust, "shipped stand-in", context);
  for (const char* key : {"mesh", "height", "up", "front"})
    if (const Tree* extra = section.find(key))
      report.error(*extra, in_quotes(key) + " does not go with a stand-in",
                   "the shipped bust is used, placed by its eye_height");
}

void read_mesh(Section& section, Subject& subject, Context& context) {
  Report& report = context.report;
  subject.mesh = existing_file(section.need("mesh", "subjects/bust.ply"), "mesh", context);
  if (const auto height = quantity(section.find("height"), Measure::length, {0.01, 100}, report))
    subject.height = *height;
  into(subject.up,
       choice<UpAxis>(section.find("up"), {{"y", UpAxis::y}, {"z", UpAxis::z}}, report));
  into(subject.front, read_front(section.find("front"), report));
  if (const Tree* eyes = section.find("eye_height"))
    report.error(*eyes, "'eye_height' is for a stand-in",
                 "give the mesh a height, or stand_in: person");
}

Subject read_subject(const Tree& tree, std::string name, Context& context) {
  Report& report = context.report;
  Section section(tree, "a subject", report);
  Subject subject;
  subject.name = std::move(name);
  subject.place = report.place(tree);
  into(subject.name, text(section.find("name"), report));
  if (const Tree* stand_in = section.find("stand_in"))
    read_stand_in(*stand_in, section, subject, context);
  else
    read_mesh(section, subject, context);
  into(subject.at, point(section.find("at"), report));
  into(subject.facing,
       quantity(section.find("facing"), Measure::angle, {-2 * core::kPi, 2 * core::kPi}, report));
  into(subject.aim, point(section.find("aim"), report));
  if (const Tree* material = section.find("material")) {
    Section body(*material, "a material", report);
    subject.material = read_material(body, Material{}, context);
    body.refuse_unknown();
  }
  section.refuse_unknown();
  return subject;
}

void refuse_same_names(const Studio& studio, Context& context) {
  for (std::size_t i = 0; i < studio.subjects.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (studio.subjects[i].name == studio.subjects[k].name)
        context.report.add({studio.subjects[i].place,
                            "two subjects are called " + in_quotes(studio.subjects[i].name),
                            "give one of them another name", false});
}

}  // namespace

void read_subjects(Section& top, Context& context, Studio& studio) {
  const Tree* one = top.find("subject");
  const Tree* several = top.find("subjects");
  if (one == nullptr && several == nullptr) {
    if (top.valid())
      context.report.error(top.tree(), "the studio has no subject",
                           "add subject: {stand_in: person, eye_height: 1.55 m}");
    return;
  }
  if (one != nullptr && several != nullptr)
    context.report.error(*several, "'subject' and 'subjects' stand side by side",
                         "list them all under 'subjects'");
  if (one != nullptr) studio.subjects.push_back(read_subject(*one, "subject", context));
  if (several == nullptr) return;
  if (several->items.empty())
    context.report.error(*several, "'subjects' lists nobody", "- {mesh: subjects/bust.ply}");
  for (std::size_t i = 0; i < several->items.size(); ++i) {
    const bool named = several->kind == Tree::Kind::mapping;
    if (named) check_name(several->keys[i], context);
    std::string name = named ? several->keys[i].text : "subject " + std::to_string(i + 1);
    studio.subjects.push_back(read_subject(several->items[i], std::move(name), context));
  }
  refuse_same_names(studio, context);
}

}  // namespace chiaro::studio::sections
