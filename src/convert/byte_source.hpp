// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Declares the streams of bytes from which a bag's records are parsed: a span of the file, or the
// content of a compressed chunk. They are streams, so that memory does not depend on the sizes that
// a file claims.
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <span>
#include <vector>

namespace lio {

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  // Fills `out` as far as the source goes. Returns fewer bytes than asked for only at the end of
  // the source or where it is damaged.
  [[nodiscard]] std::size_t Read(std::span<std::uint8_t> out);
  // Skips `count` bytes; returns how many there were.
  std::uint64_t Skip(std::uint64_t count);
  [[nodiscard]] std::uint64_t num_delivered() const {
    return num_delivered_;
  }  // read or skipped so far
  // Returns true when the content contradicts the format (a broken compressed stream).
  [[nodiscard]] virtual bool damaged() const { return false; }

 private:
  [[nodiscard]] virtual std::size_t DoRead(std::span<std::uint8_t> out) = 0;
  [[nodiscard]] virtual std::uint64_t DoSkip(std::uint64_t count);

  std::uint64_t num_delivered_ = 0;
};

// Delivers the next `size` bytes of a file from its present position. `file` must outlive the
// source.
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

// These inflate what `compressed` delivers: LZ4 frames (as bags have them), bzip2 streams and
// Zstandard frames. A Zstandard frame whose window is larger than 128 MiB is damaged: no more
// memory than that is taken.
[[nodiscard]] std::unique_ptr<ByteSource> MakeLz4Source(std::unique_ptr<ByteSource> compressed);
[[nodiscard]] std::unique_ptr<ByteSource> MakeBz2Source(std::unique_ptr<ByteSource> compressed);
[[nodiscard]] std::unique_ptr<ByteSource> MakeZstdSource(std::unique_ptr<ByteSource> compressed);

// Delivers at most `max_bytes` of `source`, and is damaged where the source has more.
[[nodiscard]] std::unique_ptr<ByteSource> Limited(std::unique_ptr<ByteSource> source,
                                                  std::uint64_t max_bytes);

enum class RecordStatus {
  kOk,
  kEnd,     // there is not one byte more
  kCut,     // the source ends inside
  kBroken,  // the bytes are no record
};

// Reads `count` bytes into `data`, which grows only as bytes arrive. Returns false when there are
// fewer.
[[nodiscard]] bool ReadRecordData(ByteSource& source, std::uint64_t count,
                                  std::vector<std::uint8_t>& data);

}  // namespace lio
