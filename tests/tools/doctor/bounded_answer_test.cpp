#include "tools/doctor/bounded_answer.hpp"

#include <chrono>
#include <cstdlib>
#include <gtest/gtest.h>
#include <unistd.h>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

TEST(BoundedAnswer, IsHandedOnWhole) {
  EXPECT_EQ(answer_within(60s, [] { return std::string(); }), "");
  const std::string large(1 << 20, 'x');  // more than a pipe holds
  EXPECT_EQ(answer_within(60s, [&] { return large; }), large);
}

TEST(BoundedAnswer, IsNoneWhenItIsLate) {
  const auto began = std::chrono::steady_clock::now();
  const auto answer = answer_within(50ms, [] {
    ::sleep(600);
    return std::string("late");
  });
  EXPECT_EQ(answer, std::nullopt);
  EXPECT_LT(std::chrono::steady_clock::now() - began, 300s);
}

TEST(BoundedAnswer, IsNoneWhenTheQuestionEndsTheProcess) {
  EXPECT_EQ(answer_within(60s, []() -> std::string { ::_exit(3); }), std::nullopt);
}

}  // namespace
}  // namespace azimuth
