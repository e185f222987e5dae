// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "inflating_reader.hpp"

#include <zstd.h>

#include "bag_limits.hpp"

namespace lio {
namespace {

struct FreeContext {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

class InflatingReader : public BagReader {
 public:
  explicit InflatingReader(std::unique_ptr<BagReader> bag) : bag_(std::move(bag)) {}

  const std::vector<BagTopic>& topics() const override { return bag_->topics(); }
  bool knows_all_topics() const override { return bag_->knows_all_topics(); }
  void Select(std::function<bool(const BagTopic&)> wanted) override {
    bag_->Select(std::move(wanted));
  }
  bool Next(BagMessage& message) override {
    while (bag_->Next(message)) {
      if (Inflate(message.data)) {
        message.data = inflated_;
        return true;
      }
      ++num_damaged_;
    }
    return false;
  }
  const BagDamage& damage() const override {
    damage_ = bag_->damage();
    damage_.num_messages_damaged += num_damaged_;
    if (num_damaged_ > 0 && damage_.first_reason.empty()) {
      damage_.first_reason = "a message that is no Zstandard frame";
    }
    return damage_;
  }
  std::optional<Timestamp> begin_time() const override { return bag_->begin_time(); }
  std::int64_t position_bytes() const override { return bag_->position_bytes(); }
  std::int64_t size_bytes() const override { return bag_->size_bytes(); }

 private:
  // Recorders write whole frames, which say how much they hold.
  bool Inflate(ByteView frame) {
    const unsigned long long size = ZSTD_getFrameContentSize(frame.data(), frame.size());
    if (size > kMaxBagMessageBytes) return false;  // also what zstd's error codes are
    inflated_.resize(static_cast<std::size_t>(size));
    const std::size_t got = ZSTD_decompressDCtx(context_.get(), inflated_.data(), inflated_.size(),
                                                frame.data(), frame.size());
    return !ZSTD_isError(got) && got == inflated_.size();
  }

  std::unique_ptr<BagReader> bag_;
  std::unique_ptr<ZSTD_DCtx, FreeContext> context_{ZSTD_createDCtx()};
  std::vector<std::uint8_t> inflated_;
  std::int64_t num_damaged_ = 0;
  mutable BagDamage damage_;  // the bag's and the frames' together; composed when it is asked for
};

}  // namespace

std::unique_ptr<BagReader> InflateMessages(std::unique_ptr<BagReader> bag) {
  return std::make_unique<InflatingReader>(std::move(bag));
}

}  // namespace lio
