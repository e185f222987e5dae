// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/file_kind.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string_view>

#include "lio/io/input_error.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

std::string FirstBytes(const fs::path& file) {
  constexpr std::size_t kLongestMagic = 16;
  std::string bytes(kLongestMagic, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

// A bag that is compressed as a whole keeps its own ending in front of that of the compressor.
bool IsCompressedBag(const fs::path& file) {
  if (file.extension() != ".zstd" && file.extension() != ".zst") return false;
  const std::string inner = file.stem().extension();
  return inner == ".mcap" || inner == ".db3" || inner == ".bag";
}

FileKind KindOfFile(const fs::path& file) {
  using namespace std::string_view_literals;
  const std::string bytes = FirstBytes(file);
  if (bytes.starts_with("\xED\xA1\xDA\x01"sv)) return FileKind::kLcmLog;
  if (bytes.starts_with("#ROSBAG V2.0"sv)) return FileKind::kRosBag;
  if (bytes.starts_with("SQLite format 3"sv)) return FileKind::kRosBag;
  if (bytes.starts_with("\x89MCAP0\r\n"sv)) return FileKind::kRosBag;
  for (const auto magic : {"\xD4\xC3\xB2\xA1"sv, "\xA1\xB2\xC3\xD4"sv, "\x4D\x3C\xB2\xA1"sv,
                           "\xA1\xB2\x3C\x4D"sv, "\x0A\x0D\x0D\x0A"sv}) {
    if (bytes.starts_with(magic)) return FileKind::kCapture;
  }
  if (bytes.starts_with("\x28\xB5\x2F\xFD"sv) && IsCompressedBag(file)) return FileKind::kRosBag;
  return FileKind::kOther;
}

FileKind KindOfFolder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "velodyne_points", error)) return FileKind::kKittiRaw;
  if (fs::exists(folder / "trajectory.tum", error)) return FileKind::kRunFolder;
  if (fs::exists(folder / "velodyne", error) && fs::exists(folder / "times.txt", error)) {
    return FileKind::kKittiOdometry;
  }
  if (fs::exists(folder / "log.lcm", error) && fs::exists(folder / "config.yaml", error)) {
    return FileKind::kLogFolder;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string extension = entry.path().extension();
    if (extension == ".mcap" || extension == ".db3" || extension == ".bag" ||
        IsCompressedBag(entry.path())) {
      return FileKind::kRosBag;
    }
  }
  return FileKind::kOther;
}

std::string ConvertWith(const fs::path& path, std::string_view what, std::string_view command) {
  return fmt::format("{} is {}: convert it first with 'lio-convert {} {} OUT.lcm'", path.string(),
                     what, command, path.string());
}

std::string ReplayIt(const fs::path& path) {
  return fmt::format(
      "{0} is an LCM log: replay it with 'lio-replay --config RIG.yaml {0} --out DIR'",
      path.string());
}

std::string TakeItsTrajectory(const fs::path& path) {
  return fmt::format("{} is the folder of a run: its path is {}", path.string(),
                     PathOfRun(path).string());
}

}  // namespace

void RefuseIrregular(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status) || fs::is_regular_file(status) || fs::is_directory(status)) return;
  throw InputError(path.string() +
                   ": is no regular file: a FIFO or a device cannot be read, save it as a file");
}

fs::path PathOfRun(const fs::path& folder) {
  const fs::path level = folder / "trajectory_level.tum";
  return fs::exists(level) ? level : folder / "trajectory.tum";
}

FileKind KindOf(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return KindOfFolder(path);
  return fs::is_regular_file(path, error) ? KindOfFile(path) : FileKind::kOther;
}

std::string WhyNoLog(const fs::path& path) {
  switch (KindOf(path)) {
    case FileKind::kRosBag:
      return ConvertWith(path, "a ROS bag", "rosbag");
    case FileKind::kCapture:
      return ConvertWith(path, "a network capture", "pcap");
    case FileKind::kKittiRaw:
      return ConvertWith(path, "a KITTI raw drive", "kitti-raw");
    case FileKind::kKittiOdometry:
      return ConvertWith(path, "a KITTI odometry sequence", "kitti-odometry");
    case FileKind::kLogFolder:
      return path.string() + " is a folder: its log is " + (path / "log.lcm").string();
    case FileKind::kRunFolder:
      return TakeItsTrajectory(path);
    case FileKind::kLcmLog:
    case FileKind::kOther:
      return {};
  }
  return {};
}

std::string WhyNoTrajectory(const fs::path& path) {
  return KindOf(path) == FileKind::kLcmLog ? ReplayIt(path) : WhyNoLog(path);
}

std::string WhyNoRecording(const fs::path& path) {
  const FileKind kind = KindOf(path);
  if (kind == FileKind::kLcmLog) return ReplayIt(path);
  if (kind == FileKind::kLogFolder) return ReplayIt(path / "log.lcm");
  return kind == FileKind::kRunFolder ? TakeItsTrajectory(path) : std::string();
}

}  // namespace lio
