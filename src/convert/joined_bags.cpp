// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "joined_bags.hpp"

#include <algorithm>
#include <limits>

#include "lio/io/input_error.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

struct Part {
  fs::path path;
  Timestamp begin;  // receive time of its first message; the latest possible where there is none
  std::int64_t size_bytes = 0;
};

void AddDamage(const BagDamage& more, BagDamage& sum) {
  sum.cut_short = sum.cut_short || more.cut_short;
  sum.not_closed = sum.not_closed || more.not_closed;
  sum.lost_bytes += more.lost_bytes;
  sum.num_chunks_damaged += more.num_chunks_damaged;
  sum.num_messages_damaged += more.num_messages_damaged;
  sum.num_messages_missing += more.num_messages_missing;
  if (sum.first_reason.empty()) sum.first_reason = more.first_reason;
}

class JoinedBags : public BagReader {
 public:
  explicit JoinedBags(BagParts bags) : bags_(std::move(bags)) {
    for (const fs::path& path : bags_.paths) LookAt(path);
    if (parts_.empty()) throw InputError(bags_.paths.front().string() + ": no such file");
    std::stable_sort(parts_.begin(), parts_.end(),
                     [](const Part& a, const Part& b) { return a.begin < b.begin; });
    Open();
  }

  const std::vector<BagTopic>& topics() const override { return topics_; }
  bool knows_all_topics() const override { return knows_all_topics_; }
  void Select(std::function<bool(const BagTopic&)> wanted) override {
    wanted_ = std::move(wanted);
    reader_->Select(wanted_);
  }

  bool Next(BagMessage& message) override {
    for (;;) {
      if (is_left_) return false;
      const bool is_read = reader_->Next(message);
      damage_ = damage_before_;
      AddDamage(reader_->damage(), damage_);
      if (is_read) break;
      Leave();
      if (at_ + 1 >= parts_.size()) return Finish();
      ++at_;
      Open();
    }
    message.topic = Index(reader_->topics()[message.topic]);
    ++topics_[message.topic].num_messages;
    if (!begin_time_) begin_time_ = reader_->begin_time();
    return true;
  }

  const BagDamage& damage() const override { return damage_; }
  std::optional<Timestamp> begin_time() const override { return begin_time_; }
  std::int64_t position_bytes() const override {
    return bytes_before_ + (is_left_ ? 0 : reader_->position_bytes());
  }
  std::int64_t size_bytes() const override { return size_bytes_; }

 private:
  void LookAt(const fs::path& path) {
    if (!fs::exists(path)) {
      damage_before_.cut_short = true;
      damage_before_.first_reason = path.filename().string() + " is missing";
      return;
    }
    const auto reader = bags_.open(path);
    BagMessage message;
    constexpr Timestamp kNever{std::numeric_limits<std::int64_t>::max()};
    const bool has_message = reader->Next(message);
    parts_.push_back({path, has_message ? message.received : kNever, reader->size_bytes()});
    knows_all_topics_ = knows_all_topics_ && reader->knows_all_topics();
    size_bytes_ += reader->size_bytes();
    for (const BagTopic& topic : reader->topics()) Index(topic);
  }

  void Open() {
    is_left_ = false;
    reader_ = bags_.open(parts_[at_].path);
    if (wanted_) reader_->Select(wanted_);
  }

  // Counts a part that is read to its end. Messages that nobody wanted are counted by the part
  // only.
  void Leave() {
    is_left_ = true;
    damage_before_ = damage_;
    bytes_before_ += parts_[at_].size_bytes;
    for (const BagTopic& topic : reader_->topics()) {
      num_read_ += topic.num_messages;
      if (wanted_ && !wanted_(topic)) topics_[Index(topic)].num_messages += topic.num_messages;
    }
  }

  // Compares the number of messages with that of the metadata.
  bool Finish() {
    const std::int64_t missing = bags_.num_messages - num_read_;
    if (missing <= 0) return false;
    damage_.cut_short = damage_.cut_short || !damage_.Any();
    damage_.num_messages_missing = missing;
    if (damage_.first_reason.empty()) {
      damage_.first_reason = std::to_string(num_read_) + " of " +
                             std::to_string(bags_.num_messages) + " messages exist";
    }
    return false;
  }

  // Returns the place of the topic in the joined list, to which it is added when it is new.
  std::size_t Index(const BagTopic& topic) {
    const auto found = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& other) {
      return other.name == topic.name && other.type == topic.type;
    });
    if (found != topics_.end()) return static_cast<std::size_t>(found - topics_.begin());
    topics_.push_back(topic);
    topics_.back().num_messages = 0;
    return topics_.size() - 1;
  }

  BagParts bags_;
  std::vector<Part> parts_;
  std::vector<BagTopic> topics_;
  bool knows_all_topics_ = true;
  std::function<bool(const BagTopic&)> wanted_;
  std::size_t at_ = 0;  // the part that is being read
  std::unique_ptr<BagReader> reader_;
  bool is_left_ = false;
  std::optional<Timestamp> begin_time_;
  BagDamage damage_;
  BagDamage damage_before_;  // in the parts before
  std::int64_t bytes_before_ = 0;
  std::int64_t num_read_ = 0;  // from the parts before
  std::int64_t size_bytes_ = 0;
};

}  // namespace

std::vector<fs::path> BagsOfFolder(const fs::path& folder) {
  std::vector<fs::path> bags;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.is_regular_file(ignored) && entry.path().extension() == ".bag") {
      bags.push_back(entry.path());
    }
  }
  std::sort(bags.begin(), bags.end());
  return bags;
}

std::unique_ptr<BagReader> JoinBags(BagParts parts) {
  return std::make_unique<JoinedBags>(std::move(parts));
}

}  // namespace lio
