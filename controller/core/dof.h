// SPDX-License-Identifier: Apache-2.0
// Degrees of freedom: the closed list of numbers that can change on a fixture, and the state of
// one fixture as {present, value} for each of them. Plain data: it travels through shared memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace chiaro::core {

enum class Unit : std::uint8_t { none, degrees, metres, kelvin };

enum class Dof : std::uint8_t {
#define DOF(name, file_name, unit, help) name,
#include "controller/core/dofs.def"
#undef DOF
};

inline constexpr std::size_t kDofs = 0
#define DOF(name, file_name, unit, help) +1
#include "controller/core/dofs.def"
#undef DOF
    ;

struct DofInfo {
  Dof dof;
  std::string_view name;       ///< as in C++ and the studio file: "azimuth"
  std::string_view file_name;  ///< as in look.json and the API, unit in the name: "azimuth_deg"
  Unit unit;
  std::string_view help;
};
const std::array<DofInfo, kDofs>& dofs();
constexpr std::size_t index_of(Dof dof) { return static_cast<std::size_t>(dof); }
const DofInfo& info(Dof dof);
std::optional<Dof> dof_named(std::string_view name_or_file_name);
/// Degrees to radians and back for angles; every other unit is the same inside and outside.
double inside_value(Dof dof, double file_value);
double file_value(Dof dof, double inside_value);
/// Position, aim and zoom, as against light and colour.
constexpr bool is_placement(Dof dof) { return dof >= Dof::azimuth; }
constexpr bool is_colour(Dof dof) { return dof > Dof::specular && dof < Dof::azimuth; }

/// The value of each degree of freedom that a fixture has, inside units (radians, metres, kelvin,
/// fractions of linear light).
class FixtureState {
 public:
  bool has(Dof dof) const { return (present_ >> index_of(dof)) & 1u; }
  /// `otherwise` when absent.
  double get(Dof dof, double otherwise = 0) const {
    return has(dof) ? values_[index_of(dof)] : otherwise;
  }
  void set(Dof dof, double value) {
    values_[index_of(dof)] = value;
    present_ |= 1u << index_of(dof);
  }
  void clear(Dof dof) {
    values_[index_of(dof)] = 0;
    present_ &= ~(1u << index_of(dof));
  }
  /// Takes every value that `over` has.
  void overlay(const FixtureState& over) {
    for (std::size_t i = 0; i < kDofs; ++i)
      if ((over.present_ >> i) & 1u) set(static_cast<Dof>(i), over.values_[i]);
  }
  std::uint32_t present() const { return present_; }
  friend bool operator==(const FixtureState&, const FixtureState&) = default;

 private:
  std::uint32_t present_ = 0;
  std::array<double, kDofs> values_{};
};
static_assert(kDofs <= 32);

}  // namespace chiaro::core
