// SPDX-License-Identifier: Apache-2.0
// libFuzzer's door to the studio reader; built with Clang alone. Run for instance:
//   fuzz_parse_studio -max_total_time=60 -dict=tests/fuzz/studio.dict corpus config/studios
#include <cstddef>
#include <cstdint>
#include <string>

#include "controller/studio/load.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const chiaro::studio::Folders folders{std::filesystem::path(CHIARO_SOURCE) / "config"};
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto loaded = chiaro::studio::parse_studio(text, "/nonexistent", folders);
  if (!loaded.ok() && loaded.problems().empty()) __builtin_trap();
  return 0;
}
