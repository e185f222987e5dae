// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds rows that only grow, so that a client which knows how many it has knows what it lacks.
// Their number is bounded: when they are too many every second one goes, and of the next ones only
// every second (fourth, eighth ...) is kept. Thinning and clearing begin a new generation, which
// clients take anew.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lio {

template <class Row>
class GrowingRows {
 public:
  explicit GrowingRows(std::size_t max_rows) : max_rows_(max_rows) {}

  void Add(const Row& row) {
    if (num_offered_++ % stride_ != 0) return;
    rows_.push_back(row);
    if (rows_.size() <= max_rows_) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rows_.size(); i += 2) rows_[kept++] = rows_[i];
    rows_.resize(kept);
    stride_ *= 2;
    ++generation_;
  }

  void Clear() {
    rows_.clear();
    stride_ = 1;
    num_offered_ = 0;
    ++generation_;
  }

  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] std::uint32_t generation() const { return generation_; }

 private:
  std::size_t max_rows_;
  std::vector<Row> rows_;
  std::size_t stride_ = 1;
  std::size_t num_offered_ = 0;
  std::uint32_t generation_ = 1;
};

}  // namespace lio
