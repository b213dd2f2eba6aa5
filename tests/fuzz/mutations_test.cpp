// SPDX-License-Identifier: Apache-2.0
// A fuzzer without a fuzzer: valid studio files, mutated with fixed seeds. Whatever comes, the
// reader loads it or reports it; it never throws, hangs or answers with an empty list.
#include <fstream>
#include <gtest/gtest.h>

#include "controller/core/random.h"
#include "controller/studio/load.h"
#include "tests/support/fake_world.h"
#include "tests/support/studio_text.h"

namespace chiaro::studio {
namespace {

const std::vector<std::string>& hostile_words() {
  static const std::vector<std::string> kWords{".nan",  ".inf",  "1e308",
                                               "-1",    "0",     "99999999999999999999",
                                               "~",     "null",  "[]",
                                               "{}",    "&a",    "*a",
                                               "<<:",   "!!int", "- ",
                                               ": ",    "? ",    "\"",
                                               "'",     "|",     ">",
                                               "#",     "---\n", "\t",
                                               "deg",   " m",    " K",
                                               "[[[[[", "{{{{",  "\n\n",
                                               "°",     "\xff",  std::string(1, '\0'),
                                               "yes",   "%",     ","};
  return kWords;
}

std::string mutated(std::string text, core::Random& random) {
  const auto below = [&](std::size_t n) {
    return n == 0 ? 0 : static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(n)));
  };
  const auto line_at = [&](std::size_t at) {
    const std::size_t start = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    return std::pair(start, std::min(text.find('\n', at), text.size() - 1) + 1 - start);
  };
  for (std::size_t step = 0, steps = 1 + below(4); step < steps && !text.empty(); ++step) {
    const std::size_t at = below(text.size());
    switch (below(7)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.insert(at, hostile_words()[below(hostile_words().size())]);
        break;
      case 2:
        text.erase(at, 1 + below(20));
        break;
      case 3: {
        const auto [start, length] = line_at(at);
        text.erase(start, length);
        break;
      }
      case 4: {
        const auto [start, length] = line_at(at);
        text.insert(line_at(below(text.size())).first, text.substr(start, length));
        break;
      }
      case 5: {
        const auto [start, length] = line_at(at);
        text.insert(start, 1 + below(8), ' ');
        break;
      }
      default:
        text.resize(at);
    }
  }
  return text;
}

void expect_an_answer(const std::string& text, const std::filesystem::path& folder) {
  const auto loaded = parse_studio(text, folder, support::shipped_folders());
  if (loaded.ok()) {
    EXPECT_FALSE(core::any_error(loaded->warnings));
    EXPECT_FALSE(loaded->studio.cameras.empty());
    EXPECT_EQ(placed_rig(loaded->studio).states.size(), loaded->studio.fixtures.size());
    return;
  }
  EXPECT_TRUE(core::any_error(loaded.problems()));
  for (const core::Problem& problem : loaded.problems()) {
    EXPECT_FALSE(problem.what.empty());
    EXPECT_LE(problem.what.size(), 600u);
  }
}

TEST(StudioMutations, EveryFileLoadsOrIsReported) {
  support::TemporaryFolder folder;
  support::write_full_studio_files(folder.path());
  std::ifstream in(support::shipped_folders().studios() / "portrait.yaml");
  const std::string seeds[] = {support::full_studio_text(),
                               std::string((std::istreambuf_iterator<char>(in)), {})};
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    core::Random random(seed);
    const std::string text = mutated(seeds[seed % 2], random);
    SCOPED_TRACE("seed " + std::to_string(seed));
    ASSERT_NO_THROW(expect_an_answer(text, folder.path())) << text;
    if (HasFailure()) break;
  }
}

}  // namespace
}  // namespace chiaro::studio
