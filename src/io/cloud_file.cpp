// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "cloud_file.hpp"

#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <bit>
#include <fstream>
#include <string>

#include "io/pcd_check.hpp"
#include "io/ply_check.hpp"
#include "lio/io/output_file.hpp"

namespace lio {
namespace {

// PCL prints several lines for a damaged file and goes on; the error of ours is one line.
class QuietPcl {
 public:
  QuietPcl() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~QuietPcl() { pcl::console::setVerbosityLevel(before_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  pcl::console::VERBOSITY_LEVEL before_ = pcl::console::getVerbosityLevel();
};

}  // namespace

// The first word tells: both kinds of files begin with text.
CloudKind KindOfCloud(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string word;
  file >> word;
  if (word == "ply") return CloudKind::kPly;
  const bool is_pcd = word == "VERSION" || (word == "#" && (file >> word) && word == ".PCD");
  return is_pcd ? CloudKind::kPcd : CloudKind::kOther;
}

std::optional<pcl::PCLPointCloud2> ReadCloud(const std::filesystem::path& path, CloudKind kind) {
  // PCL's reader breaks down over text that is no header of a cloud.
  if (kind == CloudKind::kOther || KindOfCloud(path) != kind) return std::nullopt;
  if (!(kind == CloudKind::kPcd ? IsSoundPcd(path) : IsSoundPly(path))) return std::nullopt;
  const QuietPcl quiet;
  pcl::PCLPointCloud2 cloud;
  try {
    const int failed = kind == CloudKind::kPcd ? pcl::PCDReader().read(path.string(), cloud)
                                               : pcl::PLYReader().read(path.string(), cloud);
    if (failed == 0) return cloud;
  } catch (const std::exception&) {
    // The caller says what is wrong.
  }
  return std::nullopt;
}

std::vector<Eigen::Vector3f> PointsOf(const pcl::PCLPointCloud2& cloud) {
  std::vector<Eigen::Vector3f> points;
  if (cloud.data.empty()) return points;  // PCL's conversion takes the address of the first point
  pcl::PointCloud<pcl::PointXYZ> converted;
  pcl::fromPCLPointCloud2(cloud, converted);
  points.reserve(converted.size());
  for (const pcl::PointXYZ& p : converted) points.emplace_back(p.x, p.y, p.z);
  return points;
}

void WriteCloud(const std::filesystem::path& path, const std::string& header,
                std::span<const Eigen::Vector3f> points) {
  static_assert(std::endian::native == std::endian::little);
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  OutputFile file(path);
  file.Write(header);
  for (const Eigen::Vector3f& point : points) {
    file.Write({reinterpret_cast<const char*>(point.data()), sizeof point});
  }
  file.Close();
}

}  // namespace lio
