// Access control at the camera's socket.

#include <gmock/gmock.h>
#include <grp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "drivers/camera/link_socket.hpp"
#include "tests/drivers/camera/link_fixture.hpp"

namespace azimuth {
namespace {

using test::CameraLink;
using test::serve;

constexpr uid_t kNobody = 65534;

mode_t mode_of(const std::filesystem::path& file) {
  struct stat status {};
  EXPECT_EQ(::lstat(file.c_str(), &status), 0);
  return status.st_mode & 0777U;
}

/// A process of another user at the other end, alive until the end of the test.
class OtherUser {
 public:
  /// Runs `act` as user `uid` and group `gid`, signals completion, and waits.
  template <class Act>
  OtherUser(uid_t uid, gid_t gid, Act act) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    child_ = ::fork();
    if (child_ == 0) {
      const bool is_other = ::setgroups(0, nullptr) == 0 && ::setgid(gid) == 0 && ::setuid(uid) == 0;
      const UniqueFd held = is_other ? act() : UniqueFd();
      const char done = held ? 'y' : 'n';
      if (::write(ends[1], &done, 1) != 1) ::_exit(1);
      for (;;) ::pause();
    }
    char done = 'n';
    EXPECT_EQ(::read(ends[0], &done, 1), 1);
    EXPECT_EQ(done, 'y');
    ::close(ends[0]);
    ::close(ends[1]);
  }
  OtherUser(const OtherUser&) = delete;
  OtherUser& operator=(const OtherUser&) = delete;
  ~OtherUser() {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }

 private:
  pid_t child_ = -1;
};

class CameraPeers : public CameraLink {
 protected:
  void SetUp() override {
    if (::geteuid() != 0) GTEST_SKIP() << "only root can be two users";
  }
  void open_folder(mode_t mode) { ASSERT_EQ(::chmod(folder().c_str(), mode), 0); }
  UniqueFd connected() const {
    int error = 0;
    return camera_link::connect_to(path(), error);
  }
};

TEST_F(CameraLink, TheSocketIsItsUsersAndItsGroups) {
  for (const mode_t mask : {0000U, 0022U, 0077U}) {
    const mode_t before = ::umask(mask);
    const CameraServer server = serve(path());
    ::umask(before);
    EXPECT_EQ(mode_of(path()), 0660U) << std::oct << mask;
  }
}

TEST_F(CameraPeers, TheSocketIsOfItsFoldersGroup) {
  ASSERT_EQ(::chown(folder().c_str(), static_cast<uid_t>(-1), 4242), 0);
  const CameraServer server = serve(path());
  struct stat status {};
  ASSERT_EQ(::lstat(path().c_str(), &status), 0);
  EXPECT_EQ(status.st_gid, 4242U);
  EXPECT_EQ(status.st_mode & 0777U, 0660U);
}

TEST_F(CameraPeers, AStrangerIsNotServed) {
  CameraServer server = serve(path());
  open_folder(0755);
  ASSERT_EQ(::chmod(path().c_str(), 0666), 0);
  const OtherUser stranger(kNobody, kNobody, [&] { return connected(); });
  server.turn();
  EXPECT_FALSE(server.has_client());
  EXPECT_EQ(server.counts().strangers, 1U);
  const UniqueFd own = connected();
  server.turn();
  EXPECT_TRUE(server.has_client()) << "the next one is";
}

TEST_F(CameraPeers, WhoIsOfTheSocketsGroupIsServed) {
  CameraServer server = serve(path());
  open_folder(0755);
  const OtherUser friendly(kNobody, ::getegid(), [&] { return connected(); });
  server.turn();
  EXPECT_TRUE(server.has_client());
}

TEST_F(CameraPeers, ACameraOfAnotherUserIsBelievedOnlyWhereNotEverybodyCouldPutOne) {
  open_folder(01777);
  const OtherUser other(kNobody, kNobody, [&] {
    int error = 0;
    return camera_link::listen_at(path(), error);
  });
  SharedCamera camera(path());
  camera.turn(now());
  EXPECT_THAT(camera.state().error, ::testing::HasSubstr("belongs to user 65534"));
  open_folder(0755);
  pass(std::chrono::seconds(2));
  camera.turn(now());
  EXPECT_THAT(camera.state().error, ::testing::HasSubstr("waits for its turn"));
}

}  // namespace
}  // namespace azimuth
