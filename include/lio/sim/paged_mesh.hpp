// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds a mesh of any size in little memory: all but the last page of triangles lies in a file in
// the folder for temporary ones (TMPDIR), which has no name and is gone with the process.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "lio/sim/mesh.hpp"

namespace lio::sim {

class PagedMesh {
 public:
  static constexpr std::size_t kPageTriangles = 1 << 17;  // some 5 MB

  explicit PagedMesh(std::size_t page_triangles = kPageTriangles)
      : page_triangles_(page_triangles) {}

  // Returns the page that is being filled: append to it. Ask for it anew for each thing that is
  // added, because a page that is full goes to the file then. Throws WriteError (input_error.hpp)
  // when that cannot be written.
  Mesh& page();

  [[nodiscard]] std::size_t num_triangles() const;

  // Returns all triangles, in the order in which they were added. These and the next one are safe
  // from any thread and throw WriteError when the file cannot be read.
  [[nodiscard]] Mesh Whole() const;
  // Returns the triangles whose bounds in x and y meet `box_m`, in that order, and their vertices.
  [[nodiscard]] Mesh Around(const Eigen::AlignedBox2f& box_m) const;

 private:
  // Describes a page that lies in the file: vertices, triangles and materials one after the other.
  struct Stored {
    std::int64_t begin_bytes = 0;
    std::size_t num_vertices = 0;
    std::size_t num_triangles = 0;
    Eigen::AlignedBox2f bounds_m;
  };
  struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void StorePage();
  [[nodiscard]] Mesh Load(const Stored& stored) const;

  std::size_t page_triangles_;
  Mesh page_;
  std::vector<Stored> stored_;
  std::size_t num_stored_triangles_ = 0;
  std::int64_t num_bytes_ = 0;  // in the file
  std::unique_ptr<std::FILE, FileCloser> file_;
};

}  // namespace lio::sim
