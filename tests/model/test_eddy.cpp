// Lifetimes of gusts: the eddy's own or the time to cross it, and how they are spread.

#include "model/eddy.h"

#include <gtest/gtest.h>

using namespace ClusterDEM;

TEST(Eddy, EndsWhenItsTimeIsOverOrItIsCrossed)
{
  // relative velocity (3, 0, 4) + (1, 2, 1) * (1, -0.5, -1) = (4, -1, 3): sqrt(26) m/s
  EddyHere here = {2.0, 5.0, {3.0, 0.0, 4.0}, {1.0, 2.0, 1.0}};
  EXPECT_DOUBLE_EQ(here.lifetime({1.0, -0.5, -1.0}), 5.0 / std::sqrt(26.0));
  here.period = 0.5;
  EXPECT_DOUBLE_EQ(here.lifetime({1.0, -0.5, -1.0}), 0.5);
  here.size = INFINITY;
  here.period = 7.0;
  EXPECT_DOUBLE_EQ(here.lifetime({1.0, 1.0, 1.0}), 7.0);
  here = {2.0, 5.0, {}, {}};    // at rest in the gas
  EXPECT_DOUBLE_EQ(here.lifetime({1.0, 1.0, 1.0}), 2.0);
}

TEST(Eddy, SharesHaveTheMomentsOfTheirDistributions)
{
  constexpr int N = 100000;
  double sum = 0.0, squares = 0.0, phases = 0.0, phase_squares = 0.0;
  for (int a = 1; a <= N; a++) {
    EXPECT_EQ(lifetime_share(Lifetimes::FIXED, 5, a, 1, 2), 1.0);
    const double x = lifetime_share(Lifetimes::EXPONENTIAL, 5, a, 1, 2), p = phase(5, a);
    ASSERT_GT(x, -1e-300);
    ASSERT_LE(x, 53.0 * std::log(2.0));
    ASSERT_TRUE(p >= 0.0 && p <= 1.0);
    sum += x;
    squares += x * x;
    phases += p;
    phase_squares += p * p;
  }
  const double four =
      4.0 / std::sqrt(double(N));    // standard deviations: of x 1, of x^2 sqrt(20), of p 0.29, of p^2 0.3
  EXPECT_NEAR(sum / N, 1.0, four);
  EXPECT_NEAR(squares / N, 2.0, 4.5 * four);
  EXPECT_NEAR(phases / N, 0.5, 0.29 * four);
  EXPECT_NEAR(phase_squares / N, 1.0 / 3.0, 0.3 * four);
}

TEST(Eddy, SharesDependOnEveryPartOfTheKey)
{
  const double x = lifetime_share(Lifetimes::EXPONENTIAL, 5, 1, 2, 3);
  EXPECT_NE(x, lifetime_share(Lifetimes::EXPONENTIAL, 6, 1, 2, 3));
  EXPECT_NE(x, lifetime_share(Lifetimes::EXPONENTIAL, 5, 2, 2, 3));
  EXPECT_NE(x, lifetime_share(Lifetimes::EXPONENTIAL, 5, 1, 3, 3));
  EXPECT_NE(x, lifetime_share(Lifetimes::EXPONENTIAL, 5, 1, 2, 4));
  EXPECT_NE(phase(5, 1), phase(5, 2));
  EXPECT_NE(phase(5, 1), phase(6, 1));
}
