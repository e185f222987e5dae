// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/paged_mesh.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "sim/mesh_part.hpp"

namespace lio::sim {
namespace {

[[noreturn]] void Fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

template <typename Item>
void Write(std::FILE* file, const std::vector<Item>& items) {
  if (std::fwrite(items.data(), sizeof(Item), items.size(), file) != items.size()) {
    Fail("the simulated world cannot be written to a temporary file");
  }
}

// Reads from a place in the file without moving the position that other threads share.
template <typename Item>
void Read(std::FILE* file, std::int64_t& at_bytes, std::vector<Item>& items) {
  auto* to = reinterpret_cast<char*>(items.data());
  std::size_t left = items.size() * sizeof(Item);
  while (left > 0) {
    const ssize_t num = ::pread(fileno(file), to, left, at_bytes);
    if (num <= 0) Fail("the simulated world cannot be read from its temporary file");
    to += num;
    left -= static_cast<std::size_t>(num);
    at_bytes += num;
  }
}

Eigen::AlignedBox2f BoundsOf(const Mesh& mesh) {
  Eigen::AlignedBox2f bounds;
  for (const Vector3f& vertex : mesh.vertices_m) bounds.extend(vertex.head<2>());
  return bounds;
}

void Append(Mesh& mesh, const Mesh& part) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.insert(mesh.vertices_m.end(), part.vertices_m.begin(), part.vertices_m.end());
  for (const auto& t : part.triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  mesh.materials.insert(mesh.materials.end(), part.materials.begin(), part.materials.end());
}

}  // namespace

Mesh& PagedMesh::page() {
  if (page_.triangles.size() >= page_triangles_) StorePage();
  return page_;
}

std::size_t PagedMesh::num_triangles() const {
  return num_stored_triangles_ + page_.triangles.size();
}

void PagedMesh::StorePage() {
  if (!file_) file_.reset(std::tmpfile());
  if (!file_) Fail("no temporary file can be made for the simulated world");
  const std::int64_t begin_bytes = std::ftell(file_.get());
  Write(file_.get(), page_.vertices_m);
  Write(file_.get(), page_.triangles);
  Write(file_.get(), page_.materials);
  if (std::fflush(file_.get()) != 0) {
    Fail("the simulated world cannot be written to a temporary file");
  }
  stored_.push_back(
      {begin_bytes, page_.vertices_m.size(), page_.triangles.size(), BoundsOf(page_)});
  num_stored_triangles_ += page_.triangles.size();
  page_.vertices_m.clear();
  page_.triangles.clear();
  page_.materials.clear();
}

Mesh PagedMesh::Load(const Stored& stored) const {
  Mesh mesh;
  mesh.vertices_m.resize(stored.num_vertices);
  mesh.triangles.resize(stored.num_triangles);
  mesh.materials.resize(stored.num_triangles);
  std::int64_t at_bytes = stored.begin_bytes;
  Read(file_.get(), at_bytes, mesh.vertices_m);
  Read(file_.get(), at_bytes, mesh.triangles);
  Read(file_.get(), at_bytes, mesh.materials);
  return mesh;
}

Mesh PagedMesh::Whole() const {
  Mesh whole;
  for (const Stored& stored : stored_) Append(whole, Load(stored));
  Append(whole, page_);
  return whole;
}

Mesh PagedMesh::Around(const Eigen::AlignedBox2f& box_m) const {
  Mesh part;
  for (const Stored& stored : stored_) {
    if (box_m.intersects(stored.bounds_m)) AddPartOf(Load(stored), box_m, part);
  }
  AddPartOf(page_, box_m, part);
  return part;
}

}  // namespace lio::sim
