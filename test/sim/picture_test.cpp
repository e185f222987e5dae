// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/temp_dir.hpp"

namespace lio::sim {
namespace {

Picture Draw(int threads) {
  ScenarioOptions options;
  options.duration_s = 10.0;
  PictureOptions small;
  small.width = 90;
  small.height = 60;
  small.samples = 1;
  return DrawFromAbove(MakeScenario("hall", options), small, threads);
}

TEST(Picture, IsTheSameOnAnyNumberOfThreads) {
  EXPECT_EQ(Draw(1).rgb, Draw(2).rgb);
}

TEST(Picture, ShowsTheCourtAndTheWay) {
  const Picture picture = Draw(1);
  int num_court = 0;
  int num_way = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    const int r = picture.rgb[i];
    const int g = picture.rgb[i + 1];
    const int b = picture.rgb[i + 2];
    num_court += r > 120 && r > g + 20 && g > b + 20 ? 1 : 0;
    num_way += r == 226 && g == 62 && b == 40 ? 1 : 0;
  }
  EXPECT_GT(num_court, 90 * 60 / 6);
  EXPECT_GT(num_way, 5);
}

TEST(Picture, IsWrittenAsPpm) {
  const test::TempDir dir;
  const Picture picture{2, 1, {1, 2, 3, 4, 5, 6}};
  WritePpm(picture, dir.path() / "a.ppm");
  EXPECT_EQ(test::ReadText(dir.path() / "a.ppm"), std::string("P6\n2 1\n255\n\1\2\3\4\5\6"));
  EXPECT_THROW(WritePpm(picture, dir.path() / "no" / "a.ppm"), std::runtime_error);
}

}  // namespace
}  // namespace lio::sim
