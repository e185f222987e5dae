// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/lcm_codec.hpp"

namespace lio {

std::string_view Name(DecodeStatus status) {
  switch (status) {
    case DecodeStatus::kOk:
      return "ok";
    case DecodeStatus::kTruncated:
      return "truncated";
    case DecodeStatus::kWrongType:
      return "wrong_type";
    case DecodeStatus::kSizeMismatch:
      return "size_mismatch";
    case DecodeStatus::kBadFormat:
      return "bad_format";
    case DecodeStatus::kTooLarge:
      return "too_large";
  }
  return "unknown";
}

}  // namespace lio
