"""Drives a headless browser through chromedriver (W3C WebDriver over HTTP), with the commands that the tests use."""

import base64
import json
import shutil
import subprocess
import time
import urllib.error
import urllib.request


def chromium():
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


def is_here():
    return chromium() is not None and shutil.which("chromedriver") is not None


class Browser:
    """A context manager that runs the browser. Thread contract: one thread."""

    def __init__(self, folder, width=1400, height=900):
        self.folder, self.width, self.height = folder, width, height

    def __enter__(self):
        self.log = open(f"{self.folder}/chromedriver.log", "w+", encoding="utf-8")
        self.process = subprocess.Popen(["chromedriver", "--port=0", "--allowed-ips=127.0.0.1"], stdout=self.log, stderr=subprocess.STDOUT)
        self.address = f"http://127.0.0.1:{self.port()}"
        arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run", "--disable-background-networking",
                     "--disable-component-update", f"--user-data-dir={self.folder}/profile", f"--window-size={self.width},{self.height}"]
        wanted = {"browserName": "chrome", "goog:chromeOptions": {"binary": chromium(), "args": arguments}, "goog:loggingPrefs": {"browser": "ALL"}}
        self.session = self.send("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})["sessionId"]
        self.size(self.width, self.height)
        return self

    def __exit__(self, *_):
        try:
            self.send("DELETE", f"/session/{self.session}")
        finally:
            self.process.terminate()
            self.process.wait(10)
            self.log.close()

    def port(self):
        end_s = time.monotonic() + 20
        while time.monotonic() < end_s:
            with open(self.log.name, encoding="utf-8") as log:
                words = log.read()
            if "on port " in words and "successfully" in words:
                return int(words.rsplit("on port ", 1)[1].split(".")[0])
            time.sleep(0.05)
        raise TimeoutError("chromedriver names no port")

    def send(self, method, path, data=None):
        body = json.dumps(data if data is not None else {}).encode() if method == "POST" else None
        request = urllib.request.Request(self.address + path, body, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def ask(self, command, data=None, method="POST"):
        return self.send(method, f"/session/{self.session}{command}", data)

    def open(self, address):
        self.ask("/url", {"url": address})

    def run(self, script, *arguments):
        """Runs `script` as the body of a function and returns its result; a promise is awaited."""
        return self.ask("/execute/sync", {"script": script, "args": list(arguments)})

    def devtools(self, command, **parameters):
        return self.ask("/goog/cdp/execute", {"cmd": command, "params": parameters})

    def size(self, width, height, phone=False):
        self.devtools("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=2 if phone else 1, mobile=phone)
        self.devtools("Emulation.setTouchEmulationEnabled", enabled=phone)

    def scheme(self, name):
        self.devtools("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": name}])

    def screenshot(self, file):
        file.write_bytes(base64.b64decode(self.ask("/screenshot", method="GET")))

    def complaints(self):
        """Returns the messages on the browser's console since the last call."""
        return [entry["message"] for entry in self.ask("/se/log", {"type": "browser"})]

    def until(self, condition, within_s, words=None):
        """Waits until the script's expression is true and returns the seconds; raises after `within_s`."""
        begin_s = time.monotonic()
        while time.monotonic() - begin_s < within_s:
            if self.run(f"return Boolean({condition})"):
                return time.monotonic() - begin_s
            time.sleep(0.03)
        raise AssertionError(f"not within {within_s} s: {words or condition}")
