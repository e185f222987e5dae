// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/notice_log.hpp"

#include <spdlog/spdlog.h>

#include <array>
#include <cmath>

namespace lio {
namespace {

constexpr double kRepeat_s = 5.0;  // in sensor time

}  // namespace

void NoticeLog::Write(const Notice& notice) {
  const double since_s = std::abs(SecondsBetween(last_stamp_, notice.stamp));
  if (notice.text == last_text_ && since_s < kRepeat_s) return;
  last_text_ = notice.text;
  last_stamp_ = notice.stamp;
  constexpr std::array kLevels{spdlog::level::info, spdlog::level::warn, spdlog::level::err};
  spdlog::log(kLevels[static_cast<std::size_t>(notice.severity)], "{:.3f}: {}",
              static_cast<double>(notice.stamp.ns) * 1e-9, notice.text);
}

}  // namespace lio
