// SPDX-License-Identifier: Apache-2.0
// Fixture and show files, mutated with fixed seeds: each is read or refused with a sentence.
#include <gtest/gtest.h>

#include "controller/core/random.h"
#include "controller/importers/import_fixture.h"
#include "controller/importers/show.h"
#include "controller/importers/zip.h"
#include "tests/unit/importers/samples.h"

namespace chiaro::importers {
namespace {

std::string mutated(std::string text, core::Random& random) {
  static const std::vector<std::string> kWords{
      "<",         ">",     "\"",  "</",    "<!--",
      "<![CDATA[", "&#0;",  "&x;", "{",     "}",
      "[",         "null",  "-1",  "1e999", "99999999999999999999",
      "65536/2",   "255/1", "nan", "\xff",  std::string(1, '\0'),
      "../",       "None"};
  const auto below = [&](std::size_t n) {
    return n == 0 ? 0 : static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(n)));
  };
  for (std::size_t step = 0, steps = 1 + below(5); step < steps && !text.empty(); ++step) {
    const std::size_t at = below(text.size());
    switch (below(6)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.insert(at, kWords[below(kWords.size())]);
        break;
      case 2:
        text.erase(at, 1 + below(40));
        break;
      case 3:
        text.insert(below(text.size()), text.substr(at, 1 + below(200)));
        break;
      case 4:
        for (std::size_t i = at; i < std::min(at + 4, text.size()); ++i)
          if (text[i] >= '0' && text[i] <= '9') text[i] = static_cast<char>('0' + below(10));
        break;
      default:
        if (below(4) == 0) text.resize(at);
    }
  }
  return text;
}

void expect_a_sentence(const core::Problems& problems) {
  ASSERT_FALSE(problems.empty());
  for (const core::Problem& problem : problems) {
    EXPECT_FALSE(problem.what.empty());
    EXPECT_LE(problem.what.size(), 2000u);
  }
}

constexpr const char* kQxf =
    "<FixtureDefinition><Manufacturer>A</Manufacturer><Model>B</Model><Type>Moving Head</Type>"
    "<Channel Name=\"Pan\" Preset=\"PositionPan\"/><Channel Name=\"Pan fine\" "
    "Preset=\"PositionPanFine\"/><Channel Name=\"Dim\"><Group "
    "Byte=\"0\">Intensity</Group><Capability "
    "Min=\"0\" Max=\"7\">Closed</Capability><Capability Min=\"8\" Max=\"134\">Dimmer 0 - 100 %"
    "</Capability><Capability Min=\"135\" Max=\"255\">Strobe</Capability></Channel><Mode "
    "Name=\"M\">"
    "<Physical><Lens DegreesMin=\"10\" DegreesMax=\"40\"/><Focus "
    "PanMax=\"540\"/></Physical><Channel "
    "Number=\"0\">Pan</Channel><Channel Number=\"2\">Pan fine</Channel><Channel Number=\"1\">Dim"
    "</Channel></Mode></FixtureDefinition>";

TEST(ImporterMutations, EveryFixtureFileIsReadOrRefused) {
  const std::pair<std::string, std::string> seeds[] = {
      {".qxf", kQxf}, {".gdtf", samples::kGdtf}, {".json", samples::kOfl}};
  for (const auto& [ending, text] : seeds)
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
      SCOPED_TRACE(ending + " seed " + std::to_string(seed));
      core::Random random(seed);
      std::string bytes = mutated(text, random);
      if (ending == ".gdtf") bytes = *zip_of({{"description.xml", bytes}});
      // Every other time the archive itself is hit.
      if (ending == ".gdtf" && seed % 2 == 1) bytes = mutated(bytes, random);
      ASSERT_NO_THROW({
        const auto made = import_fixture(bytes, ending, "a", "f" + ending);
        if (made.ok())
          EXPECT_FALSE(made->profile.modes.empty());
        else
          expect_a_sentence(made.problems());
      });
      if (HasFailure()) return;
    }
}

TEST(ImporterMutations, EveryShowIsReadOrRefused) {
  const auto gdtf = zip_of({{"description.xml", samples::kGdtf}});
  const std::string scene =
      "<GeneralSceneDescription><Scene><Layers><Layer><ChildList><Fixture "
      "name=\"a\"><Matrix>{1,0,0}"
      "{0,1,0}{0,0,1}{1,2,3}</Matrix><GDTFSpec>W.gdtf</GDTFSpec><GDTFMode>Extended</GDTFMode>"
      "<Addresses><Address "
      "break=\"0\">5</Address></Addresses></Fixture></ChildList></Layer></Layers>"
      "</Scene></GeneralSceneDescription>";
  const Definitions nobody = [](const std::string&, const std::string&) -> std::optional<Imported> {
    return std::nullopt;
  };
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    core::Random random(seed);
    ASSERT_NO_THROW({
      const auto qxw = read_qxw(mutated(samples::kQxw, random), "s.qxw", nobody);
      if (!qxw.ok()) expect_a_sentence(qxw.problems());
      const auto bytes =
          zip_of({{"GeneralSceneDescription.xml", mutated(scene, random)}, {"W.gdtf", *gdtf}});
      const auto mvr = read_mvr(seed % 2 == 0 ? *bytes : mutated(*bytes, random), "s.mvr");
      if (!mvr.ok()) expect_a_sentence(mvr.problems());
    });
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace chiaro::importers
