// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/filter_inbox.hpp"

#include <algorithm>
#include <utility>

namespace lio {
namespace {

constexpr std::size_t kMaxChunks = 1 << 16;  // 10 MB where they are empty

}  // namespace

void FilterInbox::Put(Arrival<ImuSample> sample) {
  const std::lock_guard lock(mutex_);
  if (num_imu_ >= max_imu_) {
    ++losses_.num_imu;
    return;
  }
  ++num_imu_;
  messages_.push_back(std::make_unique<InboxItem>(std::move(sample)));
  filled_.notify_one();
}

void FilterInbox::Put(Arrival<ScanChunk> chunk) {
  const std::lock_guard lock(mutex_);
  num_points_ += chunk.data.points.size();
  messages_.push_back(std::make_unique<InboxItem>(std::move(chunk)));
  while (num_points_ > max_points_ || messages_.size() - num_imu_ - num_requests_ > kMaxChunks)
    DropOldestScan();
  filled_.notify_one();
}

void FilterInbox::DropOldestScan() {
  const auto is_chunk = [](const std::unique_ptr<InboxItem>& message) {
    return std::holds_alternative<Arrival<ScanChunk>>(*message);
  };
  const auto oldest = std::find_if(messages_.begin(), messages_.end(), is_chunk);
  if (oldest == messages_.end()) return;
  const std::int32_t scan_seq = std::get<Arrival<ScanChunk>>(**oldest).data.scan_seq;
  std::erase_if(messages_, [&](const std::unique_ptr<InboxItem>& message) {
    const auto* chunk = std::get_if<Arrival<ScanChunk>>(message.get());
    if (chunk == nullptr || chunk->data.scan_seq != scan_seq) return false;
    num_points_ -= chunk->data.points.size();
    ++losses_.num_chunks;
    return true;
  });
}

void FilterInbox::Put(MatchOutcome outcome) {
  const std::lock_guard lock(mutex_);
  outcome_ = std::move(outcome);
  filled_.notify_one();
}

bool FilterInbox::Put(Request request) {
  const std::lock_guard lock(mutex_);
  if (num_requests_ >= kMaxRequests || is_closed_) return false;
  ++num_requests_;
  messages_.push_back(std::make_unique<InboxItem>(std::move(request)));
  filled_.notify_one();
  return true;
}

void FilterInbox::Put(Ping /*ping*/) {
  const std::lock_guard lock(mutex_);
  is_pinged_ = true;
  filled_.notify_one();
}

void FilterInbox::Close() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  filled_.notify_one();
}

std::unique_ptr<InboxItem> FilterInbox::Take() {
  std::unique_lock lock(mutex_);
  filled_.wait(lock, [this] { return is_pinged_ || outcome_ || !messages_.empty() || is_closed_; });
  if (std::exchange(is_pinged_, false)) return std::make_unique<InboxItem>(Ping{});
  if (outcome_) return std::make_unique<InboxItem>(*std::exchange(outcome_, std::nullopt));
  if (messages_.empty()) return nullptr;
  std::unique_ptr<InboxItem> item = std::move(messages_.front());
  messages_.pop_front();
  if (const auto* chunk = std::get_if<Arrival<ScanChunk>>(item.get())) {
    num_points_ -= chunk->data.points.size();
  } else if (std::holds_alternative<Request>(*item)) {
    --num_requests_;
  } else {
    --num_imu_;
  }
  return item;
}

void FilterInbox::EndOutcomes() {
  const std::lock_guard lock(mutex_);
  are_outcomes_over_ = true;
  filled_.notify_one();
}

std::optional<MatchOutcome> FilterInbox::TakeOutcome() {
  std::unique_lock lock(mutex_);
  filled_.wait(lock, [this] { return outcome_ || are_outcomes_over_; });
  return std::exchange(outcome_, std::nullopt);
}

FilterInbox::Losses FilterInbox::waiting() const {
  const std::lock_guard lock(mutex_);
  return {static_cast<std::int64_t>(num_imu_), std::ssize(messages_) -
                                                   static_cast<std::int64_t>(num_imu_) -
                                                   static_cast<std::int64_t>(num_requests_)};
}

FilterInbox::Losses FilterInbox::losses() const {
  const std::lock_guard lock(mutex_);
  return losses_;
}

}  // namespace lio
