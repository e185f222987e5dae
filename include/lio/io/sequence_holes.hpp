// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Counts the numbers of a sender's sequence that never came, so that neither a message with a false
// number nor messages out of order make a loss. Numbers wrap.
#pragma once

#include <cstdint>
#include <optional>

namespace lio {

class SequenceHoles {
 public:
  void Add(std::int32_t number);

  // It falls again when a number comes after the next ones.
  [[nodiscard]] std::int64_t num_missing() const { return num_missing_; }

 private:
  // Numbers are in order among so many. Chosen: the bits of a word; no sample is later than that.
  static constexpr std::int32_t kReach = 63;
  // A step of thousands comes from another sender and does not tell how many were lost. Chosen: ten
  // seconds of a fast IMU.
  static constexpr std::int32_t kMaxHole = 10'000;

  void BeginAt(std::uint32_t number);
  void Advance(std::int32_t step);
  void FillIn(std::int32_t steps_back);

  bool has_begun_ = false;
  std::uint32_t newest_ = 0;
  std::uint64_t came_ = 0;            // bit i tells of newest_ - i; before the begin all came
  std::optional<std::uint32_t> far_;  // the last one, if it was out of reach
  std::int64_t num_missing_ = 0;
};

}  // namespace lio
