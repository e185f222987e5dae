// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Collects what the process writes to stderr. liblcm explains its failures there, over several
// lines, and gives its caller no text: this makes them part of the one line that an error gets.
#pragma once

#include <string>

namespace lio {

// Redirects file descriptor 2, so the writes of all threads are captured; keep the time short.
// Nested captures must end in reverse order.
class StderrCapture {
 public:
  // When the redirection fails, stderr stays as it is and fault() says why.
  StderrCapture();
  ~StderrCapture();  // restores stderr
  StderrCapture(const StderrCapture&) = delete;
  StderrCapture& operator=(const StderrCapture&) = delete;

  // Why nothing is captured, e.g. "dup: Too many open files"; empty when the capture works.
  [[nodiscard]] const std::string& fault() const { return fault_; }

  // Restores stderr and returns what was written since the construction. Throws std::runtime_error
  // when stderr cannot be restored. Afterwards, and without a redirection, it is empty.
  [[nodiscard]] std::string Finish();

 private:
  [[nodiscard]] std::string Restore();  // empty, or why it failed

  int saved_ = -1;   // a duplicate of the former stderr; -1: not redirected
  int memory_ = -1;  // the file in memory that takes the text
  std::string fault_;
};

}  // namespace lio
