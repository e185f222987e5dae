// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/sparse_support.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(SparseSupport, FirstScanDecides) {
  SparseSupport support;
  EXPECT_TRUE(support.is_unknown());
  EXPECT_FALSE(support.is_sparse());
  support.Add(0.19);
  EXPECT_FALSE(support.is_unknown());
  EXPECT_TRUE(support.is_sparse());
  SparseSupport dense;
  dense.Add(0.21);
  EXPECT_FALSE(dense.is_sparse());
}

TEST(SparseSupport, ItTurnsDenseOnlyWhereTheMeanIsClearlyDense) {
  SparseSupport support;
  support.Add(0.1);
  for (int i = 0; i < 100; ++i) support.Add(0.29);
  EXPECT_TRUE(support.is_sparse());
  for (int i = 0; i < 100; ++i) support.Add(0.35);
  EXPECT_FALSE(support.is_sparse());
  for (int i = 0; i < 100; ++i) support.Add(0.21);
  EXPECT_FALSE(support.is_sparse());
}

TEST(SparseSupport, OneScanThatSeesNothingKnownChangesNothing) {
  SparseSupport support;
  support.Add(0.5);
  support.Add(0.0);
  EXPECT_FALSE(support.is_sparse());
}

}  // namespace
}  // namespace lio
