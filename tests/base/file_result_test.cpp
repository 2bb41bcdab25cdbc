#include "base/file_result.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

TEST(FileError, NamesItsPlaceAsFarAsItIsKnown) {
  EXPECT_EQ((FileError{"a.toml", 0, "is empty"}.text()), "a.toml: is empty");
  EXPECT_EQ((FileError{"a.toml", 3, "is wrong"}.text()), "a.toml:3: is wrong");
  EXPECT_EQ((FileError{"a.toml", 3, "is wrong", 7}.text()), "a.toml:3:7: is wrong");
  EXPECT_EQ(text({{"a", 1, "x"}, {"b", 0, "y"}}), "a:1: x\nb: y\n");
}

TEST(FileResult, IsAValueOrAllThatStoodInItsWay) {
  const FileResult<int> value = 4;
  ASSERT_TRUE(value);
  EXPECT_EQ(*value, 4);
  const FileResult<int> none = failure({{"a", 1, "x"}, {"b", 0, "y"}});
  ASSERT_FALSE(none);
  EXPECT_EQ(text(none.error()), "a:1: x\nb: y\n");
  const FileResult<void> undone = failure(FileError{"a", 0, "cannot be written"});
  ASSERT_FALSE(undone);
  EXPECT_EQ(undone.error().size(), 1U);
  EXPECT_TRUE(FileResult<void>());
}

}  // namespace
}  // namespace azimuth
