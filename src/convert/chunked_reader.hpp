// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads bag formats that are one file of records, some of them chunks that hold records in turn,
// from front to back: where the file stands, the loop over its records, and its damage. Each format
// has its own records.
#pragma once

#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "byte_source.hpp"
#include "lio/convert/bag_reader.hpp"

namespace lio {

class ChunkedReader : public BagReader {
 public:
  void Select(std::function<bool(const BagTopic&)> wanted) override { wanted_ = std::move(wanted); }
  bool Next(BagMessage& message) override;
  const BagDamage& damage() const override { return damage_; }
  std::optional<Timestamp> begin_time() const override { return begin_time_; }
  std::int64_t position_bytes() const override { return static_cast<std::int64_t>(position_); }
  std::int64_t size_bytes() const override { return static_cast<std::int64_t>(size_); }

 protected:
  enum class Step { kMessage, kGoOn, kEnd };

  // Takes the next record of the file, and of the present chunk.
  virtual Step StepOutside(BagMessage& message) = 0;
  virtual Step StepInside(BagMessage& message) = 0;
  // No record comes any more: counts what is missing.
  virtual void CountMissing() = 0;

  // Goes on outside of the chunk that ended at this position of the file.
  void GoOnBehindChunk(std::uint64_t end);
  // Returns the share of a chunk's stored bytes whose records were not understood, of `inflated`
  // bytes in all.
  [[nodiscard]] static std::int64_t LostBytes(std::uint64_t stored, std::uint64_t understood,
                                              std::uint64_t inflated);
  // Notes the reason and the place of the first damage.
  void Damage(const std::string& reason);
  std::uint64_t Here() { return static_cast<std::uint64_t>(file_.tellg()); }

  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;  // start of the outer record being read
  std::unique_ptr<FileSpan> outside_;
  std::unique_ptr<ByteSource> inside_;  // content of the present chunk
  bool finished_ = false;
  std::function<bool(const BagTopic&)> wanted_ = [](const BagTopic&) { return true; };
  std::optional<Timestamp> begin_time_;
  std::vector<std::uint8_t> buffer_;
  BagDamage damage_;
};

}  // namespace lio
