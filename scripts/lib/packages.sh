# Lists of the Debian 12 packages that Azimuth needs, by the machine that needs them. The scripts source this file.

# Packages for the machine that builds: compiler, generators and test tools.
build_tools=(
  g++ make cmake ninja-build pkg-config git ca-certificates
  # lcm-gen, and lcm-logger for the demo and the tests
  liblcm-bin
  # tests and their summary
  python3
  # queries of the field log index in the documents
  sqlite3
  # network namespaces for LCM (unshare, ip)
  util-linux iproute2
)

# Libraries for the machine that runs the programs.
libraries=(
  # libraries of slam/, settings/, daemon/, tools/; libexpected-dev stands in for std::expected
  libeigen3-dev libspdlog-dev libfmt-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev
  libexpected-dev libsystemd-dev libcairo2-dev
  # images: JPEG, PNG, OpenCV's SIFT as a reference, and its chessboards
  libjpeg62-turbo-dev libpng-dev libopencv-imgproc-dev libopencv-features2d-dev
  libopencv-calib3d-dev
  liblcm-dev
  # checksums of map files and pages; compressed bags
  zlib1g-dev libglib2.0-dev libbz2-dev liblz4-dev libzstd-dev
  # the index of field logs
  libsqlite3-dev
  # the HTTP server of azimuth view
  libmicrohttpd-dev
  # devices: USB hot-plug and reset, FireWire cameras
  libusb-1.0-0-dev libdc1394-dev
  # tests
  libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev
)

# The bridge to ROS 2: the message generator and the DDS library.
ros2_tools=(cyclonedds-tools)
ros2_libraries=(cyclonedds-dev)

# the last two write bags of ROS 1 for tests
# zsh and fish read the completions that are made for them
# a headless browser opens the pages
# libfastrtps-dev: another DDS implementation for the tests of the bridge
# qemu-user-static: emulation of other processors
development=(chromium chromium-driver zsh fish clang-format clang-tidy clang-14 libfuzzer-14-dev libclang-rt-14-dev librosbag-storage-dev python3-rosbag
  "${ros2_tools[@]}" "${ros2_libraries[@]}" libfastrtps-dev qemu-user-static)
documents=(mkdocs-material)
package=(dpkg-dev fakeroot file gzip lintian)
# the QEMU guest: tools for its disk, and the emulator
guest=(mmdebstrap kmod cpio e2fsprogs)
guest_amd64=(qemu-system-x86 binutils libelf1)
guest_arm64=(qemu-system-arm)
# tools/fleet/: many parallel replays on one machine or on a cluster
fleet=(snakemake slurm-wlm munge)
bench=(libmrpt-slam-dev libdlib-dev libceres-dev libsuitesparse-dev)

# Another architecture: the compiler, a tool that fetches its libraries, and an emulator.
cross_arm64=(g++-aarch64-linux-gnu mmdebstrap qemu-user-static)
