// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The files themselves are tested with RunWriter.
#include "lio/io/segment_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

constexpr Timestamp kStamp{1'700'000'000'000'000'000};

ScanOutput ScanAt(Timestamp stamp) {
  ScanOutput output;
  output.scan.stamp = stamp;
  return output;
}

NavOutput NavAt(Timestamp stamp, OdometrySource source) {
  NavOutput nav;
  nav.stamp = stamp;
  nav.source = source;
  return nav;
}

TEST(SegmentFiles, ARowThatStepsBackIsBeforeTheSegment) {
  const test::TempDir folder;
  SegmentFiles files(folder.path(), false);
  const Timestamp early = kStamp - SegmentFiles::kStepBack - Duration{1};
  EXPECT_FALSE(files.IsBefore(ScanAt(early))) << "it has no rows";
  files.Write(ScanAt(kStamp), std::nullopt);
  EXPECT_TRUE(files.IsBefore(ScanAt(early)));
  EXPECT_FALSE(files.IsBefore(ScanAt(kStamp - SegmentFiles::kStepBack)));
  EXPECT_FALSE(files.IsBefore(NavAt(early, OdometrySource::kImuPropagated)))
      << "none of its kind was there";
  files.Write(NavAt(kStamp, OdometrySource::kImuPropagated), std::nullopt);
  EXPECT_TRUE(files.IsBefore(NavAt(early, OdometrySource::kImuPropagated)));
  files.Finish();
}

TEST(SegmentFiles, OnlyRowsCount) {
  const test::TempDir folder;
  SegmentFiles files(folder.path(), false);
  files.Write(ScanAt(kStamp), std::nullopt);
  EXPECT_FALSE(files.IsBefore(Notice{}));
  EXPECT_FALSE(files.IsBefore(NavOutput{}));
  files.Finish();
}

TEST(SegmentFiles, AFolderThatCannotBeMadeIsNamed) {
  const test::TempDir folder;
  std::ofstream(folder.path() / "file").close();
  EXPECT_THROW(SegmentFiles(folder.path() / "file" / "out", false), std::runtime_error);
}

}  // namespace
}  // namespace lio
