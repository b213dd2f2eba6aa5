// SPDX-License-Identifier: Apache-2.0
// What is true of every line of studies.def: at its smallest it runs to the end, finds something
// and writes what it promises.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

#include "controller/daemon/command.h"
#include "controller/daemon/study/study.h"
#include "tests/support/fake_world.h"

namespace chiaro::daemon::study {

void PrintTo(const Study& study, std::ostream* out) { *out << study.name; }

namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

class EveryStudy : public testing::TestWithParam<Study> {
 protected:
  support::TemporaryFolder folder_;
  support::FakeClock clock_{support::FakeClock::Sleep::jumps};
  support::FakeNetwork network_;
  support::FakeWorld world_{clock_, network_, folder_.path()};
};

// [I-28, I-30, I-35, I-39..I-41]
TEST_P(EveryStudy, RunsAtItsSmallestAndWritesWhatItPromises) {
  const std::string name(GetParam().name);
  const std::string out = (folder_.path() / "out").string();
  ASSERT_EQ(run_chiaro(std::vector<std::string>{"study", name, "--quick", "--items", "1", "--out",
                                                out, "--json"},
                       world_.world),
            ports::Exit::done)
      << world_.err.str();
  const auto answer = nlohmann::json::parse(world_.out.str());
  EXPECT_EQ(answer["study"], name);
  EXPECT_GE(answer["record"]["items"].get<int>(), 1);
  EXPECT_FALSE(answer["tables"].empty());
  const auto record =
      nlohmann::json::parse(content(std::filesystem::path(out) / name / "record.json"));
  for (const char* key : {"command", "commit", "machine"})
    EXPECT_FALSE(record[key].get<std::string>().empty()) << key;
  ASSERT_FALSE(record["files"].empty());
  for (const std::string file : record["files"]) {
    const std::string text = content(std::filesystem::path(out) / name / file);
    EXPECT_FALSE(text.empty()) << file;
    if (file.ends_with(".svg")) {
      EXPECT_EQ(text.rfind("<svg", 0), 0u) << file;
      EXPECT_EQ(text.find("nan"), std::string::npos) << file;
    } else if (file.ends_with(".html")) {
      EXPECT_EQ(text.rfind("<!DOCTYPE html>", 0), 0u) << file;
      EXPECT_NE(text.find("data:image/jpeg;base64,/9j/"), std::string::npos) << file;
    } else {
      EXPECT_NE(text.find("\r\n"), text.rfind("\r\n")) << file << " has a heading and no row";
    }
  }
}

TEST_P(EveryStudy, SaysInASentenceWhatItIsFor) {
  EXPECT_GT(GetParam().sentence.size(), 20u);
  EXPECT_NE(GetParam().run, nullptr);
}

INSTANTIATE_TEST_SUITE_P(All, EveryStudy, testing::ValuesIn(studies().begin(), studies().end()),
                         [](const auto& study) { return std::string(study.param.name); });

}  // namespace
}  // namespace chiaro::daemon::study
