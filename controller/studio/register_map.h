// SPDX-License-Identifier: Apache-2.0
// What the registers of a Modbus device mean, as its maker's table says. Maps are files in
// config/modbus; a user's own stand in a folder `modbus` beside the studio file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "controller/core/result.h"

namespace chiaro::studio {

struct RegisterChannel {
  std::string name;
  int slot = 0;     ///< 0-based within the device's own slots
  int slots = 1;    ///< 1 or 2, most significant first
  int address = 0;  ///< as on the wire: counts from 0
  int words = 1;    ///< 1 or 2 registers
  bool low_word_first = false;
  double from = 0, to = 65535;  ///< the register's value at level 0 and 1
  bool dali = false;            ///< the logarithmic arc power levels of DALI
  friend bool operator==(const RegisterChannel&, const RegisterChannel&) = default;
};

/// A motor behind registers: where it shall be, where it is, and what else it can be told.
struct RegisterAxis {
  std::string name;
  int slot = 0;    ///< 0-based within the device's own slots; two of them, a 16-bit position
  int target = 0;  ///< as on the wire: counts from 0
  int words = 1;
  bool low_word_first = false;
  double from = 0, to = 65535;   ///< the registers' value at both ends; below 0: two's complement
  int actual = -1;               ///< where it is, in the same measure; -1 = it does not say
  bool actual_is_input = false;  ///< an input register, else a holding register
  int status = -1;               ///< a register of flags; -1 = none
  bool status_is_input = false;
  int moving_bit = -1, homed_bit = -1, fault_bit = -1;
  int home = -1, home_value = 1;  ///< the register that starts homing; -1 = none
  int stop = -1, stop_value = 1;  ///< and the one that stops the motor
  friend bool operator==(const RegisterAxis&, const RegisterAxis&) = default;
};

struct RegisterMap {
  std::string name;  ///< "waveshare/analog-output-8ch"
  std::string maker, device;
  double timeout_s = 0.5, gap_s = 0;
  bool single_writes = false;
  std::vector<RegisterChannel> channels;  ///< by address
  std::vector<RegisterAxis> axes;
  int slots = 0;
  std::uint64_t fingerprint = 0;  ///< of the text
  friend bool operator==(const RegisterMap&, const RegisterMap&) = default;
};

/// Every problem of the map at once. `own` is the user's folder, `shipped` that of config/modbus.
core::Result<RegisterMap> load_register_map(const std::string& name,
                                            const std::filesystem::path& own,
                                            const std::filesystem::path& shipped);
core::Result<RegisterMap> parse_register_map(const std::string& yaml, const std::string& name,
                                             const std::string& file);
std::vector<std::string> register_map_names(const std::filesystem::path& folder);

}  // namespace chiaro::studio
