// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Searches among posts, with a matcher that is played: it finds the scan from guesses that are near
// enough.
#include "lio/relocalization/relocalizer.hpp"

#include <gtest/gtest.h>

#include "support/standing_things.hpp"

namespace lio {
namespace {

using test::PostsSeenFrom;

constexpr int kNumPoints = 1000;

Pose At(double x_m, double y_m, double yaw_rad) {
  return {ExpSo3(Vector3(0, 0, yaw_rad)), Vector3(x_m, y_m, 0)};
}

MatchResult Matched(const Pose& T_map_imu, double share) {
  MatchResult match;
  match.status = MatchStatus::kConverged;
  match.T_map_imu = T_map_imu;
  match.num_in_map = kNumPoints;
  match.num_matched = static_cast<int>(share * kNumPoints);
  return match;
}

Timestamp StampAt(double t_s) {
  return Timestamp{static_cast<std::int64_t>(1e9 * t_s)};
}

// Finds a scan at `truth` from a guess within a metre of it; elsewhere half its points lie on
// something.
class PlayedMatcher {
 public:
  explicit PlayedMatcher(const Pose& truth) : truth_(truth) {}
  MatchResult operator()(const Pose& guess) {
    ++num_matches;
    const bool is_near = (guess.translation - truth_.translation).norm() < 1.0 &&
                         LogSo3(guess.rotation.conjugate() * truth_.rotation).norm() < 0.1;
    return is_near ? Matched(truth_, 0.98) : Matched(guess, share_elsewhere);
  }
  int num_matches = 0;
  double share_elsewhere = 0.5;

 private:
  Pose truth_;
};

MotionPrior PriorAt(const Pose& T_map_imu, double std_m, double std_rad) {
  MotionPrior prior;
  prior.T_map_imu = T_map_imu;
  prior.cov.diagonal() << Vector3::Constant(std_m * std_m), Vector3::Constant(std_rad * std_rad);
  prior.since_last_fix_s = 1.0;  // as the stamps below
  return prior;
}

class RelocalizerTest : public ::testing::Test {
 protected:
  RelocalizerTest() {
    relocalizer_.SetLocated(StampAt(0.0), PostsSeenFrom(earlier_), Matched(earlier_, 0.98));
  }

  Relocalizer::Found Search(const SearchRequest& request, const MotionPrior& prior) {
    const std::vector<Eigen::Vector3f> points = PostsSeenFrom(truth_);
    const auto match = [this](const Pose& guess, const Matrix6& /*cov*/) {
      return matcher_(guess);
    };
    const auto match_coarsely = [this](const Pose& guess, const Matrix6& /*cov*/) {
      return coarse_(guess);
    };
    return relocalizer_.Search(request, {StampAt(1.0), points}, prior, matcher_(prior.T_map_imu),
                               {match, match_coarsely, max_matches_});
  }

  Pose earlier_ = At(1, 2, 0.5);
  Pose truth_ = At(8, -1, 1.1);
  MotionPrior far_prior_ = PriorAt(At(10.5, 1, 0.9), 1.5, 0.2);
  PlayedMatcher matcher_{truth_};
  PlayedMatcher coarse_{truth_};
  int max_matches_ = 2;
  Relocalizer relocalizer_;
};

TEST(ConvergenceBasin, HoldsAPriorByPointsTwentyMetresAway) {
  Matrix6 cov = Matrix6::Zero();
  cov.diagonal() << Vector3::Constant(1.0), Vector3::Constant(0.0064);  // 1 m and 20 m * 0.08
  EXPECT_TRUE(IsWithinConvergenceBasin(cov));
  cov.diagonal().head<3>().setConstant(2.25);
  EXPECT_FALSE(IsWithinConvergenceBasin(cov));
}

TEST_F(RelocalizerTest, AScanFarFromItsPriorIsFound) {
  const auto found = Search({SearchRegion::kAnywhere, {}}, far_prior_);
  EXPECT_TRUE(found.is_relocalized);
  EXPECT_FALSE(found.is_clock_set);
  EXPECT_EQ(found.match.T_map_imu.translation, truth_.translation);
}

TEST_F(RelocalizerTest, AScanThatIsWherePredictedIsNotSearchedFor) {
  const auto found = Search({SearchRegion::kAnywhere, {}}, PriorAt(truth_, 1.5, 0.2));
  EXPECT_FALSE(found.is_relocalized);
  EXPECT_TRUE(found.match.IsUsable());
  EXPECT_EQ(matcher_.num_matches, 1);
}

TEST_F(RelocalizerTest, AMatchFromASurePriorIsBelieved) {
  matcher_.share_elsewhere = 0.65;
  const auto found = Search({SearchRegion::kAnywhere, {}}, PriorAt(At(3, 3, 0), 0.1, 0.01));
  EXPECT_TRUE(found.match.IsUsable());
  EXPECT_EQ(matcher_.num_matches, 1);
}

TEST_F(RelocalizerTest, AMatchThatLostHalfOfItsSupportIsNotBelievedFromASurePriorEither) {
  for (const SearchRegion region : {SearchRegion::kTracked, SearchRegion::kAnywhere}) {
    matcher_.num_matches = 0;
    const auto found = Search({region, {}}, PriorAt(At(3, 3, 0), 0.1, 0.01));
    EXPECT_EQ(found.match.status, MatchStatus::kTooFewPoints);
    EXPECT_EQ(matcher_.num_matches, 1) << "nothing is searched for";
  }
}

TEST_F(RelocalizerTest, ATrackedScanIsSoughtUnlessTheLastOneWasDegenerate) {
  EXPECT_TRUE(Search({SearchRegion::kTracked, {}}, far_prior_).is_relocalized);
  MatchResult degenerate = Matched(earlier_, 0.98);
  degenerate.degenerate_mask = 1u;
  relocalizer_.SetLocated(StampAt(0.0), PostsSeenFrom(earlier_), degenerate);
  const auto found = Search({SearchRegion::kTracked, {}}, far_prior_);
  EXPECT_FALSE(found.is_relocalized);
  EXPECT_EQ(found.match.status, MatchStatus::kTooFewPoints) << "it is checked all the same";
}

TEST_F(RelocalizerTest, ABentScanNearAnUnsurePriorIsBelievedWithMostOfItsSupport) {
  matcher_.share_elsewhere = 0.8;
  EXPECT_TRUE(Search({SearchRegion::kAnywhere, {}}, far_prior_).match.IsUsable());
  EXPECT_EQ(matcher_.num_matches, 1);
}

TEST_F(RelocalizerTest, AScanThatIsNowhereIsRejected) {
  matcher_ = PlayedMatcher(At(500, 500, 0));
  const auto found = Search({SearchRegion::kAnywhere, {}}, far_prior_);
  EXPECT_FALSE(found.is_relocalized);
  EXPECT_EQ(found.match.status, MatchStatus::kTooFewPoints);
}

TEST_F(RelocalizerTest, TheCoarseMatchesSayWhichCandidateIsMatchedFirst) {
  max_matches_ = 1;
  EXPECT_TRUE(Search({SearchRegion::kAnywhere, {}}, far_prior_).is_relocalized);
  EXPECT_EQ(matcher_.num_matches, 2) << "from the prior, and from the best candidate";
}

TEST_F(RelocalizerTest, TheBudgetHoldsAndTheSearchGoesOnWithTheNextScan) {
  // Coarsely every place looks alike, so that the right one is not matched first.
  coarse_ = PlayedMatcher(At(500, 500, 0));
  relocalizer_.SetLocated(StampAt(0.0), PostsSeenFrom(earlier_), Matched(earlier_, 0.98));
  truth_ = earlier_;  // the last candidate
  matcher_ = PlayedMatcher(truth_);
  max_matches_ = 1;
  int num_scans = 0;
  for (bool is_found = false; !is_found && num_scans < 20; ++num_scans) {
    matcher_.num_matches = 0;
    is_found = Search({SearchRegion::kAnywhere, {}}, far_prior_).is_relocalized;
    EXPECT_LE(matcher_.num_matches, 2);
  }
  EXPECT_LE(num_scans, 13);
}

TEST_F(RelocalizerTest, TheAlternativeHasAMatchOfTheBudget) {
  for (const int max_matches : {1, 2}) {
    max_matches_ = max_matches;
    matcher_ = PlayedMatcher(At(500, 500, 0));
    EXPECT_FALSE(Search({SearchRegion::kAnywhere, At(-30, 0, 0)}, far_prior_).is_clock_set);
    EXPECT_EQ(matcher_.num_matches, 1 + max_matches);
  }
}

TEST_F(RelocalizerTest, AfterADegenerateScanInertialPredictionIsBelieved) {
  MatchResult degenerate = Matched(earlier_, 0.98);
  degenerate.degenerate_mask = 1u;
  relocalizer_.SetLocated(StampAt(0.0), PostsSeenFrom(earlier_), degenerate);
  EXPECT_FALSE(Search({SearchRegion::kObservable, {}}, far_prior_).is_relocalized);
  EXPECT_TRUE(Search({SearchRegion::kAnywhere, {}}, far_prior_).is_relocalized);
}

TEST_F(RelocalizerTest, TheAlternativeIsTakenWhereTheScanIsThere) {
  const MotionPrior sure = PriorAt(At(20, 5, 0.9), 0.1, 0.01);
  EXPECT_TRUE(Search({SearchRegion::kObservable, truth_}, sure).is_clock_set);
  EXPECT_FALSE(Search({SearchRegion::kObservable, At(0, 0, 0)}, sure).is_clock_set);
  EXPECT_FALSE(Search({SearchRegion::kObservable, {}}, sure).is_clock_set);
}

TEST_F(RelocalizerTest, WithoutALocatedScanNothingIsSearched) {
  relocalizer_.Clear();
  const auto found = Search({SearchRegion::kAnywhere, truth_}, far_prior_);
  EXPECT_EQ(matcher_.num_matches, 1);
  EXPECT_FALSE(found.is_relocalized || found.is_clock_set);
}

TEST_F(RelocalizerTest, AlignmentBringsAPriorToWhereThePostsSay) {
  const Pose truth = At(9, -1, 0.5);
  const MotionPrior prior = PriorAt(At(4, 3, 0.5), 3.0, 0.01);
  const std::vector<Eigen::Vector3f> points = PostsSeenFrom(truth);
  const MotionPrior aligned = relocalizer_.Align({StampAt(0.5), points}, prior);
  EXPECT_LT((aligned.T_map_imu.translation - truth.translation).norm(), 0.7);
  EXPECT_LT(aligned.cov(0, 0), prior.cov(0, 0));
  relocalizer_.Clear();
  EXPECT_EQ(relocalizer_.Align({StampAt(0.5), points}, prior).T_map_imu.translation,
            prior.T_map_imu.translation);
}

TEST_F(RelocalizerTest, AVelocityIsFoundFromThreeScans) {
  std::vector<Vector3> found_mps;
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(found_mps.empty());
    const std::vector<Eigen::Vector3f> points = PostsSeenFrom(At(2.0 * i, 0.5 * i, 0.0));
    const auto v_map_mps =
        relocalizer_.FindVelocity({StampAt(0.1 * i), points}, MotionPrior{}).v_map_imu_mps;
    if (v_map_mps) found_mps.push_back(*v_map_mps);
  }
  ASSERT_EQ(found_mps.size(), 1u);
  EXPECT_LT((found_mps[0] - Vector3(20, 5, 0)).norm(), 1.0);
}

}  // namespace
}  // namespace lio
