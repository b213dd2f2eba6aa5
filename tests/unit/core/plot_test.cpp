// SPDX-License-Identifier: Apache-2.0
#include "controller/core/plot.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace chiaro::core {
namespace {

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

Plot two_curves() {
  Plot plot{"Convergence", {"trial"}, {"cost"}};
  plot.series = {{"sbplx", {0, 10, 20}, {3, 2, 1}}, {"annealing", {0, 10, 20}, {3, 2.5, 2}}};
  return plot;
}

TEST(Plot, NamesItsAxesAndItsCurves) {
  const std::string svg = to_svg(two_curves());
  for (const char* word : {"Convergence", ">trial<", ">cost<", ">sbplx<", ">annealing<", ">10<"})
    EXPECT_NE(svg.find(word), std::string::npos) << word;
  EXPECT_EQ(count(svg, "<path"), 2u);
}

TEST(Plot, EscapesWhatWouldBreakTheFile) {
  Plot plot = two_curves();
  plot.title = "a < b & \"c\"";
  EXPECT_NE(to_svg(plot).find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
}

TEST(Plot, LeavesOutWhatIsNotANumber) {
  Plot plot = two_curves();
  plot.series[0].y[1] = std::numeric_limits<double>::quiet_NaN();
  plot.series[1].y[2] = std::numeric_limits<double>::infinity();
  const std::string svg = to_svg(plot);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Plot, DrawsOneBarAValueAndItsErrors) {
  Plot plot{"Shares", {"judge"}, {"matched"}};
  plot.categories = {"colour", "shape"};
  plot.series = {{"wavelet", {0, 1}, {0.9, 0.8}, {0.8, 0.7}, {0.95, 0.85}, Series::Kind::bars},
                 {"perceptual", {0, 1}, {0.7, 0.6}, {}, {}, Series::Kind::bars}};
  const std::string svg = to_svg(plot);
  EXPECT_EQ(count(svg, "<rect"), 2u + 4 + 2);  // page, frame, bars, legend
  EXPECT_NE(svg.find(">shape<"), std::string::npos);
}

TEST(Plot, TakesDecadesAndOneValueAlone) {
  Plot plot{"Times", {"lights"}, {"seconds", true}};
  plot.series = {{"", {1, 2, 3}, {0.001, 0, 10}, {}, {}, Series::Kind::points}};
  const std::string svg = to_svg(plot);
  EXPECT_EQ(count(svg, "<circle"), 2u);  // 0 has no place on a logarithmic axis
  Plot one{"One", {"x"}, {"y"}};
  one.series = {{"", {5}, {5}}};
  EXPECT_EQ(to_svg(one).find("nan"), std::string::npos);
  EXPECT_EQ(to_svg(Plot{"None", {"x"}, {"y"}}).find("nan"), std::string::npos);
}

TEST(Landscape, PaintsOneCellAValueAndMarksPlaces) {
  Landscape land{"F", {"azimuth (deg)", false, -90, 90}, {"elevation (deg)", false, 0, 90}, "F", 3,
                 2};
  land.values = {0, 1, 2, 3, 4, std::numeric_limits<double>::infinity()};
  land.marks = {{0, 45, "best"}};
  const std::string svg = to_svg(land);
  EXPECT_EQ(count(svg, "#440154"), 1u);  // the least
  EXPECT_EQ(count(svg, "#fde725"), 1u);  // the most that is finite
  EXPECT_NE(svg.find(">best<"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace chiaro::core
