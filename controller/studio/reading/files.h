// SPDX-License-Identifier: Apache-2.0
// The files that a studio names: found beside the studio file, else among what is shipped.
#pragma once

#include <filesystem>
#include <string>

#include "controller/core/result.h"
#include "controller/studio/load.h"
#include "controller/studio/reading/report.h"
#include "controller/studio/reading/tree.h"

namespace chiaro::studio::reading {

/// What every section's reader needs beside its node.
struct Context {
  std::filesystem::path base;  ///< relative paths are tried from here first
  const Folders& folders;
  Report& report;
};

/// The whole file, or why it cannot be had. Refuses what is larger than a studio file may be.
core::Result<std::string> read_text(const std::filesystem::path& file);

/// The absolute path of the file that `tree` names, which exists; else reports where it was
/// looked for. `what` is for the message: "mesh". Empty when there is none.
std::filesystem::path existing_file(const Tree* tree, const std::string& what, Context& context);
std::filesystem::path existing_file(const Tree& where, const std::string& name,
                                    const std::string& what, Context& context);

}  // namespace chiaro::studio::reading
