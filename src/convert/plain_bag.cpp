// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "plain_bag.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "byte_source.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "rosbag2_files.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInfo = "rosbag2_bagfile_information";

bool IsZstdName(const fs::path& file) {
  return file.extension() == kZstdEnding || file.extension() == ".zst";
}

bool HasCompressedFile(const fs::path& folder) {
  const fs::directory_iterator files(folder);
  return std::any_of(begin(files), end(files),
                     [](const auto& entry) { return IsZstdFile(entry.path()); });
}

fs::path MakeTemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "liod-bag-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw OutputError("cannot create a folder in " + fs::temp_directory_path().string() +
                      ": set TMPDIR to one with room for the inflated bag");
  }
  return pattern;
}

void Copy(ByteSource& source, const fs::path& from, const fs::path& to) {
  std::ofstream out(to, std::ios::binary);
  std::vector<std::uint8_t> block(1u << 20);
  std::size_t got = 0;
  do {
    got = source.Read(block);
    out.write(reinterpret_cast<const char*>(block.data()), static_cast<std::streamsize>(got));
  } while (got == block.size() && out);
  out.close();
  if (!out) {
    throw WriteError(fmt::format("{}: cannot be inflated into {}: set TMPDIR to a folder with room",
                                 from.string(), to.parent_path().string()));
  }
}

}  // namespace

PlainBag::PlainBag(const fs::path& path) : path_(path) {
  if (fs::is_regular_file(path) && IsZstdFile(path)) {
    temporary_ = MakeTemporaryFolder();
    path_ = Inflate(path);
    return;
  }
  const bool is_metadata = path.filename() == "metadata.yaml";
  const fs::path folder = is_metadata ? fs::absolute(path).parent_path() : path;
  if (fs::is_directory(folder) && HasCompressedFile(folder)) InflateFolder(folder);
}

PlainBag::~PlainBag() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void PlainBag::InflateFolder(const fs::path& folder) {
  temporary_ = MakeTemporaryFolder();
  path_ = temporary_;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    if (IsZstdFile(file)) {
      (void)Inflate(file);
    } else if (file.filename() == "metadata.yaml") {
      WriteMetadata(file);
    } else if (entry.is_regular_file()) {
      fs::create_symlink(fs::absolute(file), temporary_ / file.filename());
    }
  }
}

// The metadata of the inflated bag: its files have other names, and are not compressed.
void PlainBag::WriteMetadata(const fs::path& metadata) const {
  try {
    YAML::Node all = YAML::LoadFile(metadata.string());
    YAML::Node info = all[kInfo];
    if (!info.IsMap()) throw InputError(metadata.string() + ": no metadata of a ROS 2 bag");
    YAML::Node names(YAML::NodeType::Sequence);
    for (const YAML::Node& name : info["relative_file_paths"]) {
      const fs::path file = fs::path(name.as<std::string>()).filename();
      names.push_back(IsZstdName(file) ? file.stem().string() : file.string());
    }
    info["relative_file_paths"] = names;
    info["compression_format"] = "";
    info["compression_mode"] = "";
    std::ofstream(temporary_ / "metadata.yaml") << all;
  } catch (const YAML::Exception& error) {
    throw InputError(metadata.string() + ": cannot be read as YAML: " + error.what());
  }
}

fs::path PlainBag::Inflate(const fs::path& file) const {
  RefuseIrregular(file);
  std::ifstream stream(file, std::ios::binary);
  const auto source =
      MakeZstdSource(std::make_unique<FileSpan>(stream, std::numeric_limits<std::uint64_t>::max()));
  const fs::path plain = temporary_ / file.stem();
  Copy(*source, file, plain);
  if (source->num_delivered() == 0) {
    throw InputError(file.string() + ": nothing in it can be inflated as Zstandard");
  }
  return plain;
}

}  // namespace lio
