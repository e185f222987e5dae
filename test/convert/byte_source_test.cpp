// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/byte_source.hpp"

#include <bzlib.h>
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

#include <numeric>
#include <random>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

std::vector<std::uint8_t> Content() {
  std::vector<std::uint8_t> content(300'000);
  std::mt19937 random(7);
  for (auto& byte : content) byte = static_cast<std::uint8_t>(random() % 5);
  return content;
}

std::string Compressed(const std::string& how, std::vector<std::uint8_t> content) {
  std::string out(content.size() + 10'000, '\0');
  if (how == "lz4") {
    out.resize(LZ4F_compressFrame(out.data(), out.size(), content.data(), content.size(), nullptr));
  } else if (how == "zstd") {
    out.resize(ZSTD_compress(out.data(), out.size(), content.data(), content.size(), 1));
  } else {
    auto size = static_cast<unsigned>(out.size());
    BZ2_bzBuffToBuffCompress(out.data(), &size, reinterpret_cast<char*>(content.data()),
                             static_cast<unsigned>(content.size()), 9, 0, 0);
    out.resize(size);
  }
  return out;
}

std::unique_ptr<ByteSource> Inflated(const std::string& how, std::unique_ptr<ByteSource> stored) {
  if (how == "lz4") return MakeLz4Source(std::move(stored));
  if (how == "zstd") return MakeZstdSource(std::move(stored));
  return MakeBz2Source(std::move(stored));
}

class CompressedSource : public testing::TestWithParam<std::string> {
 protected:
  // Returns what comes out of a file with these bytes, read in pieces of `step`.
  std::vector<std::uint8_t> Inflate(const std::string& bytes, std::size_t step, bool& damaged) {
    std::ifstream file(dir_.Write("compressed", bytes), std::ios::binary);
    auto span = std::make_unique<FileSpan>(file, bytes.size());
    const auto source = Inflated(GetParam(), std::move(span));
    std::vector<std::uint8_t> all;
    std::vector<std::uint8_t> piece(step);
    std::size_t got = step;
    while (got == step) {
      got = source->Read(piece);
      all.insert(all.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(got));
    }
    EXPECT_EQ(source->num_delivered(), all.size());
    damaged = source->damaged();
    return all;
  }

  test::TempDir dir_;
};

TEST_P(CompressedSource, GivesTheContentInAnyPieces) {
  const auto content = Content();
  const std::string compressed = Compressed(GetParam(), content);
  for (const std::size_t step : {100ul, 65'536ul, 1'000'000ul}) {
    bool damaged = true;
    EXPECT_EQ(Inflate(compressed, step, damaged), content) << step;
    EXPECT_FALSE(damaged);
  }
}

TEST_P(CompressedSource, GivesTheBeginningOfACutStream) {
  const auto content = Content();
  const std::string compressed = Compressed(GetParam(), content);
  for (std::size_t cut = 0; cut < compressed.size(); cut += compressed.size() / 20) {
    bool damaged = true;
    const auto got = Inflate(compressed.substr(0, cut), 4096, damaged);
    ASSERT_LE(got.size(), content.size());
    EXPECT_TRUE(std::equal(got.begin(), got.end(), content.begin())) << cut;
  }
}

TEST_P(CompressedSource, SaysWhenTheStreamIsDamaged) {
  std::string compressed = Compressed(GetParam(), Content());
  for (std::size_t i = 0; i < compressed.size(); i += 97) compressed[i] ^= 0x55;
  bool damaged = false;
  Inflate(compressed, 4096, damaged);
  EXPECT_TRUE(damaged);
}

TEST_P(CompressedSource, GivesNothingForNothing) {
  bool damaged = true;
  EXPECT_TRUE(Inflate("", 10, damaged).empty());
  EXPECT_FALSE(damaged);
}

INSTANTIATE_TEST_SUITE_P(Compressions, CompressedSource, testing::Values("lz4", "bz2", "zstd"),
                         [](const auto& test) { return test.param; });

// The header of a frame says how much memory its content may refer back to: here 2 GiB.
TEST(ZstdSource, AWindowBeyondAllMemoryIsDamage) {
  const test::TempDir dir;
  const std::string frame("\x28\xb5\x2f\xfd\x00\xa8\x01\x00\x00", 9);
  std::ifstream file(dir.Write("frame", frame), std::ios::binary);
  const auto source = MakeZstdSource(std::make_unique<FileSpan>(file, frame.size()));
  std::array<std::uint8_t, 8> out;
  EXPECT_EQ(source->Read(out), 0u);
  EXPECT_TRUE(source->damaged());
}

TEST(FileSpan, EndsAtItsSizeOrTheFiles) {
  const test::TempDir dir;
  std::ifstream file(dir.Write("file", "0123456789"), std::ios::binary);
  FileSpan span(file, 4);
  std::array<std::uint8_t, 3> out;
  EXPECT_EQ(span.Read(out), 3u);
  EXPECT_EQ(span.Read(out), 1u);
  EXPECT_EQ(out[0], '3');
  EXPECT_EQ(span.Read(out), 0u);
  FileSpan beyond(file, 100);
  EXPECT_EQ(beyond.Skip(5), 5u);
  EXPECT_EQ(beyond.Read(out), 1u);
  EXPECT_EQ(out[0], '9');
  EXPECT_EQ(beyond.Read(out), 0u);
}

TEST_P(CompressedSource, IsDamagedWhereItInflatesToMoreThanItMay) {
  const std::vector<std::uint8_t> content = Content();
  for (const std::size_t max_bytes : {content.size() - 1, content.size(), content.size() + 1}) {
    const test::TempDir dir;
    const auto path = dir.Write("content", Compressed(GetParam(), content));
    std::ifstream file(path, std::ios::binary);
    auto span = std::make_unique<FileSpan>(file, std::filesystem::file_size(path));
    const auto source = Limited(Inflated(GetParam(), std::move(span)), max_bytes);
    std::vector<std::uint8_t> out(content.size() + 100);
    EXPECT_EQ(source->Read(out), std::min(max_bytes, content.size()));
    EXPECT_EQ(source->damaged(), max_bytes < content.size()) << max_bytes;
  }
}

}  // namespace
}  // namespace lio
