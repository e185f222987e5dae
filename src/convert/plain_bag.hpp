// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Opens a bag whose files are compressed as a whole (drive.mcap.zstd, or a ROS 2 bag in compression
// mode "file"), inflated into a folder for temporary files for as long as it is read.
#pragma once

#include <filesystem>

namespace lio {

class PlainBag {
 public:
  // Inflates what is compressed; a path that is not is taken as it is. A file that is cut short is
  // inflated up to the cut, which the reader of its content notices. Throws InputError that names
  // the file and the fault, and OutputError when the temporary folder has no room.
  explicit PlainBag(const std::filesystem::path& path);
  ~PlainBag();
  PlainBag(const PlainBag&) = delete;
  PlainBag& operator=(const PlainBag&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  void InflateFolder(const std::filesystem::path& folder);
  void WriteMetadata(const std::filesystem::path& metadata) const;
  [[nodiscard]] std::filesystem::path Inflate(const std::filesystem::path& file) const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;  // empty when nothing was inflated
};

}  // namespace lio
