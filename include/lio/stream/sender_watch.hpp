// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Do two drivers send inertial samples on one channel? Each numbers its own. Two rows of numbers
// that both go on by one, each while the other does, are two senders; one row that begins anew, has
// holes, repeats or is out of order is not. The sender that came first is kept. Until a second one
// is proven, by its fourth sample, nothing is refused.
#pragma once

#include <cstdint>
#include <optional>

#include "lio/base/time.hpp"

namespace lio {

struct SenderWatchParameters {
  // Numbers that are farther apart are not of one row, whatever the stamps. Chosen: ten seconds of
  // a 100 Hz IMU.
  std::int64_t max_apart = 1000;
  // Steps between samples over which the step is averaged, exponentially. Chosen: it follows
  // another rate within ten samples, and one late sample moves it by an eighth.
  std::int64_t mean_of_steps = 8;
  int min_evidence = 3;  // chosen: a row that a bit error begins does not go on three times
  // So many in a row without one of the first sender, and for so long, mean that it is gone.
  // Chosen: more than a fast IMU sends between two samples of a slow one.
  int gone_after = 20;
  Duration gone_for{500'000'000};
};

inline constexpr SenderWatchParameters kSenderWatch;

class SenderWatch {
 public:
  // Is the sample that comes now, with this number and stamp, of a second sender?
  [[nodiscard]] bool IsForeign(std::int32_t seq, Timestamp stamp);
  // Returns the newest number of the sender that is kept.
  std::uint32_t kept_seq() const { return kept_ ? kept_->seq : 0; }

 private:
  struct Newest {
    std::uint32_t seq = 0;
    Timestamp stamp;
  };

  bool GoesOn(const Newest& sample);
  void TakeOther(const Newest& sample);

  std::optional<Newest> kept_;
  std::optional<Newest> other_;
  Duration step_;                  // between two samples of the kept sender
  bool has_kept_gone_on_ = false;  // since the newest sample of another row
  int num_others_in_a_row_ = 0;
  int evidence_ = 0;
};

}  // namespace lio
