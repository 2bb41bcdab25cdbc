"""Gives hostile inputs to the programs. No input below 1 MB may take more than 5 s of CPU time or 300 MB of memory, end
a program by a signal, or write control characters to the terminal.

usage: hostile_test.py AZIMUTH AZIMUTHD RUNS_FOLDER texts|bombs|images|logs|tables|mutants|interrupts [COUNT [FIRST]]
"""

import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import zlib

import made_files as made

MOST_CPU_S = 5.0
MOST_MB = 300
LONGEST_REPLAY_S = 20.0  # an estimator needs long for the shipped run without identities
WALL_S = 240  # wall-clock limit, generous for a busy machine
LARGEST_INPUT = 1 << 20
LONGEST_OUTPUT = 2_000_000


class Trials:
    def __init__(self, azimuth, azimuthd, runs, folder):
        self.azimuth = azimuth
        self.azimuthd = azimuthd
        self.runs = runs
        self.folder = folder
        self.failures = []
        self.most_cpu_s = MOST_CPU_S
        self.tried = 0
        self.worst = [(0.0, ""), (0.0, "")]

    def file(self, name, content):
        assert len(content) <= LARGEST_INPUT, (name, len(content))
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        return path

    def run_of(self, name, **files):
        """Makes a copy of runs/lab with some files replaced."""
        folder = self.folder / name
        shutil.copytree(self.runs / "lab", folder)
        for file, content in files.items():
            (folder / file.replace("_", ".")).write_bytes(content)
        return folder

    def limited(self):
        resource.setrlimit(resource.RLIMIT_CPU, (60, 60))
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    def measured(self, command):
        """Runs a command; returns (exit code, output, CPU time [s], peak memory [MB])."""
        with tempfile.TemporaryFile() as output:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=output,
                                       cwd=self.folder, preexec_fn=self.limited)
            timer = threading.Timer(WALL_S, process.kill)
            timer.start()
            _, status, used = os.wait4(process.pid, 0)
            timer.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            output.seek(0)
            return process.returncode, output.read(), used.ru_utime + used.ru_stime, used.ru_maxrss / 1024

    def trouble(self, code, output, cpu_s, peak_MB, answers):
        if code < 0:
            return f"ended by signal {-code}"
        if code not in answers:
            return f"exit code {code}"
        if cpu_s > self.most_cpu_s:
            return f"{cpu_s:.1f} s"
        if peak_MB > MOST_MB:
            return f"{peak_MB:.0f} MB"
        if len(output) > LONGEST_OUTPUT:
            return f"{len(output)} bytes of output"
        if any(byte < 0x20 and byte != 0x0A or byte == 0x7F for byte in output):
            return "control characters in its output"
        return ""

    def azimuth_does(self, *words, answers=(0, 1, 2, 3)):
        return self.tries([self.azimuth, *map(str, words)], answers)

    def daemon_checks(self, *words):
        return self.tries([self.azimuthd, "--check-config", *map(str, words)], (0, 2))

    def tries(self, command, answers):
        code, output, cpu_s, peak_MB = self.measured(command)
        self.tried += 1
        said = " ".join(command[1:]).replace(str(self.folder) + "/", "")
        self.worst = [max(self.worst[0], (cpu_s, said)), max(self.worst[1], (peak_MB, said))]
        what = self.trouble(code, output, cpu_s, peak_MB, answers)
        if what:
            self.failures.append(f"{said}: {what}\n    {output[-300:]!r}")
        return output.decode(errors="replace")

    def reads_recording(self, path):
        """Runs all commands that read a recording."""
        self.azimuth_does("replay", path)
        self.azimuth_does("check", path)
        self.azimuth_does("import", path, self.folder / "converted", "--force")
        self.azimuth_does("import", path, self.folder / "converted.lcmlog", "--force")
        self.azimuth_does("export", path, "poses.csv")
        self.daemon_checks("--play", path)

    def imports(self, name, content):
        path = self.file(name, content)
        listed = self.azimuth_does("import", path)
        taken = self.azimuth_does("import", path, self.folder / "imported", "--force")
        self.azimuth_does("import", path, self.folder / "imported.lcmlog", "--force", "--rig", self.runs / "lab/rig.toml")
        return listed + taken


def deep_texts():
    many = 100_000
    yield "key", b"a." * many + b"a = 1\n"
    yield "quoted", b'"a".' * many + b"a = 1\n"
    yield "header", b"[" + b"a." * many + b"a]\n"
    yield "lists", b"a = " + b"[" * many + b"]" * many
    yield "tables", b"a = " + b"{a=" * many + b"1" + b"}" * many
    yield "unclosed", b"a = " + b"[{a=" * many
    yield "keys", b"".join(b"key_%d = 1\n" % i for i in range(50_000))
    yield "headers", b"".join(b"[ekf.s%d]\n" % i for i in range(50_000))
    yield "one_key", b"k" * 900_000 + b" = 1\n"
    yield "one_text", b'name = "' + b"\x1b[31m" * 150_000 + b'"\n'
    yield "classes", b"".join(b"[[colour.classes]]\nname = \"c%d\"\n" % i for i in range(25_000))
    yield "mistakes", b"a = = 1\n" * 100_000
    yield "quotes", b"a = \"\"\"" + b"\"" * 900_000
    yield "numbers", b"seed = " + b"9" * 900_000 + b"\nx = 1e" + b"9" * 1000 + b"\n"
    yield "zeros", bytes(900_000)
    yield "noise", random.Random(1).randbytes(900_000)


def texts(trials):
    log = trials.folder / "lab.lcmlog"
    trials.azimuth_does("import", trials.runs / "lab", log, answers=(0,))
    whole = log.read_bytes()
    logs = trials.folder / "logs"
    for name, text in deep_texts():
        rig = trials.file(f"{name}.toml", text)
        trials.azimuth_does("replay", trials.runs / "lab", "--rig", rig)
        trials.azimuth_does("replay", trials.runs / "lab", "--config", rig)
        trials.daemon_checks("--config", rig)
        hostile = trials.file(f"logs/{name}.lcmlog", made.with_document(whole[:40_000], "rig.toml", text[:600_000]))
        trials.azimuth_does("replay", hostile)
        trials.daemon_checks("--play", hostile)
        report = trials.file(f"{name}.json", text.replace(b"a.", b'{"a":').replace(b"{a=", b'{"a":'))
        trials.azimuth_does("report", "compare", report)
    shutil.copy(log, logs / "good.lcmlog")
    said = trials.azimuth_does("report", "logs", logs, answers=(0,))
    if f"{len(list(deep_texts())) + 1} logs" not in said:
        trials.failures.append("log index: a bad log ends the catalogue: " + said[-300:])
    nested = b'{"name":' * 100_000 + b"1" + b"}" * 100_000
    trials.azimuth_does("report", "compare", trials.file("nested.json", nested))
    trials.azimuth_does("report", "compare", trials.file("lists.json", b"[" * 500_000 + b"]" * 500_000))


def bombs(trials):
    bz2 = made.bz2.compress(bytes(200 << 20), 9)
    refused = [
        trials.imports("bz2.bag", made.BAG_BEGIN + made.chunk("bz2", bz2)),
        trials.imports("many_bz2.bag", made.BAG_BEGIN + made.chunk("bz2", bz2) * 200),
        trials.imports("zstd.mcap", made.MCAP_BEGIN + made.mcap_chunk("zstd", made.zstd_of(0, 4000), 500 << 20)),
        trials.imports("many_zstd.mcap", made.MCAP_BEGIN + made.mcap_chunk("zstd", made.zstd_of(7, 1000), 125 << 20) * 200),
        trials.imports("lz4.bag", made.BAG_BEGIN + made.chunk("lz4", made.lz4_of(0, 160))),
    ]
    for said in refused:
        if "unpack to more than" not in said:
            trials.failures.append("a bomb is not said to be one: " + said[-300:])
    begins = made.chunk("bz2", b"") * 15_000
    trials.imports("chunks.bag", made.BAG_BEGIN + begins + made.bz2.compress(random.Random(2).randbytes(150_000)))
    trials.imports("skipped.mcap", made.MCAP_BEGIN
                   + made.mcap_chunk("zstd", b"\x50\x2a\x4d\x18" + made.u32(400_000) + bytes(400_000), 10) * 2)
    # Messages that compress well, within the limit of the budget.
    body = made.connection(0, b"/odom", "nav_msgs/Odometry", made.ODOMETRY)
    body += b"".join(made.message(0, 10 + i, made.odometry(10 + i, 0.01 * i)) for i in range(60_000))
    trials.imports("well_packed.bag", made.BAG_BEGIN + made.chunk("bz2", made.bz2.compress(body), len(body))
                   + made.drive_bag()[len(made.BAG_BEGIN):])
    schemas = b""
    for _ in range(20_000):
        schemas = schemas_before(len(schemas) + 5000) + schemas
    trials.imports("schemas.mcap", made.MCAP_BEGIN + b"damage" + schemas + bytes(5010))
    wide = made.mcap_schema(1, "nav_msgs/Odometry", "ros1msg", "#" * 400_000 + "\n" + made.ODOMETRY)
    channels = b"".join(made.mcap_channel(i, 1, "/o%d" % i) + made.mcap_message(i, 1, b"") for i in range(6000))
    trials.imports("channels.mcap", made.MCAP_BEGIN + wide + channels)
    definitions(trials)
    own = made.record(3, [("index_pos", made.u64(0)), ("conn_count", made.u32(1)), ("chunk_count", made.u32(1 << 31))], b"")
    trials.imports("index.bag", made.BAG_BEGIN + own + made.record(6, [("chunk_pos", made.u64(13))], b"") * 5000)
    index = made.mcap_record(8, made.u64(0) * 2 + made.u64(8) + made.u64(1 << 62)) * 10_000
    trials.imports("index.mcap", made.MCAP_BEGIN + index + made.drive_mcap()[8:])
    trials.imports("lengths.mcap", made.MCAP_BEGIN + (b"\x05" + made.u64(1 << 63)) * 50_000)
    trials.imports("lengths.bag", made.BAG_BEGIN + made.u32(0xffffffff) * 200_000)
    tiny = made.message(0, 1, b"") * 15_000
    trials.imports("tiny.bag", made.BAG_BEGIN + made.connection(0, b"/odom", "nav_msgs/Odometry", made.ODOMETRY) + tiny)
    topics = b"".join(made.connection(i, b"/\x1b[2Jo\n%d" % i, "nav_msgs/Odometry", "") + made.message(i, 1, b"")
                      for i in range(1500))
    trials.imports("topics.bag", made.BAG_BEGIN + topics)


def schemas_before(after):
    head = made.u16(1) + made.mcap_text("a/B") + made.mcap_text("ros1msg")
    return b"\x03" + made.u64(len(head) + 4 + after) + head + made.u32(after)


def definitions(trials):
    for name, text in [
        ("bounds", "string" + "<=9" * 150_000 + " a\n"),
        ("names", "A " + "a" * 400_000 + "\n" + made.SEPARATOR + "MSG: " + "b" * 400_000 + "/A\n" + "A a\n" * 1000),
        ("nothing", "B[4294967295] b\n" + made.SEPARATOR + "MSG: nav_msgs/B\n"),
        ("deep", "".join(f"T{i} t\n{made.SEPARATOR}MSG: nav_msgs/T{i}\n" for i in range(5000)) + "uint8 a\n"),
        ("wide", "".join(f"T{i} a\nT{i} b\nT{i} c\nT{i} d\n{made.SEPARATOR}MSG: nav_msgs/T{i}\n" for i in range(28))),
        ("itself", "Odometry o\n"),
    ]:
        body = made.connection(0, b"/odom", "nav_msgs/Odometry", text)
        body += b"".join(made.message(0, i, bytes(1000)) for i in range(100))
        trials.imports(f"{name}.bag", made.BAG_BEGIN + body)


def images(trials):
    side = 5792
    row = bytes(1 + side)
    text = b"a\0\0" + zlib.compress(bytes(7_000_000), 9)
    deep = zlib.compress(bytes((1 + 8 * 4000) * 4000), 9)
    files = {
        "texts.png": made.png(8, 8, bytes(9 * 8), before=made.png_chunk(b"zTXt", text) * 50),
        "profile.png": made.png(8, 8, bytes(9 * 8), before=made.png_chunk(b"iCCP", text) * 50),
        "large.png": made.png(side, side, row * side),
        "huge.png": made.png(1_000_000, 1_000_000, b""),
        "wide.png": made.png(33_000_000, 1, bytes(100)),
        "colours.png": made.png(4000, 4000, bytes(1), depth=16, colour=6),
        "interlaced.png": made.png(side, side, row * 100, interlaced=1),
        "chunks.png": made.png(8, 8, bytes(9 * 8), before=made.png_chunk(b"gAMA", bytes(4)) * 50_000),
        "huge.jpg": made.jpeg(65_500, 65_500),
        "large.jpg": made.jpeg(side, side),
        "scans.jpg": made.jpeg(4000, 4000, scans=400, progressive=True),
        "many_scans.jpg": made.jpeg(64, 64, scans=9000, progressive=True),
        "cut.jpg": made.jpeg(640, 480)[:60],
        "nothing.jpg": b"",
        "noise.jpg": b"\xff\xd8" + random.Random(3).randbytes(300_000),
    }
    assert len(deep) < LARGEST_INPUT
    for name, content in files.items():
        folder = trials.folder / ("images_" + name.replace(".", "_"))
        (folder / "frames").mkdir(parents=True)
        for file in ("rig.toml", "odometry.csv"):
            shutil.copy(trials.runs / "mirror" / file, folder / file)
        rows = (trials.runs / "mirror/frames.csv").read_text().splitlines()
        stamp = rows[1].split(",")[0]
        (folder / "frames" / name).write_bytes(content)
        (folder / "frames.csv").write_text(f"{rows[0]}\n{stamp},frames/{name}\n")
        trials.azimuth_does("replay", folder)
        trials.azimuth_does("import", folder, trials.folder / "images.lcmlog", "--force")
        trials.azimuth_does("calibrate", "mirror", folder / "frames" / name, "--out", trials.folder / "rig.toml", "--force")
        body = made.drive_bag()[len(made.BAG_BEGIN):]
        body += made.connection(9, b"/image", "sensor_msgs/CompressedImage", made.COMPRESSED)
        body += made.message(9, 12, made.ros_compressed(12, content))
        trials.imports(name + ".bag", made.BAG_BEGIN + body)
    raw = made.connection(9, b"/image", "sensor_msgs/Image", made.IMAGE)
    for width, height, encoding in [(4_000_000_000, 4_000_000_000, "mono8"), (65_000, 65_000, "rgb8"), (0, 5, "mono8")]:
        raw += made.message(9, 12, made.ros_image(12, width, height, encoding, width, b"abc"))
    trials.imports("raw.bag", made.BAG_BEGIN + made.drive_bag()[len(made.BAG_BEGIN):] + raw)


def logs(trials):
    log = trials.folder / "lab.lcmlog"
    trials.azimuth_does("import", trials.runs / "lab", log, answers=(0,))
    whole = log.read_bytes()[:100_000]
    odometry = next((c, d) for c, d in made.lcm_events(whole) if c == b"AZIMUTH_ODOM")
    document = next((c, d) for c, d in made.lcm_events(whole) if c == b"AZIMUTH_DOCUMENT")
    files = {
        "lengths": b"".join(made.lcm_event(i, b"AZIMUTH_ODOM", b"", 0x7fffffff) for i in range(20_000)),
        "within": b"".join(made.lcm_event(i, b"AZIMUTH_ODOM", b"", 1_000_000 - 40 * i) for i in range(20_000)) + whole[:50_000],
        "channels": b"".join(made.lcm_event(i, b"\x1b[2J%d" % i, b"") for i in range(20_000)),
        "syncs": b"\xed\xa1\xda\x01" * 250_000,
        "empty": b"".join(made.lcm_event(i, b"AZIMUTH_ODOM", b"") for i in range(20_000)),
        "same": whole + made.lcm_event(1, *odometry) * 5000,
        "documents": whole + made.lcm_event(1, *document) * 500,
        "cut": whole[:-7],
    }
    for name, content in files.items():
        trials.reads_recording(trials.file(f"{name}.lcmlog", content))
    trials.azimuth_does("report", "logs", trials.folder, answers=(0,))


def tables(trials):
    rows = 20_000
    odometry = b"t_s,x_m,y_m,heading_rad\n" + b"".join(b"%d.0,%d,0,0\n" % (i, i) for i in range(rows))
    files = {
        "digits": b"t_s,x_m,y_m,heading_rad\n" + b"9" * 900_000 + b",0,0,0\n",
        "exponent": b"t_s,x_m,y_m,heading_rad\n1,1e" + b"9" * 900_000 + b",0,0\n",
        "fraction": b"t_s,x_m,y_m,heading_rad\n1,0." + b"1" * 900_000 + b",0,0\n",
        "columns": b"," * 500_000 + b"\n" + b"," * 400_000 + b"\n",
        "names": b"\x1b[31m" * 100_000 + b",x\n1,2\n",
        "lines": b"\n" * 1_000_000,
        "comments": b"#\n" * 500_000,
        "one_line": b"1" * 1_000_000,
        "wrong_rows": b"t_s,x_m,y_m,heading_rad\n" + b"a\n" * 400_000,
        "far": odometry,
        "noise": random.Random(4).randbytes(500_000),
        "zeros": bytes(1_000_000),
    }
    for name, content in files.items():
        table = trials.file(f"{name}.csv", content)
        out = trials.folder / "table"
        trials.azimuth_does("import", table, out, "--force")
        trials.azimuth_does("import", trials.runs / "lab/odometry.csv", out, "--force", "--bearings", table,
                            "--rig", trials.runs / "lab/rig.toml")
        trials.azimuth_does("import", table, out, "--force", "--columns", "t_s=1[ns],x_m=2,y_m=3[mm],heading_rad=4[deg]")
        trials.azimuth_does("replay", trials.run_of(f"{name}_o", odometry_csv=content))
        trials.azimuth_does("replay", trials.run_of(f"{name}_b", bearings_csv=content))
        trials.azimuth_does("report", "trajectory", trials.runs / "lab", table)
        trials.azimuth_does("map", "info", table)


def files_in(folder):
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def interrupted(trials, bag, out, begun, end):
    """Sends the signal `end` to an import when the file `begun` exists; returns the exit code."""
    command = [trials.azimuth, "import", str(bag), str(out), "--force", "--rig", str(trials.runs / "lab/rig.toml")]
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    until = time.monotonic() + WALL_S
    while not begun.exists() and process.poll() is None and time.monotonic() < until:
        time.sleep(0.005)
    process.send_signal(end)
    trials.tried += 1
    return process.wait(timeout=WALL_S)


def interrupts(trials):
    """Checks that Ctrl-C leaves the earlier files unchanged and no new ones."""
    body = made.connection(9, b"/image", "sensor_msgs/Image", made.IMAGE)
    noise = random.Random(5).randbytes(640 * 480 * 3)
    for i in range(150):
        body += made.message(9, 10 + i, made.ros_image(10 + i, 640, 480, "rgb8", 640 * 3, noise))
    bag = trials.folder / "images.bag"
    bag.write_bytes(made.drive_bag(readings=200) + body)
    for end in (signal.SIGINT, signal.SIGTERM):
        for name, before in [("new", None), ("old", "lab"), ("log.lcmlog", None), ("old.lcmlog", "log")]:
            folder = trials.folder / f"interrupted_{end}"
            out = folder / name
            folder.mkdir(exist_ok=True)
            if before == "lab":
                shutil.copytree(trials.runs / "lab", out)
            if before == "log":
                out.write_bytes(b"an older log")
            there = files_in(folder)
            begun = folder / (name + ".images") if name.endswith("log") else out / ".unfinished/frames/000003.png"
            code = interrupted(trials, bag, out, begun, end)
            if code != 130:
                trials.failures.append(f"{name} interrupted by {end}: exit code {code}")
            if files_in(folder) != there or (before is None and out.exists()):
                trials.failures.append(f"{name} interrupted by {end}: leaves {sorted(files_in(folder))}")
    trials.azimuth_does("import", bag, trials.folder / "whole", answers=(0,))
    if (trials.folder / "whole/.unfinished").exists() or len(files_in(trials.folder / "whole/frames")) != 150:
        trials.failures.append("an import that ends by itself is not whole")


def changed(content, chance):
    """Changes some bytes, lengths or parts of the content."""
    content = bytearray(content)
    for _ in range(chance.choice((1, 1, 2, 5, 20))):
        if not content:
            break
        at = chance.randrange(len(content))
        kind = chance.randrange(7)
        if kind == 0:
            content[at] ^= 1 << chance.randrange(8)
        elif kind == 1:
            content[at] = chance.choice((0, 1, 0x7f, 0x80, 0xff, 0x1b, 0x0a, 0x2e, 0x2c))
        elif kind == 2:
            content[at:at + 4] = chance.choice((made.u32(0xffffffff), made.u32(0x7fffffff), made.u32(0), b"\0\0\xff\xff"))
        elif kind == 3:
            del content[at:at + chance.choice((1, 4, 100, 5000))]
        elif kind == 4:
            piece = content[at:at + chance.choice((1, 8, 200, 5000))]
            content[at:at] = piece * chance.choice((1, 2, 20))
        elif kind == 5:
            del content[at:]
        else:
            content[at:at + 1] = chance.choice((b"nan", b"-inf", b"1e999", b"9" * 40, b"\xff\xfe", b'"', b"[[", b"\0"))
    return bytes(content[:LARGEST_INPUT])


def mutants(trials, numbers):
    trials.most_cpu_s = LONGEST_REPLAY_S
    log = trials.folder / "lab.lcmlog"
    trials.azimuth_does("import", trials.runs / "lab", log, answers=(0,))
    lab, mirror = trials.runs / "lab", trials.runs / "mirror"
    saved = trials.folder / "lab.azmap"
    trials.azimuth_does("map", "save", lab, "--map", saved, answers=(0,))
    sources = [("bag", made.drive_bag()), ("bag", made.drive_bag("bz2")), ("mcap", made.drive_mcap()),
               ("log", log.read_bytes()[:100_000]), ("map", saved.read_bytes())]
    sources += [("lab", file) for file in ("odometry.csv", "bearings.csv", "rig.toml", "landmarks.csv", "truth.csv")]
    sources += [("mirror", file) for file in ("frames.csv", "rig.toml", sorted((mirror / "frames").iterdir())[0].name)]
    for number in numbers:
        chance = random.Random(number)
        kind, what = sources[number % len(sources)]
        if kind in ("bag", "mcap"):
            trials.imports(f"mutant.{kind}", changed(what, chance))
        elif kind == "log":
            path = trials.file("mutant.lcmlog", changed(what, chance))
            trials.azimuth_does("replay", path)
            trials.daemon_checks("--play", path)
        elif kind == "map":
            trials.azimuth_does("map", "info", trials.file("mutant.azmap", changed(what, chance)))
            trials.azimuth_does("replay", mirror, "--map", trials.folder / "mutant.azmap")
        else:
            folder = trials.folder / "mutant"
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(trials.runs / kind, folder)
            for file in folder.rglob(what):
                file.write_bytes(changed(file.read_bytes(), chance))
            trials.azimuth_does("replay", folder)
            trials.azimuth_does("check" if kind == "lab" else "import", folder,
                                *([] if kind == "lab" else [trials.folder / "mutant_out", "--force"]))


def main():
    azimuth, azimuthd, runs, kind = sys.argv[1:5]
    count = int(sys.argv[5]) if len(sys.argv) > 5 else 60
    first = int(sys.argv[6]) if len(sys.argv) > 6 else 0
    with tempfile.TemporaryDirectory(prefix="azimuth-hostile-") as folder:
        trials = Trials(azimuth, azimuthd, pathlib.Path(runs).resolve(), pathlib.Path(folder))
        work = {"texts": texts, "bombs": bombs, "images": images, "logs": logs, "tables": tables, "interrupts": interrupts}
        mutants(trials, range(first, first + count)) if kind == "mutants" else work[kind](trials)
        (cpu_s, slowest), (peak_MB, largest) = trials.worst
        print(f"{trials.tried} commands; slowest {cpu_s:.2f} s: {slowest}; largest {peak_MB:.0f} MB: {largest}")
        for failure in trials.failures:
            print(failure)
        return 1 if trials.failures or trials.tried == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
