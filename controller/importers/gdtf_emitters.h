// SPDX-License-Identifier: Apache-2.0
// The emitters of a GDTF file: their colour from a spectrum, CIE xyY or a wavelength, and how much
// of the lamp's light each gives.
#pragma once

#include <map>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "controller/importers/library_fixture.h"

namespace chiaro::importers {

class GdtfEmitters {
 public:
  explicit GdtfEmitters(pugi::xml_node collection) : collection_(collection) {}
  /// A channel of that meaning drives the emitter of that name (empty = the file does not say).
  void note(Meaning meaning, const std::string& emitter);
  /// Those noted whose colour the file knows. `shares_known`: each also has its luminous intensity.
  std::vector<studio::Primary> primaries(bool& shares_known) const;

 private:
  pugi::xml_node collection_;
  std::map<Meaning, std::string> names_;
};

}  // namespace chiaro::importers
