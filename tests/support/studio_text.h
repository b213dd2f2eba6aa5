// SPDX-License-Identifier: Apache-2.0
// A studio file that uses every setting of the grammar once, for tests of the reader and for
// mutations; and a folder that holds the files it names.
#pragma once

#include <filesystem>
#include <string>

#include "controller/studio/load.h"

namespace chiaro::support {

/// Names mesh.ply, mesh.obj, off.exr and frame.png relative to the file.
const std::string& full_studio_text();
/// Writes those (a mesh of one triangle, empty pictures) into `folder`.
void write_full_studio_files(const std::filesystem::path& folder);

/// The shipped config folder of the source tree.
studio::Folders shipped_folders();

/// `text` with its only occurrence of `from` replaced. Throws when there is none or more than one:
/// then the test itself is wrong.
std::string edited(std::string text, const std::string& from, const std::string& to);

}  // namespace chiaro::support
