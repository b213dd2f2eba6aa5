// SPDX-License-Identifier: Apache-2.0
// Objects lit one by one, put together again: the thesis's 2D interactive lighting [I-37]. Each
// part is drawn and lit with the others hidden; nearer parts then cover farther ones.
#pragma once

#include <span>

#include "controller/core/picture.h"
#include "controller/core/result.h"

namespace chiaro::core {

struct Part {
  const Picture* picture = nullptr;  ///< lit as this part is to be
  const Plane* depth = nullptr;      ///< metres; +infinity where the part is not
};

/// Per pixel the picture of the nearest part; black where there is none. Of equals the first wins.
/// A problem when a part lacks its planes or their sizes differ.
Result<Picture> merged(std::span<const Part> parts);

}  // namespace chiaro::core
