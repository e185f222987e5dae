// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/client_frame.hpp"

#include <algorithm>

#include "view/frame_writer.hpp"
#include "view/status_json.hpp"

namespace lio {
namespace {

constexpr std::int64_t kStatusInterval_us = 500'000;

// True when the client lacks rows, or must forget those that it has.
bool IsBehind(ClientCursor::Rows& cursor, std::uint32_t generation, std::size_t num) {
  if (cursor.generation != generation || cursor.num > num) {
    cursor = {generation, 0};
    return true;
  }
  return cursor.num < num;
}

void PutRange(FrameWriter& writer, const ClientCursor::Rows& cursor, std::size_t num) {
  writer.Put(cursor.generation);
  writer.Put(static_cast<std::uint32_t>(cursor.num));
  writer.Put(static_cast<std::uint32_t>(num));
}

void AddMap(const ViewState& view, const FrameBudget& budget, ClientCursor& cursor,
            FrameWriter& writer) {
  const auto& points = view.map().points_map();
  if (!IsBehind(cursor.map, view.map_generation(), points.size())) return;
  const std::size_t count = std::min(budget.max_map_points, points.size() - cursor.map.num);
  writer.Begin(Section::kMap);
  PutRange(writer, cursor.map, points.size());
  writer.Put(static_cast<float>(view.map().voxel_m()));
  writer.PutPoints(std::span(points).subspan(cursor.map.num, count));
  writer.End();
  cursor.map.num += count;
}

void AddPath(const ViewState& view, const FrameBudget& budget, ClientCursor& cursor,
             FrameWriter& writer) {
  const auto& rows = view.path().rows();
  if (!IsBehind(cursor.path, view.path().generation(), rows.size())) return;
  const std::size_t count = std::min(budget.max_rows, rows.size() - cursor.path.num);
  writer.Begin(Section::kPath);
  PutRange(writer, cursor.path, rows.size());
  writer.Put(static_cast<std::uint32_t>(count));
  for (const PathRow& row : std::span(rows).subspan(cursor.path.num, count)) {
    for (const float value : {row.x_m, row.y_m, row.z_m, row.status}) writer.Put(value);
  }
  writer.End();
  cursor.path.num += count;
}

void AddStates(const ViewState& view, const FrameBudget& budget, ClientCursor& cursor,
               FrameWriter& writer) {
  const auto& rows = view.states().rows();
  if (!IsBehind(cursor.states, view.states().generation(), rows.size())) return;
  const std::size_t count = std::min(budget.max_rows, rows.size() - cursor.states.num);
  const double begin_s = rows.empty() ? 0.0 : rows.front().t_s;
  writer.Begin(Section::kStates);
  PutRange(writer, cursor.states, rows.size());
  writer.Put(static_cast<std::uint32_t>(count));
  writer.Put(begin_s);
  for (const StateRow& row : std::span(rows).subspan(cursor.states.num, count)) {
    writer.Put(static_cast<float>(row.t_s - begin_s));
    for (const float value : row.values) writer.Put(value);
  }
  writer.End();
  cursor.states.num += count;
}

// Returns true when the client lacks the part; counts the ones that it will never see.
bool IsNew(std::uint32_t number, std::uint32_t& seen, std::uint32_t& num_left_out) {
  if (number == 0 || number == seen) return false;
  if (seen > 0 && number > seen + 1) num_left_out += number - seen - 1;
  seen = number;
  return true;
}

void AddScan(const ViewState& view, ClientCursor& cursor, FrameWriter& writer) {
  if (!IsNew(view.scan().number, cursor.scan, cursor.num_scans_left_out)) return;
  writer.Begin(Section::kScan);
  writer.Put(view.scan().number);
  writer.Put(cursor.num_scans_left_out);
  writer.PutPoints(view.scan().value);
  writer.End();
}

void AddPose(const ViewState& view, ClientCursor& cursor, FrameWriter& writer) {
  if (!IsNew(view.pose().number, cursor.pose, cursor.num_poses_left_out)) return;
  const ViewedPose& pose = view.pose().value;
  const PositionEllipsoid ellipsoid = EllipsoidOf(pose.nav);
  writer.Begin(Section::kPose);
  writer.Put(1e-9 * static_cast<double>(pose.nav.stamp.ns));
  writer.Put(1e-6 * static_cast<double>(pose.recv_utime));
  writer.PutFloats(pose.nav.T_map_imu.translation);
  writer.PutFloats(pose.nav.T_map_imu.rotation.coeffs());  // x, y, z, w
  writer.PutFloats(ellipsoid.axes.coeffs());
  writer.PutFloats(ellipsoid.std_m);
  writer.PutFloats(pose.nav.v_world_imu_mps);
  writer.Put(static_cast<float>(pose.nav.status));
  writer.Put(cursor.num_poses_left_out);
  writer.End();
}

void AddStatus(const ViewState& view, std::int64_t now_utime, ClientCursor& cursor,
               FrameWriter& writer) {
  const bool is_due = now_utime - cursor.status_utime >= kStatusInterval_us;
  if (!is_due && view.status().number == cursor.status) return;
  cursor.status = view.status().number;
  cursor.status_utime = now_utime;
  writer.Text(Section::kStatus, StatusJson(view, now_utime));
}

void AddTimeline(const ViewState& view, ClientCursor& cursor, FrameWriter& writer) {
  if (view.timeline().number == cursor.timeline) return;
  cursor.timeline = view.timeline().number;
  writer.Text(Section::kTimeline, TimelineJson(view.timeline().value));
}

}  // namespace

std::optional<Bytes> NextFrame(const ViewState& view, std::int64_t now_utime, ClientCursor& cursor,
                               const FrameBudget& budget) {
  FrameWriter writer;
  AddMap(view, budget, cursor, writer);
  AddPath(view, budget, cursor, writer);
  AddStates(view, budget, cursor, writer);
  AddScan(view, cursor, writer);
  AddPose(view, cursor, writer);
  AddStatus(view, now_utime, cursor, writer);
  AddTimeline(view, cursor, writer);
  if (writer.is_empty()) return std::nullopt;
  return writer.Take();
}

}  // namespace lio
