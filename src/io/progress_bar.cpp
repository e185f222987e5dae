// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/progress_bar.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace lio {

ProgressBar::ProgressBar(std::string label, std::int64_t total)
    : label_(std::move(label)), total_(total), is_on_(total > 0 && ::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (is_on_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::Update(std::int64_t done) {
  if (!is_on_) return;
  const double share = static_cast<double>(done) / static_cast<double>(total_);
  const int percent = static_cast<int>(100.0 * std::clamp(share, 0.0, 1.0));
  if (percent == percent_) return;
  percent_ = percent;
  fmt::print(stderr, "\r{}", Draw(label_, percent));
}

std::string ProgressBar::Draw(const std::string& label, int percent) {
  constexpr int kWidth = 40;
  const int filled = kWidth * percent / 100;
  return fmt::format("{} [{:#<{}}{:-<{}}] {:3} %", label, "", filled, "", kWidth - filled, percent);
}

}  // namespace lio
