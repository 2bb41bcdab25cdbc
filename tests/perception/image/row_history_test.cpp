#include <gtest/gtest.h>
#include <numeric>

#include "slam/perception/image/image_watch.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kRows = 20;
using Rows = std::vector<RowHistory::Digest>;

/// Rows that differ from those of every other image.
Rows image_of(std::uint64_t number) {
  Rows rows(kRows);
  std::iota(rows.begin(), rows.end(), 1000 * (number + 1));
  return rows;
}

/// The rows of `upper` above `row`, the rows of `lower` from there on.
Rows torn(const Rows& upper, const Rows& lower, std::size_t row) {
  Rows rows = upper;
  std::copy(lower.begin() + static_cast<std::ptrdiff_t>(row), lower.end(),
            rows.begin() + static_cast<std::ptrdiff_t>(row));
  return rows;
}

bool add(RowHistory& history, const Rows& rows) {
  history.newest() = rows;
  return history.add();
}

TEST(RowHistory, KnowsRowsOfAnyOfTheLastImages) {
  for (const std::uint64_t age : {1U, 3U, 6U})
    for (const bool older_below : {true, false}) {
      RowHistory history(kRows);
      for (std::uint64_t i = 0; i < 30; ++i) EXPECT_FALSE(add(history, image_of(i)));
      const Rows now = image_of(30), old = image_of(30 - age);
      EXPECT_TRUE(add(history, older_below ? torn(now, old, 12) : torn(old, now, 12))) << age;
      EXPECT_FALSE(add(history, image_of(31)));
    }
}

TEST(RowHistory, AFewRowsAreNoPart) {
  for (const std::size_t row : {1U, 2U, 18U, 19U}) {
    RowHistory history(kRows);
    for (std::uint64_t i = 0; i < 3; ++i) add(history, image_of(i));
    EXPECT_FALSE(add(history, torn(image_of(3), image_of(2), row))) << row;
  }
}

TEST(RowHistory, WholeImagesMayRepeat) {
  RowHistory history(kRows);
  for (std::uint64_t i = 0; i < 12; ++i) EXPECT_FALSE(add(history, image_of(i / 3)));
}

TEST(RowHistory, WhatNeverChangesSaysNothing) {
  RowHistory history(kRows);  // the lower half shows the robot itself, without noise
  for (std::uint64_t i = 0; i < 10; ++i) EXPECT_FALSE(add(history, torn(image_of(i), image_of(100), 10)));
}

TEST(RowHistory, RowsOfOneValueSayNothing) {
  RowHistory history(kRows);  // a dark ceiling with a lamp in the upper half, and at times a lamp in the lower half
  for (std::uint64_t i = 0; i < 20; ++i) {
    Rows rows = torn(image_of(i), Rows(kRows, RowHistory::kNothing), 10);
    if (i % 2 == 0) rows = torn(rows, image_of(i), 15);
    EXPECT_FALSE(add(history, rows));
  }
}

TEST(RowHistory, ABackgroundWithoutNoiseComesBack) {
  RowHistory history(kRows);  // a background in front of which a lamp passes
  for (std::uint64_t i = 0; i < 40; ++i) {
    Rows rows = image_of(100);
    for (std::size_t row = 0; row < kRows; ++row)
      if ((row + i) % 7 < 3) rows[row] = 1000 * (i + 1) + row;
    EXPECT_FALSE(add(history, rows)) << i;
  }
}

TEST(RowHistory, OnePersonBeforeAStillRobotIsNoTear) {
  RowHistory history(kRows);  // without noise the static background is identical, above and below the person
  for (std::uint64_t i = 0; i < 10; ++i)
    EXPECT_FALSE(add(history, torn(torn(image_of(100), image_of(i), 5), image_of(100), 15)));
}

}  // namespace
}  // namespace azimuth
