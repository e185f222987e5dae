// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/options_fields.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace lio {
namespace {

// The number of members of an aggregate: the most values its braces take.
struct AnyValue {
  template <class T>
  operator T() const {
    return {};
  }
};

template <class T, class... Values>
constexpr int NumMembers() {
  if constexpr (requires { T{Values{}..., AnyValue{}}; }) {
    return NumMembers<T, Values..., AnyValue>();
  } else {
    return sizeof...(Values);
  }
}

// It is no aggregate: a pose and two standard deviations.
template <>
constexpr int NumMembers<Extrinsic>() {
  return NumMembers<Pose>() + 2;
}

// Compares each struct's members with its listed fields, nested ones too.
class FieldCounter {
 public:
  template <class T>
  static void Check(const T& group) {
    FieldCounter counter;
    VisitFields(counter, group);
    EXPECT_EQ(counter.keys_.size(), static_cast<std::size_t>(NumMembers<T>()))
        << "a member of a struct is not listed in options_fields.hpp; listed are:" << counter.list_;
  }

  template <class T>
  void operator()(const char* key, const T& field, const char* meaning, Range range = {}) {
    EXPECT_TRUE(keys_.insert(key).second) << key << " is listed twice";
    EXPECT_NE(std::string(meaning), "") << key;
    EXPECT_LE(range.min, range.max) << key;
    list_ += std::string(" ") + key;
    if constexpr (kIsGroup<T>) Check(field);
  }
  template <class T>
  void operator()(const char* key, const std::optional<T>&, const char* meaning) {
    (*this)(key, T{}, meaning);
  }

 private:
  std::set<std::string> keys_;
  std::string list_;
};

TEST(OptionsFields, EveryMemberIsListedOnce) {
  FieldCounter::Check(Options{});
}

TEST(OptionsFields, EnumNamesMatchTheirValues) {
  EXPECT_EQ(kEnumNames<MatchMethod>[static_cast<int>(MatchMethod::kGicp)], "gicp");
  EXPECT_EQ(kEnumNames<GravityInput>[static_cast<int>(GravityInput::kRemoved)], "removed");
}

}  // namespace
}  // namespace lio
