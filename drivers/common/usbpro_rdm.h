// SPDX-License-Identifier: Apache-2.0
// RDM through a DMX USB Pro whose firmware has it (version 2.x; 1.x is DMX alone).
#pragma once

#include <memory>

#include "controller/ports/devices.h"
#include "drivers/common/rdm.h"
#include "drivers/common/surroundings.h"

namespace chiaro::drivers::usbpro {

/// Opens the dongle that is meant, as its only user. Refuses one without RDM, with what to do.
core::Result<std::unique_ptr<rdm::Line>> open_rdm(const ports::DeviceMatch& device,
                                                  Surroundings& around);

}  // namespace chiaro::drivers::usbpro
