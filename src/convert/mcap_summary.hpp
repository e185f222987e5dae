// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the summary at the end of an MCAP file, which repeats the topics and counts the messages. A
// recorder that died leaves none.
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>

#include "mcap_record.hpp"
#include "mcap_topics.hpp"

namespace lio {

struct McapSummary {
  bool has_footer = false;  // the file was closed by its recorder
  bool is_damaged = false;  // its checksum is wrong, or it is not where the footer says
  std::optional<McapStatistics> statistics;
};

// Adds the summary's topics to `topics`. The position of `file` is moved; `size_bytes` is that of
// the whole file.
[[nodiscard]] McapSummary ReadMcapSummary(std::ifstream& file, std::uint64_t size_bytes,
                                          McapTopics& topics);

}  // namespace lio
