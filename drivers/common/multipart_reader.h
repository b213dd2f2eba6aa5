// SPDX-License-Identifier: Apache-2.0
// An endless multipart answer (multipart/x-mixed-replace, "MJPEG"): of the parts that have come
// only the newest whole one is kept. Cameras differ in how they write it: with or without lengths,
// quotes, and dashes that belong to the boundary or do not.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "controller/ports/clock.h"

namespace chiaro::drivers {

class MultipartReader {
 public:
  /// No part is longer.
  static constexpr std::size_t kMostPart = 64u << 20;

  /// Whether an answer of that content type is such a stream.
  static bool is_stream(std::string_view content_type);
  explicit MultipartReader(std::string_view content_type);

  /// False when this cannot be such a stream any more: a part without end.
  bool take(std::string_view bytes, ports::TimePoint now);

  struct Part {
    std::string body;
    ports::TimePoint begun;  ///< when its first bytes came
  };
  /// The newest whole part that was not taken yet; those before it are gone.
  std::optional<Part> newest();
  /// Forgets whole parts, and drops the one that is coming when its end is there.
  void skip();
  std::size_t parts() const { return parts_; }

 private:
  bool step();
  bool find_head();
  void keep(std::size_t length, std::size_t used);

  std::string mark_;  ///< "--boundary"
  std::string held_;
  bool in_part_ = false, stale_ = false;
  std::optional<std::size_t> length_;
  std::size_t searched_ = 0;  ///< of a part without a length: the end is not before
  ports::TimePoint now_, begun_;
  std::optional<Part> newest_;
  std::size_t parts_ = 0;
};

}  // namespace chiaro::drivers
