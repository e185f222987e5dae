// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A stream of bytes that a bag's records are parsed from: a span of the file, or what a compressed
// chunk inflates to. Streams, so that memory does not depend on what a file claims about its sizes.
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <span>

namespace lio {

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  // Fills `out` as far as the source goes; fewer bytes than asked for only at its end or where it
  // is damaged.
  std::size_t Read(std::span<std::uint8_t> out);
  // Passes over `count` bytes; returns how many there were.
  std::uint64_t Skip(std::uint64_t count);
  std::uint64_t num_delivered() const { return num_delivered_; }  // read or skipped so far
  // The content is not what the format promises (a broken compressed stream).
  virtual bool damaged() const { return false; }

 private:
  virtual std::size_t DoRead(std::span<std::uint8_t> out) = 0;
  virtual std::uint64_t DoSkip(std::uint64_t count);

  std::uint64_t num_delivered_ = 0;
};

// The next `size` bytes of a file from its present position. `file` outlives the source.
class FileSpan : public ByteSource {
 public:
  FileSpan(std::ifstream& file, std::uint64_t size) : file_(&file), left_(size) {}
  std::uint64_t left() const { return left_; }

 private:
  std::size_t DoRead(std::span<std::uint8_t> out) override;
  std::uint64_t DoSkip(std::uint64_t count) override;

  std::ifstream* file_;
  std::uint64_t left_;
};

// Inflate what `compressed` delivers: LZ4 frames (as ROS bags have them) and bzip2 streams.
std::unique_ptr<ByteSource> MakeLz4Source(std::unique_ptr<ByteSource> compressed);
std::unique_ptr<ByteSource> MakeBz2Source(std::unique_ptr<ByteSource> compressed);

}  // namespace lio
