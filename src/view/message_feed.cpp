// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/message_feed.hpp"

#include <algorithm>

#include "lio/io/output_decoder.hpp"
#include "view/view_state.hpp"

namespace lio {
namespace {

// Decodes outside of the lock, and lets `use` change the state.
template <typename Message, typename Use>
void TakeAs(DecodeStatus (*decode)(ByteView, Message&), ByteView bytes, ViewHub& hub,
            const Use& use) {
  Message message;
  const bool is_sound = decode(bytes, message) == DecodeStatus::kOk;
  hub.Change([&](ViewState& view) {
    if (is_sound) {
      use(view, message);
    } else {
      view.CountRefused();
    }
  });
}

}  // namespace

std::vector<std::string> MessageFeed::Names() const {
  return {channels_.odometry,  channels_.odometry_imu_rate,
          channels_.state,     channels_.registration,
          channels_.status,    channels_.cloud,
          channels_.cloud_full};
}

bool MessageFeed::Takes(std::string_view channel) const {
  const std::vector<std::string> names = Names();
  return std::find(names.begin(), names.end(), channel) != names.end();
}

void MessageFeed::Take(std::string_view channel, ByteView bytes, std::int64_t recv_utime) {
  if (channel == channels_.odometry || channel == channels_.odometry_imu_rate) {
    TakeAs<NavOutput>(&DecodeOdometry, bytes, hub_, [&](ViewState& view, const NavOutput& nav) {
      view.OnOdometry(nav, recv_utime);
    });
  } else if (channel == channels_.state) {
    TakeAs<FilterReport>(
        &DecodeFilterState, bytes, hub_,
        [](ViewState& view, const FilterReport& report) { view.OnFilterState(report); });
  } else if (channel == channels_.registration) {
    TakeAs<ScanReport>(
        &DecodeRegistration, bytes, hub_,
        [](ViewState& view, const ScanReport& report) { view.OnRegistration(report); });
  } else if (channel == channels_.status) {
    TakeAs<StatusReport>(
        &DecodeStatusReport, bytes, hub_,
        [&](ViewState& view, const StatusReport& report) { view.OnStatus(report, recv_utime); });
  } else if (channel == channels_.cloud || channel == channels_.cloud_full) {
    TakeAs<ScanChunk>(&DecodeChunk, bytes, hub_, [&](ViewState& view, const ScanChunk& chunk) {
      view.OnCloud(chunk, recv_utime, channel == channels_.cloud_full);
    });
  }
}

}  // namespace lio
