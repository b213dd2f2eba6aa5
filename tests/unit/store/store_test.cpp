// SPDX-License-Identifier: Apache-2.0
#include "controller/store/store.h"

#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace chiaro::store {
namespace {

class StoreTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "chiaro-store-XXXXXX";
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::unique_ptr<Store> opened() {
    auto store = Store::open(file());
    EXPECT_TRUE(store) << core::to_string(store.problems());
    return store ? std::move(*store) : nullptr;
  }
  std::filesystem::path file() const { return folder_ / "deep" / "chiaro.sqlite"; }
  std::filesystem::path folder_;
};

LookRecord look(const std::string& name) {
  LookRecord record;
  record.name = name;
  record.mood = "rembrandt";
  record.verdict = "reached";
  record.request = "{}";
  record.json = R"({"name":")" + name + "\"}";
  record.picture = std::string("\x89PNG\0binary", 11);
  return record;
}

TEST_F(StoreTest, GivesBackALookWithItsPicturesByteForByte) {
  const auto store = opened();
  const auto id = store->save_look(look("Rembrandt"));
  ASSERT_TRUE(id);
  const auto back = store->look(*id);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->name, "Rembrandt");
  EXPECT_EQ(back->picture, look("").picture);
  EXPECT_EQ(back->placed_picture, "");
  EXPECT_EQ(back->created.size(), std::string("2000-01-01T00:00:00Z").size());
  EXPECT_FALSE(store->look(*id + 1));
}

TEST_F(StoreTest, SurvivesBeingOpenedAgain) {
  const auto id = opened()->save_look(look("split")).value();
  ASSERT_TRUE(opened()->set("live", "7"));
  const auto store = opened();
  EXPECT_EQ(store->look(id)->name, "split");
  EXPECT_EQ(store->get("live"), "7");
  EXPECT_EQ(store->get("other"), std::nullopt);
}

TEST_F(StoreTest, LosesNothingItAnsweredForWhenTheProcessIsKilled) {
  int told[2];
  ASSERT_EQ(pipe(told), 0);
  const pid_t child = fork();
  if (child == 0) {
    auto store = Store::open(file());
    for (int i = 0; store && i < 20; ++i)
      if (!(*store)->save_look(look("look " + std::to_string(i)))) break;
    const char done = 'd';
    [[maybe_unused]] const auto written = write(told[1], &done, 1);
    pause();
    _exit(0);
  }
  char done = 0;
  ASSERT_EQ(read(told[0], &done, 1), 1);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  close(told[0]);
  close(told[1]);
  EXPECT_EQ(opened()->looks().size(), 20u);
}

TEST_F(StoreTest, WritesAheadOfItsFile) {
  const auto store = opened();
  ASSERT_TRUE(store->set("key", "value"));
  EXPECT_TRUE(std::filesystem::exists(file().string() + "-wal"));
}

TEST_F(StoreTest, ListsLooksNewestFirstAndPrunesOnlyTheNameless) {
  const auto store = opened();
  const auto kept = store->save_look(look("a")).value();
  ASSERT_TRUE(store->keep_look(kept, "Anna's portrait"));
  const auto live = store->save_look(look("b")).value();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(store->save_look(look("c" + std::to_string(i))));
  store->prune_looks(2, live);
  std::vector<std::string> names;
  for (const LookRecord& record : store->looks()) names.push_back(record.name);
  EXPECT_EQ(names, (std::vector<std::string>{"c4", "c3", "b", "Anna's portrait"}));
}

TEST_F(StoreTest, UpdatesTheSolvedAgainPartOfALookAlone) {
  const auto store = opened();
  LookRecord record = look("a");
  record.id = store->save_look(record).value();
  record.json = "{\"new\":1}";
  record.verdict = "near";
  record.placed_picture = "placed";
  record.name = "not taken";
  ASSERT_TRUE(store->update_look(record));
  const auto back = store->look(record.id);
  EXPECT_EQ(back->json, "{\"new\":1}");
  EXPECT_EQ(back->placed_picture, "placed");
  EXPECT_EQ(back->name, "a");
}

TEST_F(StoreTest, KeepsMoodsByName) {
  const auto store = opened();
  ASSERT_TRUE(store->save_mood({"window", "By the window", "one"}));
  ASSERT_TRUE(store->save_mood({"window", "By the window", "two"}));
  ASSERT_EQ(store->moods().size(), 1u);
  EXPECT_EQ(store->mood("window")->picture, "two");
  EXPECT_TRUE(store->remove_mood("window"));
  EXPECT_FALSE(store->remove_mood("window"));
}

TEST_F(StoreTest, RemovesALookOnce) {
  const auto store = opened();
  const auto id = store->save_look(look("a")).value();
  EXPECT_TRUE(store->remove_look(id));
  EXPECT_FALSE(store->remove_look(id));
}

TEST_F(StoreTest, JournalsNewestFirst) {
  const auto store = opened();
  store->note("one");
  store->note("two");
  ASSERT_EQ(store->journal(10).size(), 2u);
  EXPECT_EQ(store->journal(10).front().what, "two");
}

TEST_F(StoreTest, TakesTextThatLooksLikeSqlAsText) {
  const auto store = opened();
  const std::string name = "'); DROP TABLE looks; --";
  const auto id = store->save_look(look(name)).value();
  EXPECT_EQ(store->look(id)->name, name);
}

TEST_F(StoreTest, RefusesAFileThatIsNoStoreAndLeavesItAlone) {
  std::filesystem::create_directories(file().parent_path());
  const std::string content(5000, 'x');
  std::ofstream(file()) << content;
  const auto store = Store::open(file());
  ASSERT_FALSE(store);
  EXPECT_NE(store.problems().front().remedy.find("move it away"), std::string::npos);
  EXPECT_EQ(std::filesystem::file_size(file()), content.size());
}

TEST_F(StoreTest, RefusesAFolderItCannotUse) {
  std::ofstream(folder_ / "deep") << "a file where the folder should be";
  EXPECT_FALSE(Store::open(file()));
}

}  // namespace
}  // namespace chiaro::store
