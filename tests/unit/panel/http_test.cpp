// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/http.h"

#include <gtest/gtest.h>

#include "tests/support/fake_brain.h"

namespace chiaro::panel {
namespace {

Request from(const std::string& host, const std::string& origin) {
  Request request;
  request.path = "/api/v1/state";
  if (!host.empty()) request.headers["host"] = host;
  if (!origin.empty()) request.headers["origin"] = origin;
  return request;
}

int status(const std::optional<Refusal>& refusal) { return refusal ? refusal->status : 200; }

TEST(Access, LetsThePageItselfInOnLoopback) {
  const Access loopback;
  EXPECT_EQ(status(forbidden(from("127.0.0.1:8090", ""), loopback)), 200);
  EXPECT_EQ(status(forbidden(from("localhost:8090", "http://localhost:8090"), loopback)), 200);
  EXPECT_EQ(status(forbidden(from("[::1]:8090", "http://[::1]:8090"), loopback)), 200);
}

TEST(Access, RefusesPagesOfOthers) {
  const Access loopback;
  EXPECT_EQ(status(forbidden(from("127.0.0.1:8090", "http://evil.example"), loopback)), 403);
  EXPECT_EQ(status(forbidden(from("127.0.0.1:8090", "http://127.0.0.1:9999"), loopback)), 403);
  EXPECT_EQ(status(forbidden(from("127.0.0.1:8090", "null"), loopback)), 403);
}

TEST(Access, RefusesANameThatWasReboundToThisMachine) {
  EXPECT_EQ(status(forbidden(from("evil.example:8090", "http://evil.example:8090"), {})), 403);
  EXPECT_EQ(status(forbidden(from("127.0.0.1.evil.example", ""), {})), 403);
}

TEST(Access, WantsTheTokenBeyondLoopback) {
  const Access beyond{true, "s3cret"};
  Request request = from("studio:8090", "http://studio:8090");
  EXPECT_EQ(status(forbidden(request, beyond)), 401);
  request.headers["authorization"] = "Bearer s3cre";
  EXPECT_EQ(status(forbidden(request, beyond)), 401);
  request.headers["authorization"] = "Bearer s3cret";
  EXPECT_EQ(status(forbidden(request, beyond)), 200);
  request.headers.erase("authorization");
  request.headers["cookie"] = "other=1; chiaro=s3cret";
  EXPECT_EQ(status(forbidden(request, beyond)), 200);
  request.headers["origin"] = "http://evil.example";
  EXPECT_EQ(status(forbidden(request, beyond)), 403);
}

TEST(Access, ShowsThePageItselfWithoutAToken) {
  Request request = from("studio:8090", "");
  request.path = "/";
  EXPECT_EQ(status(forbidden(request, {true, "s3cret"})), 200);
  request.path = "/metrics";
  EXPECT_EQ(status(forbidden(request, {true, "s3cret"})), 401);
}

TEST(Target, IsSplitAndDecoded) {
  const auto target = parse_target("/a%20b/c?x=1&y=a+b%26&z");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/a b/c");
  EXPECT_EQ(target->query.at("y"), "a b&");
  EXPECT_EQ(target->query.at("z"), "");
}

TEST(Target, RefusesBrokenEscapesAndZeroBytes) {
  for (const char* bad : {"/%", "/%4", "/%zz", "/a%00b", "", "a/b", "*", "/x?%"})
    EXPECT_FALSE(parse_target(bad)) << bad;
}

TEST(Base64, ComesBackAsItWent) {
  for (const std::string text : {"", "a", "ab", "abc", "abcd"})
    EXPECT_EQ(from_base64(support::base64(text)), text);
  EXPECT_EQ(from_base64("data:image/png;base64,YWI="), "ab");
  EXPECT_FALSE(from_base64("data:image/png,YWI="));
  EXPECT_FALSE(from_base64("YW I="));
  EXPECT_FALSE(from_base64("Y"));
}

TEST(Multipart, RefusesWhatIsCutOrHasNoBoundary) {
  const std::string body = "--b\r\nContent-Disposition: form-data; name=a\r\n\r\n1\r\n--b--\r\n";
  ASSERT_TRUE(parse_multipart("multipart/form-data; boundary=b", body));
  EXPECT_EQ(parse_multipart("multipart/form-data; boundary=b", body)->at(0).body, "1");
  for (std::size_t cut = 0; cut + 4 < body.size(); ++cut)
    EXPECT_FALSE(parse_multipart("multipart/form-data; boundary=b", body.substr(0, cut))) << cut;
  EXPECT_FALSE(parse_multipart("multipart/form-data", body));
}

}  // namespace
}  // namespace chiaro::panel
