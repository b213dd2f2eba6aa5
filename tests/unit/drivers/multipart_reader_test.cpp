// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/multipart_reader.h"

#include <gtest/gtest.h>

namespace chiaro::drivers {
namespace {

using namespace std::chrono_literals;
constexpr const char* kType = "multipart/x-mixed-replace; boundary=frame";
constexpr ports::TimePoint kStart{};

std::string part(const std::string& body, bool length, const std::string& mark = "frame") {
  return "--" + mark + "\r\nContent-Type: image/jpeg\r\n" +
         (length ? "Content-length: " + std::to_string(body.size()) + "\r\n" : "") + "\r\n" + body +
         "\r\n";
}

TEST(MultipartReader, KnowsAStreamByItsContentType) {
  EXPECT_TRUE(MultipartReader::is_stream(kType));
  EXPECT_TRUE(MultipartReader::is_stream("Multipart/X-Mixed-Replace;Boundary=\"--a b\""));
  EXPECT_FALSE(MultipartReader::is_stream("image/jpeg"));
  EXPECT_FALSE(MultipartReader::is_stream("multipart/x-mixed-replace"));
}

TEST(MultipartReader, GivesTheSamePartsHoweverTheirBytesArrive) {
  const std::string all =
      "\r\n" + part("one", true) + part("two--frame", true) + part("three", true);
  for (std::size_t size = 1; size <= all.size(); ++size) {
    MultipartReader reader(kType);
    std::string seen;
    for (std::size_t at = 0; at < all.size(); at += size) {
      ASSERT_TRUE(reader.take(std::string_view(all).substr(at, size), kStart));
      if (const auto whole = reader.newest()) seen += whole->body + ",";
    }
    EXPECT_EQ(reader.parts(), 3u) << size;
    EXPECT_EQ(seen.substr(seen.size() - 6), "three,") << size;
    if (size == 1) {
      EXPECT_EQ(seen, "one,two--frame,three,");
    }
  }
}

TEST(MultipartReader, KeepsOnlyTheNewest) {
  MultipartReader reader(kType);
  ASSERT_TRUE(reader.take(part("old", true) + part("new", true), kStart));
  EXPECT_EQ(reader.newest()->body, "new");
  EXPECT_FALSE(reader.newest());
}

TEST(MultipartReader, FindsTheEndOfPartsThatDoNotSayTheirLength) {
  for (const std::string mark : {"frame", "--frame"}) {
    MultipartReader reader("multipart/x-mixed-replace; boundary=--frame");
    const std::string all = part("one", false, mark) + part("t\r\nwo", false, mark);
    for (const char byte : all) ASSERT_TRUE(reader.take({&byte, 1}, kStart));
    EXPECT_EQ(reader.newest()->body, "one") << "the second has no end yet";
    ASSERT_TRUE(reader.take("--" + mark + "\r\n", kStart));
    EXPECT_EQ(reader.newest()->body, "t\r\nwo");
  }
}

TEST(MultipartReader, SaysWhenAPartBeganToArrive) {
  MultipartReader reader(kType);
  const std::string all = part("picture", true);
  reader.take(all.substr(0, all.size() - 5), kStart + 3s);
  reader.take(all.substr(all.size() - 5), kStart + 4s);
  EXPECT_EQ(reader.newest()->begun, kStart + 3s);
}

TEST(MultipartReader, SkipsWhatWaitedAndWhatIsHalfThere) {
  MultipartReader reader(kType);
  const std::string half = part("stale too", true);
  reader.take(part("stale", true) + half.substr(0, half.size() - 6), kStart);
  reader.skip();
  reader.take(half.substr(half.size() - 6), kStart);
  EXPECT_FALSE(reader.newest());
  reader.take(part("fresh", true), kStart);
  EXPECT_EQ(reader.newest()->body, "fresh");
}

TEST(MultipartReader, GivesUpOnWhatHasNoEnd) {
  MultipartReader reader(kType);
  EXPECT_FALSE(reader.take("--frame\r\nContent-Length: 99999999999\r\n\r\nx", kStart) &&
               reader.take(std::string(MultipartReader::kMostPart + 1, 'x'), kStart));
  MultipartReader headless(kType);
  EXPECT_FALSE(headless.take("--frame\r\n" + std::string(20000, 'a'), kStart));
  MultipartReader noise(kType);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(noise.take(std::string(1000, 'a'), kStart));
}

}  // namespace
}  // namespace chiaro::drivers
