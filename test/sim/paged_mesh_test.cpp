// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/paged_mesh.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "lio/io/input_error.hpp"

namespace lio::sim {
namespace {

constexpr int kNumPosts = 25;

// A row of posts, 3 m from one to the next, each of another material than its neighbours.
PagedMesh Row(std::size_t page_triangles) {
  PagedMesh row(page_triangles);
  for (int i = 0; i < kNumPosts; ++i) {
    AddBox(row.page(), UprightPose({3.0 * i, 0.0, 0.0}, 0.1 * i), {0.2, 0.2, 2.0},
           static_cast<Material>(i));
  }
  return row;
}

void ExpectSame(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.vertices_m, b.vertices_m);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.materials, b.materials);
}

TEST(PagedMesh, IsTheSameWholeForEveryPageSize) {
  const PagedMesh in_memory = Row(10'000);
  const Mesh whole = in_memory.Whole();
  EXPECT_EQ(whole.triangles.size(), 12u * kNumPosts);
  EXPECT_EQ(whole.materials.back(), static_cast<Material>(kNumPosts - 1));
  for (const std::size_t page_triangles : {1u, 12u, 13u, 100u}) {
    SCOPED_TRACE(page_triangles);
    const PagedMesh row = Row(page_triangles);
    EXPECT_EQ(row.num_triangles(), whole.triangles.size());
    ExpectSame(row.Whole(), whole);
  }
}

TEST(PagedMesh, ShowsTheSamePartForEveryPageSize) {
  const Eigen::AlignedBox2f box(Eigen::Vector2f(14, -1), Eigen::Vector2f(25, 1));
  const Mesh part = Row(10'000).Around(box);
  EXPECT_EQ(part.triangles.size(), 12u * 4) << "the posts at 15, 18, 21 and 24 m";
  ExpectSame(Row(20).Around(box), part);
  const Eigen::AlignedBox2f nowhere(Eigen::Vector2f(14, 5), Eigen::Vector2f(25, 6));
  EXPECT_TRUE(Row(20).Around(nowhere).triangles.empty());
}

TEST(PagedMesh, GrowsOnAfterItWasRead) {
  PagedMesh row = Row(20);
  const std::size_t before = row.Whole().triangles.size();
  AddBox(row.page(), UprightPose({-3.0, 0.0, 0.0}, 0.0), {1, 1, 1}, Material::kRetro);
  const Mesh whole = row.Whole();
  EXPECT_EQ(whole.triangles.size(), before + 12);
  EXPECT_EQ(whole.materials.back(), Material::kRetro);
}

// As on a full disk.
TEST(PagedMeshDeathTest, SaysThatTheFileCannotBeWritten) {
  const auto fill = [] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit tiny{.rlim_cur = 1000, .rlim_max = 1000};
    setrlimit(RLIMIT_FSIZE, &tiny);
    try {
      (void)Row(20);
    } catch (const WriteError& error) {
      std::fputs(error.what(), stderr);
      std::_Exit(0);
    }
    std::_Exit(2);
  };
  EXPECT_EXIT(fill(), testing::ExitedWithCode(0),
              "simulated world cannot be written in full: .*: File too large; TMPDIR");
}

}  // namespace
}  // namespace lio::sim
