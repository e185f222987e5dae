// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/paged_mesh.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "lio/io/input_error.hpp"
#include "sim/mesh_part.hpp"

namespace lio::sim {
namespace {

[[noreturn]] void Fail(const std::string& what, int error) {
  throw WriteError("the simulated world cannot be " + what + ": the temporary file in " +
                   std::filesystem::temp_directory_path().string() + ": " + std::strerror(error) +
                   "; TMPDIR may name a folder with room");
}

// Returns a file without a name.
std::FILE* MakeTemporaryFile() {
  std::string path = (std::filesystem::temp_directory_path() / "lio-sim-XXXXXX").string();
  const int descriptor = mkstemp(path.data());
  if (descriptor < 0) Fail("kept", errno);
  unlink(path.c_str());
  std::FILE* file = fdopen(descriptor, "w+b");
  if (file == nullptr) Fail("kept", errno);
  return file;
}

template <typename Item>
void Write(std::FILE* file, const std::vector<Item>& items) {
  if (std::fwrite(items.data(), sizeof(Item), items.size(), file) != items.size()) {
    Fail("written in full", errno);
  }
}

// Reads from a place in the file without moving the position that other threads share.
template <typename Item>
void Read(std::FILE* file, std::int64_t& at_bytes, std::vector<Item>& items) {
  auto* to = reinterpret_cast<char*>(items.data());
  std::size_t left = items.size() * sizeof(Item);
  while (left > 0) {
    const ssize_t num = ::pread(fileno(file), to, left, at_bytes);
    if (num < 0 && errno == EINTR) continue;
    if (num <= 0) Fail("read", num < 0 ? errno : EIO);
    to += num;
    left -= static_cast<std::size_t>(num);
    at_bytes += num;
  }
}

template <typename Item>
std::int64_t BytesOf(const std::vector<Item>& items) {
  return static_cast<std::int64_t>(items.size() * sizeof(Item));
}

Eigen::AlignedBox2f BoundsOf(const Mesh& mesh) {
  Eigen::AlignedBox2f bounds;
  for (const Vector3f& vertex : mesh.vertices_m) bounds.extend(vertex.head<2>());
  return bounds;
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
  if (!file_) file_.reset(MakeTemporaryFile());
  Write(file_.get(), page_.vertices_m);
  Write(file_.get(), page_.triangles);
  Write(file_.get(), page_.materials);
  if (std::fflush(file_.get()) != 0) Fail("written in full", errno);
  stored_.push_back({num_bytes_, page_.vertices_m.size(), page_.triangles.size(), BoundsOf(page_)});
  num_bytes_ += BytesOf(page_.vertices_m) + BytesOf(page_.triangles) + BytesOf(page_.materials);
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
  for (const Stored& stored : stored_) AddMesh(whole, Load(stored), Pose{});
  AddMesh(whole, page_, Pose{});
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
