// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/study/study.h"

#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "controller/daemon/command.h"
#include "controller/daemon/study/facts.h"
#include "controller/daemon/study/tags.h"
#include "controller/daemon/study/write.h"
#include "tests/support/fake_world.h"

namespace chiaro::daemon::study {
namespace {

TEST(StudyTags, AreReadOneByOneInListsAndInRanges) {
  EXPECT_EQ(items_in("// |G| / 8 [I-14, I-16]"), (std::vector<int>{14, 16}));
  EXPECT_EQ(items_in("/// [I-31..I-33]; and [I-5]"), (std::vector<int>{31, 32, 33, 5}));
  EXPECT_EQ(items_in("[I-33 corrected]"), (std::vector<int>{33}));
  EXPECT_TRUE(items_in("a[i - 14], I-14, [I-99]").empty());
}

TEST(StudyTags, BelongToTheTestTheyStandInOrBefore) {
  const auto tags = tags_in("tests/unit/x/some_test.cpp",
                            "// [I-1]\nTEST(One, IsHere) {\n  // [I-2]\n}\n\n"
                            "TEST_P(Two, IsThere) {  // [I-3]\n}\n");
  ASSERT_EQ(tags.size(), 3u);
  EXPECT_EQ(tags[0].test, "One.IsHere");
  EXPECT_EQ(tags[1].test, "One.IsHere");
  EXPECT_EQ(tags[2].test, "Two.IsThere");
  EXPECT_EQ(tags_in("controller/x.h", "/// [I-4]\n").front().test, "");
}

TEST(StudyTags, TheProgramKnowsThoseOfItsOwnSources) {
  const auto now = tags_below(CHIARO_SOURCE);
  ASSERT_EQ(tag_facts().size(), now.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_EQ(tag_facts()[i].item, now[i].item);
    EXPECT_EQ(tag_facts()[i].file, now[i].file);
    EXPECT_EQ(tag_facts()[i].test, now[i].test);
  }
}

TEST(StudyFiles, CsvQuotesWhatItMustAndKeepsEveryDigit) {
  const Table table{"t", "T", {"name", "value"}, {{"a, \"b\"", 0.1}, {"c", 1.0 / 3}}};
  EXPECT_EQ(to_csv(table), "name,value\r\n\"a, \"\"b\"\"\",0.1\r\nc,0.33333333333333331\r\n");
  const Table gap{"t", "T", {"v"}, {{std::numeric_limits<double>::quiet_NaN()}}};
  EXPECT_EQ(to_csv(gap), "v\r\n\r\n");
}

TEST(StudyFiles, ClaimsSayWhenTheyDisagree) {
  const Table table = claims_table({{"a", "1", "2", "3", false}, {"b", "-", "-", "-", {}}});
  EXPECT_EQ(std::get<std::string>(table.rows[0].back()), "NO");
  EXPECT_EQ(std::get<std::string>(table.rows[1].back()), "cannot tell");
}

TEST(StudyCommand, SaysWhereItCannotWrite) {
  support::TemporaryFolder folder;
  support::FakeClock clock;
  support::FakeNetwork network;
  support::FakeWorld world{clock, network, folder.path()};
  EXPECT_EQ(run_chiaro(std::vector<std::string>{"study", "checklist", "--out", "/proc/no/such"},
                       world.world),
            ports::Exit::input_has_problems);
  EXPECT_NE(world.err.str().find("--out"), std::string::npos) << world.err.str();
}

TEST(StudyCommand, AnUnknownStudyIsAUsageErrorThatNamesTheKnownOnes) {
  support::TemporaryFolder folder;
  support::FakeClock clock;
  support::FakeNetwork network;
  support::FakeWorld world{clock, network, folder.path()};
  EXPECT_EQ(run_chiaro(std::vector<std::string>{"study", "lunch"}, world.world),
            ports::Exit::usage);
  EXPECT_NE(world.err.str().find("checklist"), std::string::npos) << world.err.str();
}

}  // namespace
}  // namespace chiaro::daemon::study
