#include <cerrno>

#include "tests/tools/doctor/fake_machine.hpp"

namespace azimuth {
namespace {

using test::IsFinding;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using v4l2::VideoNode;

class CameraChecks : public test::FakeMachine {
 protected:
  CameraChecks() {
    machine.video_nodes = [this] { return nodes; };
    machine.iidc_cameras = [this] { return bus; };
  }
  /// Adds a USB camera whose device file has the access mode `mode`.
  void plug_in(const std::string& name, const std::string& serial, mode_t mode) {
    write("/dev/" + name, "", mode);
    nodes.push_back({.path = "/dev/" + name,
                     .card = "Webcam",
                     .usb = {"1-" + std::to_string(nodes.size() + 1), "046d", "0825", serial},
                     .gives_images = true});
  }
  Findings check(const std::string& v4l2_device) {
    Plan plan;
    plan.v4l2_device = v4l2_device;
    return check_cameras(machine, plan);
  }
  Findings check_iidc(const std::string& guid) {
    Plan plan;
    plan.iidc_guid = guid;
    return check_cameras(machine, plan);
  }

  std::vector<VideoNode> nodes;
  std::optional<IidcBus> bus = IidcBus{.guids = {}, .trouble = "libdc1394 finds neither"};
};

TEST_F(CameraChecks, NoneIsNoErrorUnlessOneIsConfigured) {
  EXPECT_THAT(check_cameras(machine, {}), ElementsAre(IsFinding(Verdict::warning, "no camera is plugged in")));
  Plan plan;
  plan.wants_camera = false;
  EXPECT_THAT(check_cameras(machine, plan), ElementsAre(IsFinding(Verdict::ok, "needs none")));
  EXPECT_THAT(check("first"), ElementsAre(IsFinding(Verdict::error, "the configured camera, first, is not there")));
  EXPECT_THAT(check_iidc(""), ElementsAre(IsFinding(Verdict::error, "(libdc1394 finds neither)")));
  machine.video_nodes = nullptr;
  machine.iidc_cameras = nullptr;
  EXPECT_THAT(check_cameras(machine, {}), ElementsAre(IsFinding(Verdict::warning, "no camera is plugged in")));
}

TEST_F(CameraChecks, ACameraIsDescribedAndItsLastingNameTold) {
  plug_in("video0", "A1", 0666);
  plug_in("video1", "", 0666);
  nodes.push_back({.path = "/dev/video2", .card = "Webcam", .usb = nodes[0].usb, .gives_images = false});
  const Findings findings = check_cameras(machine, {});
  ASSERT_EQ(findings.size(), 2U) << "the node of metadata is no camera";
  EXPECT_THAT(findings[0], IsFinding(Verdict::ok,
                                     "/dev/video0 (Webcam, USB 1-1, serial A1), ada may use it; in [daemon.v4l2]: "
                                     "device = \"serial:A1\""));
  EXPECT_THAT(findings[1], IsFinding(Verdict::ok, "device = \"/dev/video1\"")) << "no other name means it alone";
}

TEST_F(CameraChecks, ADeniedCameraSaysHowItIsGiven) {
  plug_in("video0", "A1", 0600);
  Findings findings = check_cameras(machine, {});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_THAT(findings[0], IsFinding(Verdict::error, "ada may not read and write /dev/video0 (Webcam"));
  EXPECT_THAT(findings[0].fix, HasSubstr("sudo chgrp video /dev/video0 "));
  EXPECT_THAT(findings[0].fix, HasSubstr("GROUP=\"video\", MODE=\"0660\""));
  EXPECT_THAT(check("serial:A1"), Contains(IsFinding(Verdict::error, "the configured camera: ada may not")));
  machine.account.is_here = true;
  EXPECT_THAT(check_cameras(machine, {}), ElementsAre(IsFinding(Verdict::ok, "may use it")))
      << "an access list lets it";
  nodes[0].open_error = EACCES;
  EXPECT_THAT(check_cameras(machine, {}), ElementsAre(IsFinding(Verdict::error, "may not")));
}

TEST_F(CameraChecks, WhatElseKeepsACameraFromBeingOpenedIsTold) {
  plug_in("video0", "A1", 0666);
  machine.account.is_here = true;
  nodes[0].open_error = EBUSY;
  const Findings findings = check_cameras(machine, {});
  EXPECT_THAT(findings, ElementsAre(IsFinding(Verdict::error, "cannot be opened: Device or resource busy")));
  EXPECT_NE(findings[0].fix, "");
  nodes[0].path = "/dev/video7";
  nodes[0].open_error = ENOENT;
  EXPECT_THAT(check_cameras(machine, {}), ElementsAre(IsFinding(Verdict::error, "No such file")));
  machine.account.is_here = false;
  EXPECT_THAT(check_cameras(machine, {}), ElementsAre(IsFinding(Verdict::error, "No such file")));
}

TEST_F(CameraChecks, TheConfiguredCameraIsFoundByEveryKindOfName) {
  plug_in("video0", "A1", 0666);
  plug_in("video1", "B2", 0666);
  link("/dev/v4l/by-id/usb-Webcam-index0", "../../video1");
  for (const char* name : {"serial:B2", "usb:046d:0825:B2", "/dev/video1", "/dev/v4l/by-id/usb-Webcam-index0"})
    EXPECT_THAT(check(name),
                Contains(IsFinding(Verdict::ok, std::string("the configured camera, ") + name + ", is /dev/video1")));
  EXPECT_THAT(check("card:Webcam"), Contains(IsFinding(Verdict::ok, "is /dev/video0"))) << "the lowest number";
  for (const char* name : {"serial:C3", "/dev/video9", "/dev/v4l", "nonsense"}) {
    const Findings findings = check(name);
    EXPECT_EQ(findings.size(), 3U);
    EXPECT_THAT(findings.back(), IsFinding(Verdict::error, "is not there")) << name;
    EXPECT_THAT(findings.back().fix, HasSubstr("by-id"));
  }
  nodes[1].gives_images = false;
  EXPECT_THAT(check("/dev/video1"), Contains(IsFinding(Verdict::error, "a node without images")));
}

TEST_F(CameraChecks, FireWireNodesThatAreNoCamerasArePassedOver) {
  write("/dev/fw0", "", 0600);
  write("/sys/bus/firewire/devices/fw0/units", "\n");
  EXPECT_THAT(check_cameras(machine, {}), ElementsAre(IsFinding(Verdict::warning, "no camera")));
  write("/dev/fw1", "", 0600);
  write("/sys/bus/firewire/devices/fw1/units", "0x00a02d:0x000102\n");
  const Findings denied = check_cameras(machine, {});
  EXPECT_THAT(denied, ElementsAre(IsFinding(Verdict::error, "may not read and write /dev/fw1")));
  EXPECT_THAT(denied[0].fix, HasSubstr("video"));
  ::chmod(machine.at("/dev/fw1").c_str(), 0666);
  write("/sys/bus/firewire/devices/fw1/model_name", "DFK 31BF03\n");
  write("/dev/fw2", "", 0600);
  EXPECT_THAT(check_cameras(machine, {}), ElementsAre(IsFinding(Verdict::ok, "/dev/fw1 (DFK 31BF03), ada may use it"),
                                                      IsFinding(Verdict::error, "/dev/fw2")))
      << "one that does not say what it is may be a camera";
}

TEST_F(CameraChecks, IidcCamerasAreListedByGuid) {
  bus = IidcBus{.guids = {"0000000000000005", "00b09d0100c0ffee"}, .trouble = {}};
  EXPECT_THAT(check_cameras(machine, {}), ElementsAre(IsFinding(Verdict::ok, "guid = \"0000000000000005\""),
                                                      IsFinding(Verdict::ok, "guid = \"00b09d0100c0ffee\"")));
  EXPECT_THAT(check_iidc(""), Contains(IsFinding(Verdict::ok, "an IIDC camera is there, as configured")));
  EXPECT_THAT(check_iidc("0xB09D0100C0FFEE"), Contains(IsFinding(Verdict::ok, "00b09d0100c0ffee is there")));
  EXPECT_THAT(check_iidc("6"), Contains(IsFinding(Verdict::error, "0000000000000006 is configured, but not there")));
}

TEST_F(CameraChecks, ALibraryThatDoesNotAnswerIsNoCamera) {
  bus.reset();
  EXPECT_THAT(check_cameras(machine, {}), ElementsAre(IsFinding(Verdict::warning, "no camera")));
  EXPECT_THAT(check_iidc(""), ElementsAre(IsFinding(Verdict::error, "does not answer")));
}

TEST_F(CameraChecks, ThisMachineAnswersAtOnce) {
  const auto here = this_machine("");
  ASSERT_TRUE(here);
  EXPECT_TRUE(here->account.is_here);
  EXPECT_THAT(check_cameras(*here, {}), Not(IsEmpty()));
}

}  // namespace
}  // namespace azimuth
