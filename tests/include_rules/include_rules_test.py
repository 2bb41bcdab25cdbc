#!/usr/bin/env python3
"""Tests the include rules: they find each bad line in a small tree, and the good tree is clean."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from tree_check import Bites  # noqa: E402

from include_rules import RULES, violations  # noqa: E402

GOOD = {
    "slam/geometry/pose.hpp": "#pragma once\n#include <Eigen/Core>\n#include <vector>\n",
    "slam/sample/stamp.hpp": "#include <chrono>\n#include \"slam/geometry/pose.hpp\"\n",
    "slam/ekf/filter.cpp": "#include \"slam/geometry/pose.hpp\"\n// std::cout << std::exit\nint f() { return 1'000; }\n",
    "slam/ekf/CMakeLists.txt": "azimuth_library(azimuth_ekf SOURCES filter.cpp)\n",
    "slam/association/gate.hpp": "#include \"slam/sample/stamp.hpp\"\n",
    "slam/estimator/stage.hpp": "#include \"slam/ekf/filter.hpp\"\n",
    "slam/lost/lost.hpp": "#include \"slam/estimator/stage.hpp\"\n",
    "slam/planar/matcher.hpp": "#include \"slam/association/gate.hpp\"\n#include \"slam/lost/lost.hpp\"\n",
    "slam/perception/blobs.hpp": "#include <opencv2/core.hpp>\n",
    "base/result.hpp": "#include <tl/expected.hpp>\n",
    "drivers/storage/parts.hpp": "#pragma once\n// Parts of files. Internal to drivers/storage; see file.hpp.\n",
    "drivers/storage/more/parts.hpp": "#include \"drivers/storage/parts.hpp\"\n",
    "drivers/storage/file.hpp": "#include <fcntl.h>\n#include <fstream>\n#include \"base/result.hpp\"\n#include \"slam/sample/stamp.hpp\"\n",
    "settings/read.hpp": "#include <toml++/toml.h>\n#include \"base/result.hpp\"\n#include \"slam/estimator/stage.hpp\"\n",
    "sim/world/world.hpp": "#include \"slam/geometry/pose.hpp\"\n",
    "tools/replay.hpp": "#include \"drivers/storage/file.hpp\"\n#include \"slam/estimator/stage.hpp\"\n",
    "daemon/pipeline/pipeline.hpp": "#include <thread>\n#include \"slam/estimator/stage.hpp\"\nstd::jthread t;\n",
}

BAD = [  # file, line, what the message must name
    ("slam/geometry/a.hpp", '#include "slam/sample/stamp.hpp"', "slam/sample/stamp.hpp"),
    ("slam/geometry/a.hpp", '#include "pose.hpp"', "pose.hpp"),
    ("slam/geometry/a.hpp", '#include "../sample/stamp.hpp"', "from the top"),
    ("slam/geometry/a.hpp", "#include <opencv2/core.hpp>", "opencv2"),
    ("slam/ekf/a.hpp", '#include "slam/association/gate.hpp"', "slam/association/gate.hpp"),
    ("slam/association/a.hpp", '#include "slam/ekf/filter.hpp"', "slam/ekf/filter.hpp"),
    ("slam/ekf/a.hpp", '#include "slam/estimator/stage.hpp"', "slam/estimator/stage.hpp"),
    ("slam/estimator/a.hpp", '#include "drivers/storage/file.hpp"', "drivers/storage/file.hpp"),
    ("drivers/wire/a.hpp", '#include "drivers/storage/file.hpp"', "drivers/storage/file.hpp"),
    ("drivers/device/a.hpp", '#include "drivers/wire/a.hpp"', "drivers/wire/a.hpp"),
    ("drivers/storage/a.hpp", '#include "drivers/can/can.hpp"', "drivers/can/can.hpp"),
    ("base/a.hpp", '#include "drivers/wire/a.hpp"', "drivers/wire/a.hpp"),
    ("slam/perception/a.hpp", '#include "drivers/picture/picture.hpp"', "drivers/picture/picture.hpp"),
    ("drivers/picture/a.hpp", '#include "slam/estimator/stage.hpp"', "slam/estimator/stage.hpp"),
    ("slam/estimator/a.hpp", '#include "slam/planar/matcher.hpp"', "slam/planar/matcher.hpp"),
    ("slam/lost/a.hpp", '#include "slam/planar/matcher.hpp"', "slam/planar/matcher.hpp"),
    ("slam/ceiling/a.hpp", '#include "slam/planar/matcher.hpp"', "slam/planar/matcher.hpp"),
    ("slam/estimator/a.hpp", "#include <spdlog/spdlog.h>", "spdlog"),
    ("slam/estimator/a.hpp", "#  include <thread>", "<thread>"),
    ("slam/estimator/a.hpp", "#include <fstream>", "<fstream>"),
    ("slam/estimator/a.hpp", "#include <iostream>", "<iostream>"),
    ("slam/estimator/a.hpp", "#include <sys/socket.h>", "sys/socket.h"),
    ("slam/estimator/a.hpp", "auto t = std::chrono::steady_clock::now();", "_clock::now"),
    ("slam/estimator/a.hpp", "auto t = SampleClock_clock::now();", "_clock::now"),
    ("slam/estimator/a.hpp", "void f() { std::exit(1); }", "std::exit"),
    ("slam/estimator/a.hpp", "double d = std::hypot(x, y);", "std::hypot"),
    ("slam/estimator/a.hpp", 'char q = \'"\'; void f() { abort(); } char r = \'"\';', "abort"),
    ("slam/estimator/a.hpp", 'void f() { printf("x"); }', "printf"),
    ("slam/unknown/a.hpp", '#include "slam/geometry/pose.hpp"', "slam/geometry/pose.hpp"),
    ("base/a.hpp", '#include "slam/sample/stamp.hpp"', "slam/sample/stamp.hpp"),
    ("slam/estimator/a.hpp", '#include "base/result.hpp"', "base/result.hpp"),
    ("drivers/storage/a.hpp", '#include "slam/estimator/stage.hpp"', "slam/estimator/stage.hpp"),
    ("drivers/storage/a.hpp", "std::thread t;", "std::thread"),
    ("drivers/usb/a.hpp", '#include "drivers/storage/parts.hpp"', "is internal to drivers/storage"),
    ("daemon/a.hpp", '#include "drivers/storage/parts.hpp"', "is internal to drivers/storage"),
    ("settings/a.hpp", '#include "daemon/pipeline/pipeline.hpp"', "daemon/pipeline/pipeline.hpp"),
    ("sim/world/a.hpp", '#include "tools/replay.hpp"', "tools/replay.hpp"),
    ("tools/a.hpp", '#include "daemon/pipeline/pipeline.hpp"', "daemon/pipeline/pipeline.hpp"),
    ("tools/a.hpp", "#include <mutex>", "<mutex>"),
    ("daemon/a.hpp", '#include "tools/replay.hpp"', "tools/replay.hpp"),
    ("slam/ekf/unlisted.cpp", "int g();", "unlisted.cpp"),
    ("slam/ekf/CMakeLists.txt", "file(GLOB sources *.cpp) # filter.cpp", "GLOB"),
]


class IncludeRules(Bites, unittest.TestCase):
    GOOD = GOOD
    violations = staticmethod(violations)

    def test_every_bad_line_is_found_at_its_place(self):
        for path, line, named in BAD:
            with self.subTest(path=path, line=line):
                text = f"// first line\n{line}\n" if path.endswith("pp") else line
                where = "slam/ekf/CMakeLists.txt:1:" if path.startswith("slam/ekf/") and named in (
                    "unlisted.cpp", "GLOB") else f"{path}:2:"
                self.expect_one({path: text}, where, named)


class Table(unittest.TestCase):
    """Tests the table of rules."""

    def test_no_two_folders_see_each_other(self):
        sees = {folder: {other for other in rule.sees if other != folder} for folder, rule in RULES.items()}
        done = set()

        def visit(folder, path):
            self.assertNotIn(folder, path, f"a ring: {' -> '.join([*path, folder])}")
            if folder not in done:
                for other in sees.get(folder, ()):
                    visit(other, [*path, folder])
                done.add(folder)

        for folder in sees:
            visit(folder, [])


if __name__ == "__main__":
    unittest.main()
