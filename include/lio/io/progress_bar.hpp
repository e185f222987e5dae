// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Draws the progress of long work on stderr when that is a terminal, and nothing otherwise.
#pragma once

#include <cstdint>
#include <string>

namespace lio {

class ProgressBar {
 public:
  // `total` is in the unit of Update's argument; with 0 nothing is drawn.
  ProgressBar(std::string label, std::int64_t total);
  ~ProgressBar();  // wipes the bar, so that the next output begins on a clean line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Cheap to call often: draws only when the percentage changes.
  void Update(std::int64_t done);

  // Returns the bar as text, e.g. "replay [####----] 50 %"; `percent` 0..100.
  [[nodiscard]] static std::string Draw(const std::string& label, int percent);

 private:
  std::string label_;
  std::int64_t total_;
  bool is_on_;
  int percent_ = -1;
};

}  // namespace lio
