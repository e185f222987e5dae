// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds Embree's handles and makes scenes of triangles.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>

#include "lio/sim/mesh.hpp"

namespace lio::sim {

struct DeviceDeleter {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePtr = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter>;
using ScenePtr = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneDeleter>;

// Throws std::runtime_error when Embree cannot start.
[[nodiscard]] DevicePtr MakeDevice();

// Builds the scene's tree by the calling thread alone, so that the tree, and with it the choice
// between equally near hits, does not depend on the number of threads. Embree's own option for
// that, threads=1, would hold all of TBB to one thread as long as the device lives.
void Commit(RTCScene scene);

// Returns a scene of these triangles, ready to cast into; its triangles have the mesh's numbers.
[[nodiscard]] ScenePtr MakeMeshScene(RTCDevice device, const Mesh& mesh);

}  // namespace lio::sim
