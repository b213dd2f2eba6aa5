// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/camera_server.h"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>

#include "drivers/common/http_client.h"

namespace chiaro::simulator {
namespace {

using namespace std::chrono_literals;

class CameraServerTest : public testing::Test {
 protected:
  /// Every wish is answered at once with `picture`, from a thread of its own as the camera does.
  void SetUp() override {
    CameraServer::Options options;
    options.port = 0;
    options.cameras = {"main", "side"};
    options.status = [] { return std::string("{\"frames\": 3}"); };
    options.on_wish = [this] { wished_ = true; };
    auto opened = CameraServer::open(options);
    ASSERT_TRUE(opened) << core::to_string(opened.problems());
    server_ = std::move(*opened);
    camera_ = std::thread([this] {
      while (!done_) {
        if (!wished_.exchange(false)) {
          std::this_thread::yield();
          continue;
        }
        for (const auto& wish : server_->wishes())
          server_->show(wish, "jpeg of camera " + std::to_string(wish.camera));
      }
    });
  }
  void TearDown() override {
    done_ = true;
    camera_.join();
  }
  drivers::HttpReply get(const std::string& target, const std::string& method = "GET") {
    drivers::HttpRequest request;
    request.method = method;
    request.url = "http://127.0.0.1:" + std::to_string(server_->port()) + target;
    const auto reply = drivers::http_request(request, 20s);
    return reply ? *reply : drivers::HttpReply{-1, "", core::to_string(reply.problems())};
  }

  std::unique_ptr<CameraServer> server_;
  std::atomic<bool> wished_{false}, done_{false};
  std::thread camera_;
};

TEST_F(CameraServerTest, AnswersWithAPictureOfTheCameraAskedFor) {
  const auto main = get("/camera/main"), side = get("/camera/side");
  EXPECT_EQ(main.status, 200);
  EXPECT_EQ(main.type, "image/jpeg");
  EXPECT_EQ(main.body, "jpeg of camera 0");
  EXPECT_EQ(side.body, "jpeg of camera 1");
}

TEST_F(CameraServerTest, SaysHowItIs) {
  const auto reply = get("/status");
  EXPECT_EQ(reply.type, "application/json");
  EXPECT_EQ(reply.body, "{\"frames\": 3}");
}

TEST_F(CameraServerTest, RefusesWhatIsNotThere) {
  EXPECT_EQ(get("/camera/other").status, 404);
  EXPECT_EQ(get("/").status, 404);
  EXPECT_EQ(get("/camera/main", "POST").status, 405);
}

TEST_F(CameraServerTest, APortInUseIsAProblemWithARemedy) {
  CameraServer::Options options;
  options.port = server_->port();
  const auto second = CameraServer::open(options);
  ASSERT_FALSE(second);
  EXPECT_NE(second.problems().front().what.find(std::to_string(server_->port())),
            std::string::npos);
  EXPECT_NE(second.problems().front().remedy.find("--port"), std::string::npos);
}

TEST_F(CameraServerTest, EndsWhileSomebodyStillStreams) {
  std::thread viewer([this] {
    drivers::HttpRequest request;
    request.url = "http://127.0.0.1:" + std::to_string(server_->port()) + "/camera/main/stream";
    const auto reply = drivers::http_request(request, 20s);
    EXPECT_FALSE(reply && reply->status != 200);
  });
  while (server_->wishes().empty() && !wished_) std::this_thread::yield();
  done_ = true;
  camera_.join();
  camera_ = std::thread([] {});
  server_.reset();
  viewer.join();
}

}  // namespace
}  // namespace chiaro::simulator
