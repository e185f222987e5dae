// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/command_desk.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "app/command_rules.hpp"
#include "app/end_run.hpp"
#include "lio/io/host_clock.hpp"

namespace lio {

CommandDesk::CommandDesk(const Neighbours& neighbours, const Setting& setting,
                         std::function<RunStats()> make_stats, OnFault on_write_failure)
    : to_(neighbours),
      setting_(setting),
      make_stats_(std::move(make_stats)),
      on_write_failure_(std::move(on_write_failure)) {}

void CommandDesk::Answer(const Request& request, bool is_done, const std::string& text) {
  const Command& command = request.command;
  spdlog::log(is_done ? spdlog::level::info : spdlog::level::warn, "{}: {}{}",
              request.is_answered ? fmt::format("command {}", command.request_id) : "signal",
              is_done ? "" : "refused, ", text);
  if (!is_done) to_.board.CountRefusedCommand();
  if (!request.is_answered) return;
  to_.publisher.Publish(Reply{HostUtime(), command.request_id,
                              static_cast<std::int32_t>(command.action), is_done, text});
}

void CommandDesk::Refuse(const Command& command, const std::string& why) {
  Answer({command}, false, why);
}

std::string CommandDesk::WhyNotNow(const Command& command) const {
  if (std::string why = WhyUnusable(command); !why.empty()) return why;
  if (to_.filter.is_cut_short()) return "liod is ending";
  switch (command.action) {
    case CommandAction::kNewFiles:
      if (setting_.files == nullptr) return "no files are written: start liod with --out";
      break;
    case CommandAction::kSaveMap:
      if (!setting_.collects_map) return "the map is kept only with --out and --map";
      break;
    case CommandAction::kResetAtPose:
      if (setting_.has_initial_map) {
        return "with an initial map the place in it is sought: use RESET";
      }
      break;
    default:
      break;
  }
  return {};
}

void CommandDesk::Obey(const Request& request) {
  const std::string why_not = WhyNotNow(request.command);
  if (why_not.empty()) {
    Do(request);
  } else {
    Answer(request, false, why_not);
  }
}

void CommandDesk::Do(const Request& request) {
  switch (request.command.action) {
    case CommandAction::kCloudFullOff:
    case CommandAction::kCloudFullOn: {
      const bool publishes = request.command.action == CommandAction::kCloudFullOn;
      to_.filter.PublishFullCloud(publishes);
      return Answer(request, true, publishes ? "LIO_CLOUD_FULL is on" : "LIO_CLOUD_FULL is off");
    }
    case CommandAction::kReset:
    case CommandAction::kResetAtPose:
      return Reset(request);
    case CommandAction::kSaveMap:
      return SaveMap(request);
    case CommandAction::kNewFiles:
      return RenewFiles(request);
    case CommandAction::kStatusNow:
      to_.board.TellOptions();
      to_.output_worker.AnnounceStatus();
      return Answer(request, true, "LIO_STATUS comes now");
  }
}

void CommandDesk::Reset(const Request& request) {
  // The files of one folder are about one world.
  if (setting_.files != nullptr) RenewFiles({.command = request.command, .is_answered = false});
  const bool has_pose = request.command.action == CommandAction::kResetAtPose;
  const auto at = has_pose ? std::optional(PoseOf(request.command)) : std::nullopt;
  to_.filter.Reset(
      at, fmt::format("command {}: the estimate begins anew{}, in a new map",
                      request.command.request_id, has_pose ? " at the pose that was given" : ""));
  Answer(request, true, "the estimate begins anew, in a new map");
}

void CommandDesk::RenewFiles(const Request& request) {
  to_.output_worker.Put([this, request, stats = make_stats_()](RunWriter*) {
    RunSeries& files = *setting_.files;
    const std::string before = files.folder().string();
    files.Renew(stats);
    TellVerdict(stats.verdict);
    const bool is_done = files.writer() != nullptr;
    if (files.failure()) on_write_failure_(*files.failure());
    const std::string text = is_done ? fmt::format("the run in {} is complete, files go on in {}",
                                                   before, files.folder().string())
                                     : files.failure().value_or("no files can be made");
    const bool is_of_reset = request.command.action != CommandAction::kNewFiles;
    if (is_of_reset) {
      spdlog::info("{}", text);
    } else {
      Answer(request, is_done, text);
    }
    return files.writer();
  });
}

void CommandDesk::SaveMap(const Request& request) {
  to_.match_worker.Tell([this, request](std::vector<Eigen::Vector3f> points) {
    to_.output_worker.Put([this, request, points = std::move(points)](RunWriter* writer) {
      if (writer == nullptr) {
        Answer(request, false, "the files could not be written: see the note of LIO_STATUS");
        return writer;
      }
      const std::string& name = request.command.name;
      const std::string path = (setting_.files->folder() / name).string();
      std::string failure = WhyInputIsLost(setting_.inputs, {path});
      if (failure.empty()) failure = writer->SaveMap(points, name);
      Answer(request, failure.empty(),
             failure.empty() ? fmt::format("{} points are in {}", points.size(), path) : failure);
      return writer;
    });
  });
}

}  // namespace lio
