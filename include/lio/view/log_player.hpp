// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Plays what a log has of liod's messages to the viewer, at any speed and from any place. A place
// shows all messages before it: going back begins anew and hurries there.
//
// Timestamps of a log are not trusted: steps back count as none, and long silences are shortened.
// Any thread may give orders; one thread calls Advance.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "lio/view/view_hub.hpp"

namespace lio {

class LogPlayer {
 public:
  static constexpr double kMaxSilence_s = 60.0;
  static constexpr double kMinSpeed = 0.1;
  static constexpr double kMaxSpeed = 100.0;

  // Looks through the whole log once, telling `progress` the bytes so far and in all. Throws
  // InputError naming the log when it has no message of liod's.
  LogPlayer(const std::filesystem::path& log, const std::string& channel_prefix, ViewHub& hub,
            const std::function<void(std::int64_t, std::int64_t)>& progress = {});
  ~LogPlayer();
  LogPlayer(const LogPlayer&) = delete;
  LogPlayer& operator=(const LogPlayer&) = delete;

  // At the end of the log it begins anew.
  void Play();
  void Pause();
  void Seek(double t_s);        // clamped to the log
  void SetSpeed(double speed);  // clamped; NaN is 1

  // Goes on as `elapsed_s` seconds of the host have passed, and shows what is due. One call takes a
  // few thousand messages at most, so that orders are heard while it hurries to a place.
  void Advance(double elapsed_s);

  [[nodiscard]] double duration_s() const;
  [[nodiscard]] std::size_t num_messages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lio
