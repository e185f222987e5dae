// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// All that the page of lio-view shows, made of liod's messages. Poses and points are in `map`. Its
// memory is bounded for any input and any length of a run.
//
// Map, path and states only grow within a generation, and the other parts have a number that grows
// with each change: a client that remembers these needs no queue (client_frame.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "lio/io/map_cloud.hpp"
#include "lio/io/status_report.hpp"
#include "lio/sensor/scan_chunk.hpp"
#include "view/growing_rows.hpp"
#include "view/rate_meter.hpp"

namespace lio {

struct PathRow {
  float x_m = 0.0F;
  float y_m = 0.0F;
  float z_m = 0.0F;
  float status = 0.0F;  // a TrackingStatus
};

// Holds velocity in world [m/s], gyro bias [rad/s], accelerometer bias [m/s^2], NIS (0: no update).
struct StateRow {
  static constexpr std::size_t kNumValues = 10;
  double t_s = 0.0;  // sensor time
  std::array<float, kNumValues> values{};
};

// Gives the uncertainty of the position as an ellipsoid: its axes in map, and a standard deviation
// along each.
struct PositionEllipsoid {
  Quaternion axes = Quaternion::Identity();
  Vector3 std_m = Vector3::Zero();
};
// Takes the position's covariance of `nav`, which is in world, to map.
[[nodiscard]] PositionEllipsoid EllipsoidOf(const NavOutput& nav);

enum class ViewChannel { kOdometry, kOdometryImuRate, kCloud, kCloudFull, kStatus };
inline constexpr std::size_t kNumViewChannels = 5;

// Holds a part with a number that grows when the part changes; 0: there is none.
template <class Part>
struct Numbered {
  Part value{};
  std::uint32_t number = 0;

  void Set(Part part) {
    value = std::move(part);
    ++number;
  }
};

struct ViewedPose {
  NavOutput nav;
  std::int64_t recv_utime = 0;
};

// Holds a place in a recording that is played.
struct Timeline {
  double t_s = 0.0;
  double duration_s = 0.0;
  double speed = 1.0;
  bool is_playing = false;
  bool is_seeking = false;  // it is on the way to t_s
  std::int64_t utime = 0;   // when the recording received what is shown
};

class ViewState {
 public:
  struct Limits {
    std::size_t max_map_points = 2'000'000;
    std::size_t max_scan_points = 300'000;
    std::size_t max_path_rows = 200'000;
    std::size_t max_state_rows = 40'000;  // an hour at 10 Hz, then thinned
  };
  ViewState() : ViewState(Limits{}) {}
  explicit ViewState(const Limits& limits);

  // Takes the messages of liod; recv_utime is the host's clock, or the recording's.
  void OnOdometry(const NavOutput& nav, std::int64_t recv_utime);
  void OnFilterState(const FilterReport& report);
  void OnRegistration(const ScanReport& report) { registration_.Set(report); }
  void OnStatus(const StatusReport& report, std::int64_t recv_utime);
  void OnCloud(const ScanChunk& chunk, std::int64_t recv_utime, bool is_full);
  void CountRefused() { ++num_refused_; }
  void SetTimeline(const Timeline& timeline) { timeline_.Set(timeline); }

  // Forgets all but the timeline: another run begins, or the recording is played from another
  // place.
  void Clear();

  [[nodiscard]] const MapCloud& map() const { return map_; }
  [[nodiscard]] std::uint32_t map_generation() const { return map_generation_; }
  [[nodiscard]] const GrowingRows<PathRow>& path() const { return path_; }
  [[nodiscard]] const GrowingRows<StateRow>& states() const { return states_; }
  [[nodiscard]] const Numbered<ViewedPose>& pose() const { return pose_; }
  [[nodiscard]] const Numbered<std::vector<Eigen::Vector3f>>& scan() const { return scan_; }
  [[nodiscard]] const Numbered<StatusReport>& status() const { return status_; }
  [[nodiscard]] const Numbered<ScanReport>& registration() const { return registration_; }
  [[nodiscard]] const Numbered<Timeline>& timeline() const { return timeline_; }
  [[nodiscard]] double RateHz(ViewChannel channel, std::int64_t now_utime) const {
    return rates_[static_cast<std::size_t>(channel)].RateHz(now_utime);
  }
  [[nodiscard]] std::int64_t num_refused() const { return num_refused_; }
  [[nodiscard]] std::int64_t num_runs() const { return num_runs_; }

 private:
  void Count(ViewChannel channel, std::int64_t recv_utime) {
    rates_[static_cast<std::size_t>(channel)].Add(recv_utime);
  }
  [[nodiscard]] bool GoesBack(const NavOutput& nav) const;
  [[nodiscard]] bool IsAnotherRun(const StatusReport& report) const;
  void FinishScan();

  Limits limits_;
  MapCloud map_;
  std::uint32_t map_generation_ = 1;
  GrowingRows<PathRow> path_;
  GrowingRows<StateRow> states_;
  Numbered<ViewedPose> pose_;
  std::map<OdometrySource, Timestamp> newest_stamps_;
  Numbered<std::vector<Eigen::Vector3f>> scan_;
  Numbered<StatusReport> status_;
  Numbered<ScanReport> registration_;
  Numbered<Timeline> timeline_;
  std::array<RateMeter, kNumViewChannels> rates_;
  std::vector<Eigen::Vector3f> arriving_scan_;
  std::int32_t arriving_seq_ = 0;
  std::int64_t last_full_utime_ = 0;
  std::int64_t num_refused_ = 0;
  std::int64_t num_runs_ = 0;
};

}  // namespace lio
