// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/mode.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace lio {

ModeKind KindOf(const Mode& mode) {
  return static_cast<ModeKind>(mode.index());
}

TrackingStatus StatusOf(const Mode& mode) {
  return std::visit([](const auto& current) { return current.status(); }, mode);
}

std::size_t NextSweepOf(const Mode& mode) {
  return std::visit([](const auto& current) { return current.next_sweep(); }, mode);
}

std::string_view NameOf(ModeKind kind) {
  constexpr std::array<std::string_view, 4> kNames{"Initializing", "Tracking", "LidarOnly",
                                                   "Rejected"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::string_view NameOf(Trigger trigger) {
  constexpr std::array<std::string_view, 11> kNames{"started",
                                                    "no IMU",
                                                    "retry",
                                                    "segment starts",
                                                    "contradicted",
                                                    "lost",
                                                    "convention doubted",
                                                    "IMU appeared",
                                                    "IMU absent",
                                                    "IMU returned",
                                                    "IMU doubted"};
  return kNames.at(static_cast<std::size_t>(trigger));
}

TransitionRule TakeRule(ModeKind from, Trigger trigger, Counters& counters) {
  const std::optional<TransitionRule> rule = FindRule(from, trigger);
  if (!rule) {
    throw std::logic_error(
        fmt::format("no transition from {} by '{}'", NameOf(from), NameOf(trigger)));
  }
  if (rule->is_restart) ++counters.num_restarts;
  if (trigger == Trigger::kLost) ++counters.num_lost;
  return *rule;
}

Mode BuildNext(const Mode& mode, Transition transition, const ModeContext& context) {
  switch (TakeRule(KindOf(mode), transition.trigger, context.counters).to) {
    case ModeKind::kInitializing:
      return Initializing(context, std::move(transition.handover), transition.initializing_since);
    case ModeKind::kTracking: {
      Tracking next(context, std::move(transition.handover), transition.start.value(),
                    transition.is_at_rest);
      if (transition.needs_new_map) next.BeginNewMap();
      return next;
    }
    case ModeKind::kLidarOnly:
      return LidarOnly(context, std::move(transition.handover), transition.seed,
                       std::move(transition.start));
    case ModeKind::kRejected:
      break;
  }
  return Rejected{};
}

}  // namespace lio
