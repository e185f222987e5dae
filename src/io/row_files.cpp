// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/row_files.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "covariance_rows.hpp"
#include "lio/io/trajectory_file.hpp"
#include "stage_names.hpp"
#include "state_rows.hpp"

namespace lio {
namespace fs = std::filesystem;
namespace {

constexpr std::array<const char*, 6> kMatchStatusNames = {
    "converged", "max_iterations", "too_few_points", "empty_map", "diverged", "degenerate"};

std::string RegistrationHeader() {
  std::string header =
      "t_s,segment,scan_seq,num_raw,num_used,num_matched,iterations,status,fused,residual_rms_m,"
      "nis,"
      "degenerate_mask";
  for (int i = 0; i < 6; ++i) header += fmt::format(",information_eigenvalue_{}", i);
  for (std::size_t i = 0; i < LevelCounts().size(); ++i)
    header += fmt::format(",matched_level_{}", i);
  header += ",matches,coarse_matches";
  for (const char* stage : kStageNames) header += fmt::format(",{}_ms", stage);
  return header + "\n";
}

std::string RegistrationRow(int segment, const ScanReport& scan) {
  std::string row =
      fmt::format("{},{},{},{},{},{},{},{},{},{:.9e},{:.9e},{}", StampText(scan.stamp), segment,
                  scan.scan_seq, scan.num_raw, scan.num_used, scan.num_matched, scan.iterations,
                  kMatchStatusNames.at(static_cast<std::size_t>(scan.status)), scan.fused ? 1 : 0,
                  scan.residual_rms_m, scan.nis, scan.degenerate_mask);
  for (const double eigenvalue : scan.information_eigenvalues) {
    row += fmt::format(",{:.9e}", eigenvalue);
  }
  for (const int num : scan.num_matched_at) row += fmt::format(",{}", num);
  row += fmt::format(",{},{}", scan.num_matches, scan.num_coarse_matches);
  for (const std::int64_t ns : scan.stage_ns) row += fmt::format(",{:.6f}", Milliseconds(ns));
  return row + "\n";
}

const fs::path& Created(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw std::runtime_error("cannot create " + folder.string() + ": " + error.message());
  }
  fs::remove(folder / "trajectory_base.tum", error);  // left by an earlier run
  return folder;
}

}  // namespace

RowFiles::Track RowFiles::OpenTrack(const fs::path& folder, const std::string& frame) {
  Track track{OutputFile(folder / ("trajectory" + frame + ".tum")),
              OutputFile(folder / ("covariance" + frame + ".csv"))};
  track.covariances.Write(CovarianceHeader());
  return track;
}

void RowFiles::WriteRow(const StampedPose& pose, const Matrix6& cov, Track& track) {
  track.poses.Write(TumRow(pose) + "\n");
  track.covariances.Write(CovarianceRow(pose.stamp, cov));
}

RowFiles::RowFiles(const fs::path& folder, bool has_base, bool turns_map)
    : in_map_(OpenTrack(Created(folder), "")),
      in_world_(OpenTrack(folder, "_world")),
      level_(folder, turns_map),
      imu_rate_(folder / "trajectory_imu_rate.tum"),
      states_(folder / "states.csv"),
      registration_(folder / "registration.csv") {
  if (has_base) base_.emplace(folder / "trajectory_base.tum");
  states_.Write(StateHeader());
  registration_.Write(RegistrationHeader());
}

void RowFiles::Write(const Output& output, int segment) {
  if (const auto* scan = std::get_if<ScanOutput>(&output)) WriteScan(*scan, segment);
  const auto* nav = std::get_if<NavOutput>(&output);
  if (nav != nullptr && nav->source == OdometrySource::kImuPropagated) WriteImuRate(*nav);
}

void RowFiles::WriteImuRate(const NavOutput& nav) {
  if (last_imu_rate_ && nav.stamp <= *last_imu_rate_) {
    ++num_rows_not_later_;
    return;
  }
  last_imu_rate_ = nav.stamp;
  imu_rate_.Write(TumRow({nav.stamp, nav.T_map_imu}) + "\n");
}

void RowFiles::WriteState(const ScanOutput& output, int segment) {
  const Timestamp stamp = output.filter->nav.stamp;
  const bool is_later =
      !last_state_ || segment > last_state_->segment || stamp > last_state_->stamp;
  if (!is_later) return;
  last_state_ = {segment, stamp};
  states_.Write(StateRow(segment, *output.filter, output.trust));
}

void RowFiles::WriteScan(const ScanOutput& output, int segment) {
  registration_.Write(RegistrationRow(segment, output.scan));
  if (!output.filter) return;
  WriteState(output, segment);
  const NavOutput& nav = output.filter->nav;
  if (last_scan_ && nav.stamp <= *last_scan_) {
    ++num_rows_not_later_;
    return;
  }
  last_scan_ = nav.stamp;
  WriteRow({nav.stamp, nav.T_map_imu}, output.filter->map_as_world_cov, in_map_);
  WriteRow({nav.stamp, nav.T_world_imu}, nav.pose_cov, in_world_);
  level_.Add(*output.filter, output.scan.clock_correction);
  if (base_ && nav.base) base_->Write(TumRow({nav.stamp, nav.base->T_map_base}) + "\n");
}

std::vector<OutputFile*> RowFiles::files() {
  std::vector<OutputFile*> files = {&in_map_.poses,         &in_map_.covariances, &in_world_.poses,
                                    &in_world_.covariances, &imu_rate_,           &states_,
                                    &registration_};
  if (base_) files.push_back(&*base_);
  return files;
}

void RowFiles::Flush() {
  for (OutputFile* file : files()) file->Flush();
  level_.Flush();
}

void RowFiles::Finish() {
  CloseAll(files());
  level_.Finish();
}

}  // namespace lio
