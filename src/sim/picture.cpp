// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/picture.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "lio/base/angle.hpp"
#include "lio/io/input_error.hpp"
#include "lio/sim/random.hpp"
#include "lio/sim/scene.hpp"

namespace lio::sim {
namespace {

constexpr float kFar_m = 4000.0f;
constexpr float kOff_m = 0.03f;     // secondary rays start this far off the surface
constexpr float kOpenSky_m = 6.0f;  // surfaces nearer than this shade others from the sky
constexpr int kSkyRays = 4;
constexpr double kMargin = 1.12;  // factor on the path's extent

using Colour = Eigen::Array3f;

// Holds an orthographic camera.
struct Camera {
  Vector3 centre;
  Vector3 right;
  Vector3 up;
  Vector3 into;  // view direction
  double pixel_m = 0.1;
  double cut_z = 400.0;  // above the origin; everything higher is left out
  Vector2 cut_slope = Vector2::Zero();

  Eigen::Vector2d Project(const Vector3& p, int width, int height) const {
    const Vector3 d = p - centre;
    return {0.5 * width + d.dot(right) / pixel_m, 0.5 * height - d.dot(up) / pixel_m};
  }
  double DistanceToCut(const Vector3& p, const Vector3& direction) const {
    const double above = cut_z + cut_slope.dot(p.head<2>()) - p.z();
    return above / (direction.z() - cut_slope.dot(direction.head<2>()));
  }
};

std::vector<Vector3> WayPoints(const Scenario& scenario) {
  std::vector<Vector3> points;
  for (double t = 0.0; t <= scenario.duration_s; t += 0.1) {
    Vector3 p = scenario.trajectory->BodyPoseAt(scenario.begin_s + t).translation;
    p.z() += 1.0;
    points.push_back(p);
  }
  return points;
}

// Returns the largest extent along an axis of the world.
double Extent(const std::vector<Vector3>& way) {
  Vector3 low = way.front();
  Vector3 high = way.front();
  for (const Vector3& p : way) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

Camera MakeCamera(const Scenario& scenario, const std::vector<Vector3>& way,
                  const PictureOptions& options) {
  Camera camera;
  const double azimuth = kRadPerDeg * options.azimuth_deg;
  const double elevation = kRadPerDeg * options.elevation_deg;
  const Vector3 out(std::cos(elevation) * std::cos(azimuth),
                    std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  camera.into = -out;
  camera.right = Vector3(-std::sin(azimuth), std::cos(azimuth), 0.0);
  camera.up = out.cross(camera.right);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high = -low;
  const Vector3& now =
      way[static_cast<std::size_t>(scenario.view_share * static_cast<double>(way.size() - 1))];
  const double reach_m = Extent(way) < scenario.view_width_m ? 1e9 : 0.5 * scenario.view_width_m;
  double top_z = -1e9;
  for (const Vector3& p : way) {
    if ((p - now).norm() > reach_m) continue;
    const Eigen::Vector2d q(p.dot(camera.right), p.dot(camera.up));
    low = low.cwiseMin(q);
    high = high.cwiseMax(q);
    top_z = std::max(top_z, p.z() - scenario.ceiling_slope_ratio.dot(p.head<2>()));
  }
  const Eigen::Vector2d extent = (high - low).cwiseMax(Eigen::Vector2d(50.0, 36.0));
  camera.pixel_m = kMargin * std::max(extent.x() / options.width, extent.y() / options.height);
  const Eigen::Vector2d middle = 0.5 * (low + high);
  camera.centre = middle.x() * camera.right + middle.y() * camera.up;
  if (scenario.ceiling_m < 1e6) {
    camera.cut_z = top_z + scenario.ceiling_m;
    camera.cut_slope = scenario.ceiling_slope_ratio;
  }
  return camera;
}

// Computes the colours of the surfaces that rays hit, many at a time.
class Painter {
 public:
  Painter(const Scene::Interval& interval, const Camera& camera)
      : interval_(interval), camera_(camera) {}

  std::vector<Colour> Paint(const std::vector<Ray>& rays, std::uint64_t key) const {
    std::vector<Hit> hits(rays.size());
    interval_.Cast(rays, kFar_m, hits);
    std::vector<Vector3f> places(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const float range_m = hits[i].object == Hit::kNothing ? 0.0f : hits[i].range_m - kOff_m;
      places[i] = rays[i].origin_m + range_m * rays[i].direction;
    }
    const std::vector<Vector3f> to_sun(rays.size(), Vector3f(-0.45f, -0.35f, 0.82f).normalized());
    const std::vector<float> sun = Lit(places, to_sun, kFar_m);
    std::vector<float> sky(rays.size(), 0.0f);
    Random random(key, Purpose::kWorld);
    for (int k = 0; k < kSkyRays; ++k) {
      std::vector<Vector3f> up(rays.size());
      for (Vector3f& direction : up) direction = SkyDirection(random);
      const std::vector<float> lit = Lit(places, up, kOpenSky_m);
      for (std::size_t i = 0; i < sky.size(); ++i) sky[i] += lit[i] / kSkyRays;
    }
    std::vector<Colour> colours(rays.size(), Colour(0.90f, 0.92f, 0.94f));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].object == Hit::kNothing) continue;
      const auto& rgb = TraitsOf(hits[i].material).colour;
      const float light =
          (0.55f + 0.45f * hits[i].cos_incidence) * (0.22f + 0.42f * sky[i] + 0.46f * sun[i]);
      colours[i] = light * Colour(rgb[0], rgb[1], rgb[2]);
    }
    return colours;
  }

  // Returns true when nothing in the scene, up to the cut, lies between a point and the viewer.
  bool IsVisible(const Vector3& p) const {
    const Vector3f place = p.cast<float>();
    return Lit({place}, {(-camera_.into).cast<float>()}, kFar_m).front() > 0.5f;
  }

 private:
  static Vector3f SkyDirection(Random& random) {
    const double z = random.Uniform(0.25, 1.0);
    const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
    const double r = std::sqrt(1.0 - z * z);
    return Vector3(r * std::cos(angle), r * std::sin(angle), z).cast<float>();
  }

  // Returns 1 for each place from which nothing, up to the cut through the building, blocks the
  // ray.
  std::vector<float> Lit(const std::vector<Vector3f>& places,
                         const std::vector<Vector3f>& directions, float reach_m) const {
    std::vector<Ray> rays(places.size());
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i] = {places[i], directions[i], 0.5f};
    std::vector<Hit> hits(rays.size());
    interval_.Cast(rays, reach_m, hits);
    std::vector<float> lit(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool beyond_cut = hits[i].range_m > camera_.DistanceToCut(places[i].cast<double>(),
                                                                      directions[i].cast<double>());
      lit[i] = hits[i].object == Hit::kNothing || beyond_cut ? 1.0f : 0.0f;
    }
    return lit;
  }

  const Scene::Interval& interval_;
  const Camera& camera_;
};

std::uint8_t ToByte(float value) {
  return static_cast<std::uint8_t>(255.0f * std::clamp(std::pow(value, 0.85f), 0.0f, 1.0f));
}

void DrawDisc(Picture& picture, const Eigen::Vector2d& at, double radius,
              const std::array<std::uint8_t, 3>& rgb) {
  const int reach = static_cast<int>(std::ceil(radius));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const int x = static_cast<int>(at.x()) + dx;
      const int y = static_cast<int>(at.y()) + dy;
      if (dx * dx + dy * dy > radius * radius || x < 0 || y < 0 || x >= picture.width ||
          y >= picture.height) {
        continue;
      }
      std::copy(rgb.begin(), rgb.end(),
                picture.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + x));
    }
  }
}

// The path is dotted where something hides it.
void DrawWay(Picture& picture, const Camera& camera, const Painter& painter,
             const std::vector<Vector3>& way) {
  const auto project = [&](const Vector3& p) {
    return camera.Project(p, picture.width, picture.height);
  };
  const double thick = std::max(1.2, picture.width / 560.0);
  double drawn = 0.0;  // length in pixels, for the dots
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const Eigen::Vector2d a = project(way[i]);
    const Eigen::Vector2d b = project(way[i + 1]);
    const bool visible = painter.IsVisible(way[i] + Vector3(0.0, 0.0, 1.2));
    const int steps = 1 + static_cast<int>((b - a).norm());
    for (int k = 0; k < steps; ++k) {
      drawn += (b - a).norm() / steps;
      if (visible || std::fmod(drawn, 8.0 * thick) < 3.0 * thick) {
        DrawDisc(picture, a + (b - a) * k / steps, visible ? thick : 0.8 * thick, {226, 62, 40});
      }
    }
  }
  const auto mark = [&](const Vector3& p, const std::array<std::uint8_t, 3>& rgb) {
    DrawDisc(picture, project(p), 3.4 * thick, {20, 20, 20});
    DrawDisc(picture, project(p), 2.6 * thick, rgb);
  };
  mark(way.back(), {226, 62, 40});
  mark(way.front(), {80, 200, 90});
}

}  // namespace

Picture DrawFromAbove(const Scenario& scenario, const PictureOptions& options, int num_threads) {
  const std::vector<Vector3> way = WayPoints(scenario);
  const Camera camera = MakeCamera(scenario, way, options);
  const double seen_m = camera.pixel_m * (options.width + options.height);
  const Scene scene(scenario.world, 2.0 * seen_m);
  const double now_s = scenario.begin_s + scenario.view_share * scenario.duration_s;
  const Vector3 place = scenario.trajectory->At(now_s).T_world_imu.translation;
  const Scene::Interval interval = scene.During(now_s - 0.005, now_s + 0.005, place);
  const Painter painter(interval, camera);
  Picture picture{options.width, options.height, {}};
  picture.rgb.resize(static_cast<std::size_t>(3 * options.width * options.height));
  const int num_samples = options.samples * options.samples;
  const auto draw_row = [&](int y) {
    std::vector<Ray> rays;
    for (int x = 0; x < options.width; ++x) {
      for (int s = 0; s < num_samples; ++s) {
        const double dx = x + (s % options.samples + 0.5) / options.samples - 0.5 * options.width;
        const double row = std::floor(static_cast<double>(s) / options.samples);
        const double dy = y + (row + 0.5) / options.samples - 0.5 * options.height;
        Vector3 origin = camera.centre + camera.pixel_m * (dx * camera.right - dy * camera.up);
        origin += camera.DistanceToCut(origin, camera.into) * camera.into;
        rays.push_back({origin.cast<float>(), camera.into.cast<float>(), 0.5f});
      }
    }
    const std::vector<Colour> colours = painter.Paint(rays, static_cast<std::uint64_t>(y));
    for (int x = 0; x < options.width; ++x) {
      Colour mean = Colour::Zero();
      for (int s = 0; s < num_samples; ++s) {
        mean += colours[static_cast<std::size_t>(x * num_samples + s)] /
                static_cast<float>(num_samples);
      }
      for (int c = 0; c < 3; ++c) {
        picture.rgb[static_cast<std::size_t>(3 * (y * options.width + x) + c)] = ToByte(mean[c]);
      }
    }
  };
  tbb::task_arena arena(num_threads);
  arena.execute([&] { tbb::parallel_for(0, options.height, draw_row); });
  DrawWay(picture, camera, painter, way);
  return picture;
}

void WritePpm(const Picture& picture, const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  if (!file) throw OutputError("cannot write " + path.string());
  file << "P6\n" << picture.width << ' ' << picture.height << "\n255\n";
  file.write(reinterpret_cast<const char*>(picture.rgb.data()),
             static_cast<std::streamsize>(picture.rgb.size()));
  file.close();
  if (!file) throw WriteError("cannot write " + path.string() + " in full: is the disk full?");
}

}  // namespace lio::sim
