// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "byte_source.hpp"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace lio {
namespace {

constexpr std::size_t kRefillBytes = 64 * 1024;
constexpr std::size_t kGrowBytes = 1u << 20;
constexpr int kMaxZstdWindowLog = 27;  // 128 MiB, the limit of the command zstd, too

// Holds compressed bytes between the file and the decoder.
class Refill {
 public:
  explicit Refill(std::unique_ptr<ByteSource> source) : source_(std::move(source)) {}
  // Returns the waiting bytes, and reads a block if there are none. They are empty at the end.
  std::span<std::uint8_t> Waiting() {
    if (begin_ == end_) {
      begin_ = 0;
      end_ = source_->Read(block_);
    }
    return std::span(block_).subspan(begin_, end_ - begin_);
  }
  void Consume(std::size_t count) { begin_ += count; }

 private:
  std::unique_ptr<ByteSource> source_;
  std::array<std::uint8_t, kRefillBytes> block_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

class Lz4Source : public ByteSource {
 public:
  explicit Lz4Source(std::unique_ptr<ByteSource> compressed) : input_(std::move(compressed)) {
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context_, LZ4F_VERSION))) {
      throw std::runtime_error("liblz4 gives no decompression context");
    }
  }
  ~Lz4Source() override { LZ4F_freeDecompressionContext(context_); }
  Lz4Source(const Lz4Source&) = delete;
  Lz4Source& operator=(const Lz4Source&) = delete;

  bool damaged() const override { return damaged_; }

 private:
  std::size_t DoRead(std::span<std::uint8_t> out) override {
    std::size_t filled = 0;
    while (filled < out.size() && !damaged_) {
      const auto waiting = input_.Waiting();
      std::size_t consumed = waiting.size();
      std::size_t produced = out.size() - filled;
      const std::size_t status = LZ4F_decompress(context_, out.data() + filled, &produced,
                                                 waiting.data(), &consumed, nullptr);
      damaged_ = LZ4F_isError(status) != 0;
      if (damaged_) break;
      input_.Consume(consumed);
      filled += produced;
      if (consumed == 0 && produced == 0) break;  // end of the frame or of the file
    }
    return filled;
  }

  Refill input_;
  LZ4F_dctx* context_ = nullptr;
  bool damaged_ = false;
};

class Bz2Source : public ByteSource {
 public:
  explicit Bz2Source(std::unique_ptr<ByteSource> compressed) : input_(std::move(compressed)) {
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) {
      throw std::runtime_error("libbz2 gives no decompression context");
    }
  }
  ~Bz2Source() override { BZ2_bzDecompressEnd(&stream_); }
  Bz2Source(const Bz2Source&) = delete;
  Bz2Source& operator=(const Bz2Source&) = delete;

  bool damaged() const override { return damaged_; }

 private:
  std::size_t DoRead(std::span<std::uint8_t> out) override {
    constexpr std::size_t kMaxStep = 1u << 30;  // bz_stream counts in unsigned int
    std::size_t filled = 0;
    while (filled < out.size() && !damaged_ && !at_end_) {
      const auto waiting = input_.Waiting();
      const std::size_t room = std::min(out.size() - filled, kMaxStep);
      stream_.next_in = reinterpret_cast<char*>(waiting.data());
      stream_.avail_in = static_cast<unsigned>(waiting.size());
      stream_.next_out = reinterpret_cast<char*>(out.data() + filled);
      stream_.avail_out = static_cast<unsigned>(room);
      const int status = BZ2_bzDecompress(&stream_);
      const std::size_t consumed = waiting.size() - stream_.avail_in;
      const std::size_t produced = room - stream_.avail_out;
      input_.Consume(consumed);
      filled += produced;
      at_end_ = status == BZ_STREAM_END;
      damaged_ = status != BZ_OK && status != BZ_STREAM_END;
      if (consumed == 0 && produced == 0) break;
    }
    return filled;
  }

  Refill input_;
  bz_stream stream_{};
  bool damaged_ = false;
  bool at_end_ = false;
};

class ZstdSource : public ByteSource {
 public:
  explicit ZstdSource(std::unique_ptr<ByteSource> compressed) : input_(std::move(compressed)) {
    if (!stream_ || ZSTD_isError(ZSTD_DCtx_setParameter(stream_.get(), ZSTD_d_windowLogMax,
                                                        kMaxZstdWindowLog))) {
      throw std::runtime_error("libzstd gives no decompression context");
    }
  }

  bool damaged() const override { return damaged_; }

 private:
  struct Free {
    void operator()(ZSTD_DCtx* stream) const { ZSTD_freeDCtx(stream); }
  };

  std::size_t DoRead(std::span<std::uint8_t> out) override {
    ZSTD_outBuffer to{out.data(), out.size(), 0};
    while (to.pos < to.size && !damaged_) {
      const auto waiting = input_.Waiting();
      ZSTD_inBuffer from{waiting.data(), waiting.size(), 0};
      const std::size_t before = to.pos;
      damaged_ = ZSTD_isError(ZSTD_decompressStream(stream_.get(), &to, &from)) != 0;
      input_.Consume(from.pos);
      if (from.pos == 0 && to.pos == before) break;  // end of the file
    }
    return to.pos;
  }

  Refill input_;
  std::unique_ptr<ZSTD_DCtx, Free> stream_{ZSTD_createDCtx()};
  bool damaged_ = false;
};

class LimitedSource : public ByteSource {
 public:
  LimitedSource(std::unique_ptr<ByteSource> source, std::uint64_t max_bytes)
      : source_(std::move(source)), left_(max_bytes) {}
  bool damaged() const override { return has_more_ || source_->damaged(); }

 private:
  std::size_t DoRead(std::span<std::uint8_t> out) override {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), left_));
    const std::size_t got = source_->Read(out.first(wanted));
    left_ -= got;
    std::uint8_t next = 0;
    if (wanted < out.size() && got == wanted) has_more_ |= source_->Read({&next, 1}) == 1;
    return got;
  }

  std::unique_ptr<ByteSource> source_;
  std::uint64_t left_;
  bool has_more_ = false;
};

}  // namespace

std::size_t ByteSource::Read(std::span<std::uint8_t> out) {
  const std::size_t got = DoRead(out);
  num_delivered_ += got;
  return got;
}

std::uint64_t ByteSource::Skip(std::uint64_t count) {
  const std::uint64_t got = DoSkip(count);
  num_delivered_ += got;
  return got;
}

std::uint64_t ByteSource::DoSkip(std::uint64_t count) {
  std::array<std::uint8_t, 4096> scratch;
  std::uint64_t skipped = 0;
  while (skipped < count) {
    const auto step =
        static_cast<std::size_t>(std::min<std::uint64_t>(scratch.size(), count - skipped));
    const std::size_t got = DoRead(std::span(scratch).first(step));
    skipped += got;
    if (got < step) break;
  }
  return skipped;
}

std::size_t FileSpan::DoRead(std::span<std::uint8_t> out) {
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), left_));
  if (wanted == 0) return 0;
  file_->read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(wanted));
  const auto got = static_cast<std::size_t>(file_->gcount());
  if (got < wanted) file_->clear();
  left_ = got < wanted ? 0 : left_ - got;
  return got;
}

std::uint64_t FileSpan::DoSkip(std::uint64_t count) {
  const std::uint64_t step = std::min(count, left_);
  file_->seekg(static_cast<std::streamoff>(step), std::ios::cur);
  left_ -= step;
  return step;
}

std::unique_ptr<ByteSource> MakeLz4Source(std::unique_ptr<ByteSource> compressed) {
  return std::make_unique<Lz4Source>(std::move(compressed));
}

std::unique_ptr<ByteSource> MakeBz2Source(std::unique_ptr<ByteSource> compressed) {
  return std::make_unique<Bz2Source>(std::move(compressed));
}

std::unique_ptr<ByteSource> MakeZstdSource(std::unique_ptr<ByteSource> compressed) {
  return std::make_unique<ZstdSource>(std::move(compressed));
}

std::unique_ptr<ByteSource> Limited(std::unique_ptr<ByteSource> source, std::uint64_t max_bytes) {
  return std::make_unique<LimitedSource>(std::move(source), max_bytes);
}

bool ReadRecordData(ByteSource& source, std::uint64_t count, std::vector<std::uint8_t>& data) {
  data.clear();
  while (data.size() < count) {
    const std::size_t before = data.size();
    const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(kGrowBytes, count - before));
    data.resize(before + step);
    const std::size_t got = source.Read(std::span(data).subspan(before));
    if (got < step) {
      data.resize(before + got);
      return false;
    }
  }
  return true;
}

}  // namespace lio
