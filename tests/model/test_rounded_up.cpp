// Thresholds in messages: what is typed from the message is not below the threshold, and at most one unit of the fourth digit above it.
#include "model/rounded_up.h"

#include <gtest/gtest.h>

#include <random>

using ClusterDEM::rounded_up;

TEST(RoundedUp, KeepsWhatHasFewDigits)
{
  EXPECT_EQ(rounded_up(0.0104), "0.0104");
  EXPECT_EQ(rounded_up(2.0), "2");
  EXPECT_EQ(rounded_up(1500.0), "1500");
  EXPECT_EQ(rounded_up(1e-9), "1e-09");
}

TEST(RoundedUp, GoesUpInTheFourthDigit)
{
  EXPECT_EQ(rounded_up(0.011040945667317436), "0.01105");
  EXPECT_EQ(rounded_up(0.0015874010519681994), "0.001588");
  EXPECT_EQ(rounded_up(1.0000000001), "1.001");
  EXPECT_EQ(rounded_up(0.99991), "1");
  EXPECT_EQ(rounded_up(9999.5), "1e+04");
  EXPECT_EQ(rounded_up(123456.0), "1.235e+05");
  EXPECT_EQ(rounded_up(0.123456, 2), "0.13");
}

TEST(RoundedUp, IsNeverBelowAndHardlyAbove)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> power(-12.0, 12.0);
  for (int k = 0; k < 100000; k++) {
    const double x = std::pow(10.0, power(random)), told = std::strtod(rounded_up(x).c_str(), nullptr);
    ASSERT_GE(told, x);
    ASSERT_LE(told, x * 1.001 * (1.0 + 1e-15)) << x;
  }
}
