// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/http_client.h"

#include <gtest/gtest.h>

namespace chiaro::drivers {
namespace {

TEST(HttpUrl, IsTakenApart) {
  const auto url = parse_http_url("http://127.0.0.1:8091/camera/main?x=1");
  ASSERT_TRUE(url);
  EXPECT_EQ(url->host, "127.0.0.1");
  EXPECT_EQ(url->port, 8091);
  EXPECT_EQ(url->target, "/camera/main?x=1");
}

TEST(HttpUrl, HasPort80AndTheRootByDefault) {
  const auto url = parse_http_url("http://camera.local");
  ASSERT_TRUE(url);
  EXPECT_EQ(url->port, 80);
  EXPECT_EQ(url->target, "/");
}

TEST(HttpUrl, RefusesWhatIsNoAddress) {
  for (const auto* wrong : {"", "camera", "https://x/", "http://", "http://x:0/", "http://x:99999/",
                            "http://x:8o/", "http://x/a b", "http://x/\r\nHost: y"})
    EXPECT_FALSE(parse_http_url(wrong)) << wrong;
}

TEST(HttpReply, WaitsUntilTheAnswerIsWhole) {
  const std::string whole =
      "HTTP/1.1 200 OK\r\nContent-Type: text/plain\r\nCONTENT-LENGTH: 5\r\n\r\nhello";
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const auto part = parse_http_reply(whole.substr(0, n), false);
    ASSERT_TRUE(part);
    EXPECT_EQ(part->status, 0) << n;
  }
  const auto reply = parse_http_reply(whole, false);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, 200);
  EXPECT_EQ(reply->type, "text/plain");
  EXPECT_EQ(reply->body, "hello");
}

TEST(HttpReply, JoinsChunks) {
  const auto reply = parse_http_reply(
      "HTTP/1.1 202 Accepted\r\nTransfer-Encoding: "
      "chunked\r\n\r\n3\r\nabc\r\n2;x=y\r\nde\r\n0\r\n\r\n",
      false);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, 202);
  EXPECT_EQ(reply->body, "abcde");
}

TEST(HttpReply, EndsWithTheConnectionWhenNoLengthIsGiven) {
  const std::string text = "HTTP/1.0 200 OK\r\n\r\nhello";
  EXPECT_EQ(parse_http_reply(text, false)->status, 0);
  EXPECT_EQ(parse_http_reply(text, true)->body, "hello");
}

TEST(HttpReply, ACutOrForeignAnswerIsAProblem) {
  EXPECT_FALSE(parse_http_reply("", true));
  EXPECT_FALSE(parse_http_reply("SSH-2.0-x\r\n\r\n", false));
  EXPECT_FALSE(parse_http_reply("HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\nhello", true));
  EXPECT_FALSE(
      parse_http_reply("HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\nxyz\r\n", false));
  EXPECT_FALSE(parse_http_reply(
      "HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\nffffffffff\r\n", false));
}

TEST(HttpRequest, SaysThatNobodyListens) {
  const auto reply = http_request({.url = "http://127.0.0.1:1/"}, std::chrono::seconds(2));
  ASSERT_FALSE(reply);
  EXPECT_NE(reply.problems().front().what.find("127.0.0.1:1 is out of reach"), std::string::npos);
}

}  // namespace
}  // namespace chiaro::drivers
