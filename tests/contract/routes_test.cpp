// SPDX-License-Identifier: Apache-2.0
// What is true of every address that changes something: controller/panel/routes.def.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "controller/panel/api.h"
#include "tests/support/fake_brain.h"

namespace chiaro::panel {

/// How a failing test names its route; found by the argument's namespace.
void PrintTo(const Address& address, std::ostream* out);
void PrintTo(const Address& address, std::ostream* out) {
  *out << address.method << " " << address.path;
}

namespace {

using Json = nlohmann::json;

/// A name that the fake studio knows, for every star.
std::string filled(const Address& address) {
  const std::string path = address.path;
  const std::string name = path.starts_with("fixtures")  ? "key"
                           : path.starts_with("masters") ? "grand"
                           : path.starts_with("moods")   ? "window"
                                                         : "3";
  std::string out = "/api/v1/" + path;
  if (const auto star = out.find('*'); star != std::string::npos) out.replace(star, 1, name);
  return out;
}

class EveryRoute : public testing::TestWithParam<Address> {
 protected:
  Response ask(const std::string& method, const std::string& body) {
    Request request;
    request.method = method;
    request.path = filled(GetParam());
    request.body = body;
    Response given;
    answer(request, brain_, [&](Response response) { given = std::move(response); });
    return given;
  }
  bool takes_json() const { return *GetParam().example != '\0'; }
  static Json error_of(const Response& response) {
    const Json error = Json::parse(response.body).value("error", Json::object());
    EXPECT_FALSE(error.value("what", "").empty()) << response.body;
    EXPECT_FALSE(error.value("remedy", "").empty()) << response.body;
    return error;
  }
  support::FakeBrain brain_;
};

TEST_P(EveryRoute, TakesItsOwnExample) {
  if (std::string(GetParam().path) == "moods") return;  // a form: the next test
  const Response response = ask(GetParam().method, GetParam().example);
  EXPECT_LT(response.status, 300) << response.body;
  EXPECT_EQ(brain_.gestures.size(), 1u);
}

TEST_P(EveryRoute, RefusesAFieldThatItDoesNotKnowAndChangesNothing) {
  if (!takes_json()) return;
  Json body = Json::parse(GetParam().example);
  body["no_such_field"] = 1;
  const Response response = ask(GetParam().method, body.dump());
  EXPECT_EQ(response.status, 400) << response.body;
  error_of(response);
  EXPECT_TRUE(brain_.gestures.empty());
}

TEST_P(EveryRoute, RefusesABodyThatIsNoObject) {
  if (!takes_json()) return;
  for (const char* body : {"[1]", "{\"a\":", "7"}) {
    const Response response = ask(GetParam().method, body);
    EXPECT_EQ(response.status, 400) << response.body;
    error_of(response);
  }
  EXPECT_TRUE(brain_.gestures.empty());
}

TEST_P(EveryRoute, RefusesEveryFieldOfTheWrongKind) {
  if (!takes_json()) return;
  const Json example = Json::parse(GetParam().example);
  for (const auto& [name, value] : example.items()) {
    Json body = example;
    body[name] = Json::array({Json::array()});
    const Response response = ask(GetParam().method, body.dump());
    EXPECT_GE(response.status, 400) << name << ": " << response.body;
    EXPECT_LT(response.status, 500) << name << ": " << response.body;
    error_of(response);
  }
  EXPECT_TRUE(brain_.gestures.empty());
}

TEST_P(EveryRoute, AnswersAMethodThatItDoesNotTakeWithThoseThatItDoes) {
  const Response response = ask("PATCH", "{}");
  EXPECT_EQ(response.status, 405);
  EXPECT_NE(error_of(response).value("remedy", "").find(GetParam().method), std::string::npos);
}

TEST_P(EveryRoute, IsListedForWhoeverAsksWhatThereIs) {
  Request request;
  request.path = "/api/v1";
  Response given;
  answer(request, brain_, [&](Response response) { given = std::move(response); });
  ASSERT_EQ(given.status, 200);
  bool listed = false;
  const Json all = Json::parse(given.body);
  for (const Json& address : all.at("addresses"))
    listed = listed || (address.at("method") == GetParam().method &&
                        address.at("path") == std::string("/api/v1/") + GetParam().path);
  EXPECT_TRUE(listed);
  EXPECT_FALSE(std::string(GetParam().what).empty());
}

INSTANTIATE_TEST_SUITE_P(All, EveryRoute, testing::ValuesIn(addresses().begin(), addresses().end()),
                         [](const auto& route) {
                           std::string name;
                           for (const char c : std::string(route.param.method) + route.param.path)
                             if (std::isalnum(static_cast<unsigned char>(c))) name += c;
                           return name;
                         });

TEST(Routes, ASendableFormKeepsAPictureOfOnesOwn) {
  support::FakeBrain brain;
  Request request;
  request.method = "POST";
  request.path = "/api/v1/moods";
  request.headers["content-type"] = "multipart/form-data; boundary=x";
  const auto form = [](const std::string& picture) {
    return "--x\r\nContent-Disposition: form-data; name=\"title\"\r\n\r\nAnna, window\r\n"
           "--x\r\nContent-Disposition: form-data; name=\"picture\"\r\n\r\n" +
           picture + "\r\n--x--\r\n";
  };
  request.body = form(support::small_png());
  Response given;
  answer(request, brain, [&](Response response) { given = std::move(response); });
  ASSERT_EQ(brain.gestures.size(), 1u) << given.body;
  const auto& mood = std::get<AddMood>(brain.gestures[0]);
  EXPECT_EQ(mood.name, "anna-window");
  EXPECT_EQ(mood.title, "Anna, window");
  brain.gestures.clear();
  request.body = form("this is no picture");
  answer(request, brain, [&](Response response) { given = std::move(response); });
  EXPECT_EQ(given.status, 422) << given.body;
  EXPECT_TRUE(brain.gestures.empty());
}

}  // namespace
}  // namespace chiaro::panel
