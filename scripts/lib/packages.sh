# The Debian 12 packages that Azimuth is built from, by where they have to be: sourced, never run.

# On the machine that builds, whatever it builds for: compiler and generators, and what runs the tests.
build_tools=(
  g++ make cmake ninja-build pkg-config git ca-certificates
  # lcm-gen, and lcm-logger for the demo and the tests
  liblcm-bin
  # tests; python3 also summarises them
  python3
  # what documents ask the catalogue of field logs
  sqlite3
  # a network namespace of one's own for LCM (unshare, ip)
  util-linux iproute2
)

# For the machine that the programs run on.
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
  # the catalogue of field logs
  libsqlite3-dev
  # the window on a running robot: HTTP
  libmicrohttpd-dev
  # devices: USB hot-plug and reset, FireWire cameras
  libusb-1.0-0-dev libdc1394-dev
  # tests
  libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev
)

# The bridge to ROS 2: the generator of its messages, and its library.
ros2_tools=(cyclonedds-tools)
ros2_libraries=(cyclonedds-dev)

# the last two write bags of ROS 1, for tests
# zsh and fish read the completions that are made for them
# a browser without a window opens the pages
# libfastrtps-dev: another implementation of DDS, for the bridge's tests
# qemu-user-static: processors that this machine has not
development=(chromium chromium-driver zsh fish clang-format clang-tidy clang-14 libfuzzer-14-dev libclang-rt-14-dev librosbag-storage-dev python3-rosbag
  "${ros2_tools[@]}" "${ros2_libraries[@]}" libfastrtps-dev qemu-user-static)
documents=(mkdocs-material)
package=(dpkg-dev fakeroot file gzip lintian)
# an emulated machine: what fills its disk, and the machine
guest=(mmdebstrap kmod cpio e2fsprogs)
guest_amd64=(qemu-system-x86 binutils libelf1)
guest_arm64=(qemu-system-arm)
# many replays at once, on the cores of one machine or on a cluster: fleet/
fleet=(snakemake slurm-wlm munge)
bench=(libmrpt-slam-dev libdlib-dev libceres-dev libsuitesparse-dev)

# Another architecture: a compiler for it, what fetches its libraries, and what runs its programs here.
cross_arm64=(g++-aarch64-linux-gnu mmdebstrap qemu-user-static)
