// SPDX-License-Identifier: Apache-2.0
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "controller/core/picture_file.h"
#include "tests/end_to_end/stage.h"

namespace chiaro::end_to_end {
namespace {

class DemoCommand : public EndToEnd {};

TEST_F(DemoCommand, OnceMakesOneLookAndLeavesItsPicture) {
  const auto picture = folder_.path() / "once.png";
  const auto running = demo(
      write_studio(), {"--once", "--mood", "rembrandt", "--picture", picture.string(), "--json"});
  ASSERT_EQ(running->wait(), 0) << running->err();
  const auto said = Json::parse(running->out(), nullptr, false);
  ASSERT_TRUE(said.is_object()) << running->out();
  EXPECT_EQ(said.value("mood", ""), "rembrandt");
  EXPECT_FALSE(said.value("verdict", "").empty());
  EXPECT_EQ(said["lamps"].size(), 4u);
  const auto drawn = core::read_picture(picture);
  ASSERT_TRUE(drawn) << core::to_string(drawn.problems());
  EXPECT_EQ(drawn->size.height, 480);
  EXPECT_GT(drawn->size.width, 3 * 300);
  // Lamps that are a few per cent off their data sheets: near the preview, not equal.
  EXPECT_GT(said.value("camera_from_preview_lightness", 0.0), 0.01);
  EXPECT_LT(said.value("camera_from_preview_lightness", 100.0), 6.0);
}

TEST_F(DemoCommand, AnUnknownMoodIsRefusedWithTheNearestName) {
  const auto running = demo(write_studio(), {"--once", "--mood", "rembrant"});
  EXPECT_NE(running->wait(), 0);
  EXPECT_NE(running->err().find("rembrandt"), std::string::npos) << running->err();
}

TEST_F(DemoCommand, APortInUseIsSaidPlainlyAndLeavesNothingRunning) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(panel_port_);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(::listen(socket, 1), 0);
  const auto running = demo(write_studio(), {"--once"});
  EXPECT_EQ(running->wait(), 3);
  const auto words = running->err();
  EXPECT_NE(words.find("port " + std::to_string(panel_port_)), std::string::npos) << words;
  EXPECT_NE(words.find("--port"), std::string::npos) << words;
  ::close(socket);
}

TEST_F(DemoCommand, ABrokenStudioFileIsExitCode1WithEveryProblem) {
  const auto studio =
      write_studio({{"azimuth: 40 deg", "azimuth: 40"}, {"role: back", "role: bakc"}});
  const auto running = demo(studio, {"--once"});
  EXPECT_EQ(running->wait(), 1);
  EXPECT_NE(running->err().find("bakc"), std::string::npos) << running->err();
}

}  // namespace
}  // namespace chiaro::end_to_end
