// SPDX-License-Identifier: Apache-2.0
#include "controller/core/dof.h"

#include "controller/core/units.h"

namespace chiaro::core {

const std::array<DofInfo, kDofs>& dofs() {
  static constexpr std::array<DofInfo, kDofs> kAll{{
#define DOF(name, file_name, unit, help) DofInfo{Dof::name, #name, file_name, Unit::unit, help},
#include "controller/core/dofs.def"
#undef DOF
  }};
  return kAll;
}

const DofInfo& info(Dof dof) { return dofs()[index_of(dof)]; }

std::optional<Dof> dof_named(std::string_view name) {
  for (const DofInfo& entry : dofs())
    if (entry.name == name || entry.file_name == name) return entry.dof;
  return std::nullopt;
}

double inside_value(Dof dof, double value) {
  return info(dof).unit == Unit::degrees ? radians(value) : value;
}
double file_value(Dof dof, double value) {
  return info(dof).unit == Unit::degrees ? degrees(value) : value;
}

}  // namespace chiaro::core
