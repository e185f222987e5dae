// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "chunked_reader.hpp"

#include <algorithm>

namespace lio {

bool ChunkedReader::Next(BagMessage& message) {
  while (!finished_) {
    const Step step = inside_ ? StepInside(message) : StepOutside(message);
    if (step == Step::kMessage) return true;
    if (step == Step::kGoOn) continue;
    finished_ = true;
    position_ = size_;
    CountMissing();
  }
  return false;
}

void ChunkedReader::GoOnBehindChunk(std::uint64_t end) {
  inside_.reset();
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(end));
  outside_ = std::make_unique<FileSpan>(file_, size_ - end);
}

std::int64_t ChunkedReader::LostBytes(std::uint64_t stored, std::uint64_t understood,
                                      std::uint64_t inflated) {
  const double understood_ratio =
      inflated == 0
          ? 0.0
          : std::min(1.0, static_cast<double>(understood) / static_cast<double>(inflated));
  return static_cast<std::int64_t>(static_cast<double>(stored) * (1.0 - understood_ratio));
}

void ChunkedReader::Damage(const std::string& reason) {
  if (!damage_.first_reason.empty()) return;
  damage_.first_reason = reason + " at byte " + std::to_string(position_);
}

}  // namespace lio
