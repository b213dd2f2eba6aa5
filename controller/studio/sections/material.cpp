// SPDX-License-Identifier: Apache-2.0
// How a surface answers light: diffuse albedo, Blinn-Phong specular weight and shininess.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

Material read_material(Section& section, const Material& otherwise, Context& context) {
  Material material = otherwise;
  Report& report = context.report;
  into(material.diffuse, albedo(section.find("diffuse"), report));
  into(material.specular, number(section.find("specular"), {0, 1}, report));
  into(material.shininess, number(section.find("shininess"), {1, 2000}, report));
  return material;
}

}  // namespace chiaro::studio::sections
