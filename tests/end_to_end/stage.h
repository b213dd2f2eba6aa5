// SPDX-License-Identifier: Apache-2.0
// A studio of its own for each end-to-end test: the shipped one with its own universe, ports and
// folders, so that tests run beside each other and beside a user's demo.
#pragma once

#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/end_to_end/process.h"
#include "tests/support/fake_world.h"

namespace chiaro::end_to_end {

using Json = nlohmann::json;

class EndToEnd : public testing::Test {
 protected:
  EndToEnd();

  /// Writes the shipped studio with this test's ports and universe, and each `{from, to}` replaced;
  /// fails the test when a `from` is not in it. Returns the file.
  std::filesystem::path write_studio(
      const std::vector<std::pair<std::string, std::string>>& changes = {});
  /// A mesh or picture fetched for the tests; fails the test when it has not been.
  static std::string asset(const std::string& path);
  static std::string program(const std::string& name);

  /// `chiaro WORDS…` to its end.
  Finished chiaro(std::vector<std::string> words);
  /// `chiaro demo` in the background, with the arguments of this test's studio.
  std::unique_ptr<Process> demo(const std::filesystem::path& studio,
                                std::vector<std::string> words = {});
  /// Somebody else's sACN receiver on this test's universe.
  std::unique_ptr<Process> receiver();
  /// What the receiver has printed so far: one object per packet.
  static std::vector<Json> packets(const Process& receiver);

  /// The daemon's answer; null when it does not answer with success.
  Json ask(const std::string& method, const std::string& path, const Json& body = nullptr);
  Json state() { return ask("GET", "/api/v1/state"); }

  support::TemporaryFolder folder_;
  std::uint16_t panel_port_, camera_port_, universe_;
  Environment environment_;
};

}  // namespace chiaro::end_to_end
