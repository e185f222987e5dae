// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/scan_assembler.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "stream/stream_parameters.hpp"

namespace lio {

Duration LastOffset(const ScanChunk& chunk) {
  std::uint32_t last = 0;
  for (const LidarPoint& point : chunk.points) last = std::max(last, point.t_offset_ns);
  return Duration{last};
}

namespace {

bool IsUsable(const ScanChunk& chunk) {
  return chunk.chunk_count > 0 && chunk.chunk_index >= 0 && chunk.chunk_index < chunk.chunk_count;
}

// Returns the share of the slots before the first one that is filled.
double ShareBefore(const std::vector<ScanChunk>& chunks) {
  const auto first = std::find_if(chunks.begin(), chunks.end(),
                                  [](const ScanChunk& chunk) { return chunk.chunk_count != 0; });
  return static_cast<double>(first - chunks.begin()) / static_cast<double>(chunks.size());
}

}  // namespace

// The same number far away in time is another sweep, after a restart of the sender.
bool ScanAssembler::SweepName::Names(const ScanChunk& chunk) const {
  return scan_seq == chunk.scan_seq && sensor_id == chunk.sensor_id &&
         chunk.stamp - first < kSweep.max_span && last - chunk.stamp < kSweep.max_span;
}

// A chunk is torn off when it is farther from the rest of its sweep than the sweep is long: a clock
// stepped in between.
bool ScanAssembler::IsTornOff(const ScanChunk& chunk, Timestamp last) const {
  if (span_ == Duration{}) return false;
  const Duration reach = span_ + kScanAssembler.jitter;
  return std::any_of(open_.begin(), open_.end(), [&](const Partial& partial) {
    return partial.name.Names(chunk) &&
           (chunk.stamp - partial.name.last > reach || partial.name.first - last > reach);
  });
}

// One chunk with a false count must neither close a sweep nor make a loss.
bool ScanAssembler::IsCountDoubtful(const ScanChunk& chunk) {
  const int believed = usual_count_ == 0
                           ? kScanAssembler.max_first_chunks
                           : std::max(kScanAssembler.max_believed_chunks, 2 * usual_count_);
  const bool is_of_open = std::any_of(open_.begin(), open_.end(), [&](const Partial& partial) {
    return partial.name.Names(chunk) &&
           static_cast<int>(partial.chunks.size()) == chunk.chunk_count;
  });
  if (chunk.chunk_count <= believed || is_of_open) return false;
  const bool is_borne_out =
      doubtful_ && doubtful_->chunk_count == chunk.chunk_count &&
      doubtful_->chunk_index != chunk.chunk_index &&
      SweepName{doubtful_->scan_seq, doubtful_->sensor_id, doubtful_->stamp, doubtful_->stamp}
          .Names(chunk);
  if (is_borne_out) return false;
  doubtful_ = chunk;
  doubtful_->points.clear();
  return true;
}

ScanAssembler::Partial* ScanAssembler::FindOrOpen(const ScanChunk& chunk) {
  for (Partial& partial : open_) {
    if (!partial.name.Names(chunk)) continue;
    return static_cast<int>(partial.chunks.size()) == chunk.chunk_count ? &partial : nullptr;
  }
  const bool is_late = std::any_of(closed_names_.begin(), closed_names_.end(),
                                   [&](const SweepName& name) { return name.Names(chunk); });
  if (is_late) return nullptr;
  if (open_.size() == kScanAssembler.max_open_sweeps) CloseOneFor(chunk.stamp);
  Partial partial;
  partial.name = {chunk.scan_seq, chunk.sensor_id, chunk.stamp, chunk.stamp};
  partial.chunks.resize(static_cast<std::size_t>(chunk.chunk_count));
  for (ScanChunk& slot : partial.chunks) slot.chunk_count = 0;
  const auto after = std::find_if(open_.begin(), open_.end(),
                                  [&](const Partial& p) { return chunk.stamp < p.name.first; });
  counters_->ledgers.scans.Receive();
  return &*open_.insert(after, std::move(partial));
}

void ScanAssembler::Add(ScanChunk chunk, std::int64_t decode_ns) {
  ++counters_->num_chunks;
  const Duration last_offset = LastOffset(chunk);
  const Timestamp last = chunk.stamp + last_offset;
  if (!IsUsable(chunk) || last_offset > kSweep.max_span || IsTornOff(chunk, last) ||
      IsCountDoubtful(chunk)) {
    ++counters_->num_chunks_bad;
    counters_->ledgers.chunks.Settle(ChunkFate::kBad);
    return;
  }
  Partial* partial = FindOrOpen(chunk);
  if (partial == nullptr) {
    ++counters_->num_chunks_late;
    counters_->ledgers.chunks.Settle(ChunkFate::kLate);
    return;
  }
  ScanChunk& slot = partial->chunks[static_cast<std::size_t>(chunk.chunk_index)];
  if (slot.chunk_count != 0) {
    ++counters_->num_chunks_duplicate;
    counters_->ledgers.chunks.Settle(ChunkFate::kDuplicate);
    return;
  }
  if (partial->num_points + chunk.points.size() > kScanAssembler.max_points) {
    ++counters_->num_chunks_bad;
    counters_->ledgers.chunks.Settle(ChunkFate::kBad);
    return;
  }
  counters_->ledgers.chunks.Settle(ChunkFate::kUsed);
  partial->num_points += chunk.points.size();
  partial->name.first = std::min(partial->name.first, chunk.stamp);
  partial->name.last = std::max(partial->name.last, last);
  partial->decode_ns += decode_ns;
  slot = std::move(chunk);
  ++partial->num_received;
  while (!open_.empty() &&
         open_.front().num_received == static_cast<int>(open_.front().chunks.size())) {
    Close(0);
  }
}

void ScanAssembler::CloseUpTo(Timestamp stamp) {
  const auto end = [&](const SweepName& name) { return std::max(name.last, name.first + span_); };
  while (!open_.empty() && end(open_.front().name) < stamp) Close(0);
}

void ScanAssembler::CloseAll() {
  while (!open_.empty()) Close(0);
}

void ScanAssembler::CloseSegment(Timestamp end, Timestamp next_begin) {
  for (std::size_t i = open_.size(); i-- > 0;) {
    const Timestamp at = open_[i].name.first;
    if (Abs(at - end) < Abs(at - next_begin)) Close(i);
  }
}

// Closes the oldest, unless stamps have jumped: what was left of before the jump will never be
// whole.
void ScanAssembler::CloseOneFor(Timestamp stamp) {
  const bool newest_is_apart = Abs(stamp - open_.back().name.first) > kScanAssembler.apart;
  const bool oldest_is_apart = Abs(stamp - open_.front().name.first) > kScanAssembler.apart;
  Close(newest_is_apart && !oldest_is_apart ? open_.size() - 1 : 0);
}

// A lone chunk may be false: it is believed when its count and its number are like those before.
bool ScanAssembler::TellsWhatIsMissing(const Partial& partial) const {
  if (partial.num_received > 1) return true;
  if (usual_count_ == 0) {
    return static_cast<int>(partial.chunks.size()) <= kScanAssembler.max_believed_chunks;
  }
  const std::int64_t step = std::int64_t{partial.name.scan_seq} - closed_names_.back().scan_seq;
  return static_cast<int>(partial.chunks.size()) <= 2 * usual_count_ &&
         std::abs(step) <= kScanAssembler.max_seq_step;
}

void ScanAssembler::Close(std::size_t at) {
  Partial partial = std::move(open_[at]);
  open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(at));
  Sweep sweep;
  sweep.start = partial.name.first;
  sweep.end = partial.name.last;
  sweep.scan_seq = partial.name.scan_seq;
  sweep.decode_ns = partial.decode_ns;
  sweep.num_missing_chunks = static_cast<int>(partial.chunks.size()) - partial.num_received;
  sweep.share_before = ShareBefore(partial.chunks);
  if (TellsWhatIsMissing(partial)) counters_->num_chunks_missing += sweep.num_missing_chunks;
  if (partial.num_received > 1) usual_count_ = static_cast<int>(partial.chunks.size());
  if (sweep.num_missing_chunks == 0) span_ = std::min(sweep.end - sweep.start, kSweep.max_span);
  if (partial.chunks.size() == 1) {
    sweep.points = std::move(partial.chunks.front().points);
  } else {
    std::size_t num_points = 0;
    for (const ScanChunk& chunk : partial.chunks) num_points += chunk.points.size();
    sweep.points.reserve(num_points);
    for (const ScanChunk& chunk : partial.chunks) {
      const auto shift = static_cast<std::uint32_t>((chunk.stamp - sweep.start).ns);
      for (LidarPoint point : chunk.points) {
        point.t_offset_ns += shift;
        sweep.points.push_back(point);
      }
    }
  }
  closed_names_.push_back(partial.name);
  if (closed_names_.size() > kScanAssembler.max_closed_names) closed_names_.pop_front();
  closed_.push_back(std::move(sweep));
}

std::optional<Sweep> ScanAssembler::Take() {
  if (closed_.empty()) return std::nullopt;
  Sweep sweep = std::move(closed_.front());
  closed_.pop_front();
  return sweep;
}

}  // namespace lio
