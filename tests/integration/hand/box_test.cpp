// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/box.h"

#include <fstream>
#include <gtest/gtest.h>
#include <numeric>
#include <thread>
#include <vector>

#include "controller/daemon/file_lock.h"
#include "tests/support/fake_world.h"

namespace chiaro::daemon {
namespace {

constexpr std::size_t kWords = 50;
const BoxFormat kFormat{BoxKind::sent, 0xf00d, kWords};

using Value = std::vector<std::uint64_t>;

/// A value all of whose words belong to one post: mixing two would show.
Value value(std::uint64_t post) {
  Value words(kWords);
  std::iota(words.begin(), words.end(), post * 1000);
  return words;
}

Value blank_box() {
  Value box(box_words(kWords));
  write_header(box, kFormat);
  return box;
}

struct Killed {};

/// Lays a value in, but dies before store number `stores`.
void lay_in_and_die(Value& box, std::uint64_t sequence, std::size_t stores) {
  std::size_t done = 0;
  try {
    lay_in(box, sequence, value(sequence), [&](std::uint64_t& word, std::uint64_t what) {
      if (done++ == stores) throw Killed();
      ReleaseStore{}(word, what);
    });
  } catch (const Killed&) {
  }
}

constexpr std::size_t kStores = kWords + 3;

TEST(Box, GivesTheOldOrTheNewValueWhereverTheWriterIsKilled) {
  for (std::size_t stores = 0; stores <= kStores; ++stores) {
    Value box = blank_box();
    for (std::uint64_t post = 1; post <= 9; ++post) lay_in(box, post, value(post), ReleaseStore{});
    lay_in_and_die(box, 10, stores);
    Value into(kWords);
    const std::uint64_t sequence = take_out(box, 0, into);
    ASSERT_EQ(sequence, stores == kStores ? 10u : 9u) << stores;
    EXPECT_EQ(into, value(sequence)) << stores;
  }
}

TEST(Box, GoesOnAfterAWriterDiedWhereverItDid) {
  for (std::size_t stores = 0; stores <= kStores; ++stores) {
    Value box = blank_box();
    lay_in(box, 1, value(1), ReleaseStore{});
    lay_in_and_die(box, 2, stores);
    lay_in(box, 3, value(3), ReleaseStore{});
    Value into(kWords);
    ASSERT_EQ(take_out(box, 1, into), 3u);
    EXPECT_EQ(into, value(3));
  }
}

TEST(Box, PassesOverASlotWhoseChecksumIsWrong) {
  Value box = blank_box();
  lay_in(box, 1, value(1), ReleaseStore{});
  lay_in(box, 2, value(2), ReleaseStore{});
  box[kBoxHeader + 2 * (kSlotHeader + kWords) + kSlotHeader + 7] ^= 1;
  Value into(kWords);
  ASSERT_EQ(take_out(box, 0, into), 1u);
  EXPECT_EQ(into, value(1));
}

TEST(Box, GivesNothingBeforeTheFirstPostAndNothingTwice) {
  Value box = blank_box(), into(kWords);
  EXPECT_EQ(take_out(box, 0, into), 0u);
  lay_in(box, 1, value(1), ReleaseStore{});
  EXPECT_EQ(take_out(box, 0, into), 1u);
  EXPECT_EQ(take_out(box, 1, into), 0u);
}

TEST(Box, IsNeverTornBetweenTwoThreads) {
  Value box = blank_box();
  std::thread writer([&] {
    for (std::uint64_t post = 1; post <= 20000; ++post)
      lay_in(box, post, value(post), ReleaseStore{});
  });
  std::uint64_t seen = 0;
  while (seen < 20000) {
    Value into(kWords);
    if (const std::uint64_t sequence = take_out(box, seen, into); sequence != 0) {
      ASSERT_GT(sequence, seen);
      ASSERT_EQ(into, value(sequence));
      seen = sequence;
    } else {
      std::this_thread::yield();
    }
  }
  writer.join();
}

class BoxFile : public testing::Test {
 protected:
  std::string refusal(const BoxFormat& format) {
    const auto reader = BoxReader::open(file_, format);
    return reader ? "" : reader.problems().front().what;
  }
  support::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "some.box";
};

TEST_F(BoxFile, CarriesValuesFromOneMappingToAnother) {
  auto writer = BoxWriter::create(file_, kFormat);
  ASSERT_TRUE(writer);
  auto reader = BoxReader::open(file_, kFormat);
  ASSERT_TRUE(reader);
  Value into(kWords);
  EXPECT_FALSE((*reader)->read(into));
  (*writer)->post(value(1));
  (*writer)->post(value(2));
  ASSERT_TRUE((*reader)->read(into));
  EXPECT_EQ(into, value(2));
  EXPECT_FALSE((*reader)->read(into));
}

TEST_F(BoxFile, IsRefusedInWordsWhenAnythingDiffers) {
  ASSERT_TRUE(BoxWriter::create(file_, kFormat));
  EXPECT_EQ(refusal(kFormat), "");
  EXPECT_NE(refusal({BoxKind::wanted, 0xf00d, kWords}).find("other direction"), std::string::npos);
  EXPECT_NE(refusal({BoxKind::sent, 0xbeef, kWords}).find("another studio file"),
            std::string::npos);
  EXPECT_NE(refusal({BoxKind::sent, 0xf00d, kWords + 1}).find("another size"), std::string::npos);
  Value words(box_words(kWords));
  const auto put = [&] {
    std::ofstream(file_, std::ios::binary)
        .write(reinterpret_cast<const char*>(words.data()),
               static_cast<std::streamsize>(words.size() * sizeof(std::uint64_t)));
  };
  put();
  EXPECT_NE(refusal(kFormat).find("not one of Chiaro's boxes"), std::string::npos);
  write_header(words, kFormat);
  words[1] ^= 1;
  put();
  EXPECT_NE(refusal(kFormat).find("another layout"), std::string::npos);
  words = Value(3);
  put();
  EXPECT_NE(refusal(kFormat).find("too short"), std::string::npos);
}

TEST_F(BoxFile, ShorterThanItsHeaderSaysIsRefusedBeforeAnyoneReadsBeyondIt) {
  ASSERT_TRUE(BoxWriter::create(file_, kFormat));
  std::filesystem::resize_file(file_, 400);
  EXPECT_NE(refusal(kFormat).find("another size"), std::string::npos);
}

TEST_F(BoxFile, TellsItsReaderWhenAnotherTookItsPlace) {
  const auto first = BoxWriter::create(file_, kFormat);
  const auto reader = BoxReader::open(file_, kFormat);
  ASSERT_TRUE(reader);
  EXPECT_FALSE((*reader)->replaced());
  const auto second = BoxWriter::create(file_, kFormat);
  EXPECT_TRUE((*reader)->replaced());
}

TEST_F(BoxFile, HasOneWriterByItsLock) {
  const auto lock = folder_.path() / "some.lock";
  auto first = FileLock::take(lock, "chiarod");
  ASSERT_TRUE(first);
  const auto second = FileLock::take(lock, "chiarod");
  ASSERT_FALSE(second);
  EXPECT_NE(second.problems()[0].what.find("another chiarod is running (process "),
            std::string::npos);
  first->reset();
  EXPECT_TRUE(FileLock::take(lock, "chiarod"));
}

}  // namespace
}  // namespace chiaro::daemon
