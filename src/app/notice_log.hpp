// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the estimator's notices on stderr, through the log. A notice with the words of the last
// one is left out for a few seconds of sensor time, so that a lasting fault does not fill the
// screen.
#pragma once

#include <string>

#include "lio/pipeline/odometry.hpp"

namespace lio {

class NoticeLog {
 public:
  void Write(const Notice& notice);

 private:
  std::string last_text_;
  Timestamp last_stamp_{0};
};

}  // namespace lio
