// SPDX-License-Identifier: Apache-2.0
// Subjects and a photograph that nobody here made.
#include <fstream>

#include "controller/core/picture_file.h"
#include "tests/end_to_end/stage.h"

namespace chiaro::end_to_end {
namespace {

double mean_luminance(const core::EncodedPicture& picture) {
  double sum = 0;
  for (const float y : core::luminance(core::linear(picture)).values) sum += y;
  return sum / static_cast<double>(picture.size.pixels());
}

class RealInput : public EndToEnd {
 protected:
  /// Designs for that mesh and expects a whole look: verdict, look.json, a picture with light in.
  void expect_a_look(const std::string& mesh, const std::string& height,
                     const std::vector<std::string>& aim) {
    const auto studio = write_studio(
        {{"mesh: subjects/bust.ply", "mesh: " + asset(mesh)},
         {"height: 0.62 m ", "height: " + height + " "},
         {"  material: {diffuse: [0.62, 0.48, 0.40], specular: 0.12, shininess: 24}\n", ""}});
    const auto look = folder_.path() / "look.json", picture = folder_.path() / "look.png";
    std::vector<std::string> words{"design",      studio.string(), "--out",
                                   look.string(), "--picture",     picture.string(),
                                   "--trials",    "200",           "--json"};
    words.insert(words.end(), aim.begin(), aim.end());
    const auto done = chiaro(words);
    ASSERT_EQ(done.exit, 0) << done.err;
    const auto said = Json::parse(done.out, nullptr, false);
    ASSERT_TRUE(said.is_object()) << done.out;
    const auto written = Json::parse(content_of(look), nullptr, false);
    ASSERT_TRUE(written.is_object());
    const auto verdict = written.dump();
    EXPECT_NE(verdict.find("\"verdict\""), std::string::npos) << verdict;
    const auto drawn = core::read_picture(picture);
    ASSERT_TRUE(drawn) << core::to_string(drawn.problems());
    EXPECT_GT(mean_luminance(*drawn), 0.005);
  }
};

TEST_F(RealInput, ABunnyIsLitLikeAPhotograph) {
  expect_a_look("bunny.obj", "0.55 m", {"--exemplar", asset("astronaut.png")});
}

TEST_F(RealInput, ATexturedPersonIsLitLikeAMood) {
  expect_a_look("scopia/mannequinMale/mannequinMale.obj", "1.75 m", {"--mood", "rembrandt"});
}

TEST_F(RealInput, ATexturedPersonIsLitLikeAPhotographPerceptually) {
  expect_a_look("scopia/mannequinBrunette/mannequinBrunette.obj", "1.7 m",
                {"--exemplar", asset("astronaut.png"), "--goal", "perceptual"});
}

TEST_F(RealInput, ACutMeshIsAProblemWithItsFileAndExitCode1) {
  const auto whole = content_of(asset("horse.3ds"));
  const auto cut = folder_.path() / "cut.3ds";
  std::ofstream(cut, std::ios::binary) << whole.substr(0, 40);
  const auto studio = write_studio({{"mesh: subjects/bust.ply", "mesh: " + cut.string()}});
  const auto done = chiaro({"design", studio.string(), "--mood", "rembrandt", "--trials", "10"});
  EXPECT_EQ(done.exit, 1);
  EXPECT_NE(done.err.find("cut.3ds"), std::string::npos) << done.err;
}

}  // namespace
}  // namespace chiaro::end_to_end
