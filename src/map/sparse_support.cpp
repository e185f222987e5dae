// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/sparse_support.hpp"

#include "lio/map/map_parameters.hpp"

namespace lio {

void SparseSupport::Add(double share) {
  mean_share_ =
      mean_share_ ? *mean_share_ + SparseSupportParameters::kRate * (share - *mean_share_) : share;
  if (*mean_share_ < SparseSupportParameters::kSparseBelow) is_sparse_ = true;
  if (*mean_share_ > SparseSupportParameters::kDenseAbove) is_sparse_ = false;
}

}  // namespace lio
