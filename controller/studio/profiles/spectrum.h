// SPDX-License-Identifier: Apache-2.0
// The colour of an emitter from its spectrum, as libraries and data sheets give it.
#pragma once

#include <optional>
#include <vector>

#include "controller/core/colour.h"

namespace chiaro::studio::profiles {

struct SpectralLine {
  double nm = 0;
  double power = 0;  ///< relative, per nanometre
};
using Spectrum = std::vector<SpectralLine>;

/// CIE 1931 chromaticity; linear between the lines given, nothing outside them. The observer is the
/// multi-lobe fit of Wyman, Sloan and Shirley (JCGT 2013), within 1 % of the tables. Nothing when
/// wavelengths do not rise or no light can be seen.
std::optional<core::Chromaticity> chromaticity_of(const Spectrum& spectrum);
/// Of light of one wavelength; precondition: 380..780 nm.
core::Chromaticity chromaticity_of_wavelength(double nm);

}  // namespace chiaro::studio::profiles
