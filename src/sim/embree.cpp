// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/embree.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace lio::sim {
namespace {

// Embree casts with the instructions that every x86-64 processor has, so that the last bits of
// ranges do not depend on the processor.
#if defined(__x86_64__)
constexpr const char* kConfiguration = "isa=sse2";
#else
constexpr const char* kConfiguration = "";
#endif

}  // namespace

DevicePtr MakeDevice() {
  DevicePtr device(rtcNewDevice(kConfiguration));
  if (!device) {
    throw std::runtime_error("Embree cannot start: error " +
                             std::to_string(rtcGetDeviceError(nullptr)));
  }
  return device;
}

void Commit(RTCScene scene) {
  tbb::task_arena(1).execute([scene] { rtcCommitScene(scene); });
}

ScenePtr MakeMeshScene(RTCDevice device, const Mesh& mesh) {
  ScenePtr scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  if (!mesh.triangles.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Vector3f), mesh.vertices_m.size());
    std::copy(mesh.vertices_m.begin(), mesh.vertices_m.end(), static_cast<Vector3f*>(vertices));
    using Triangle = std::array<std::uint32_t, 3>;
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(Triangle), mesh.triangles.size());
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<Triangle*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
  }
  Commit(scene.get());
  return scene;
}

}  // namespace lio::sim
