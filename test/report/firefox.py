"""Firefox without a window, for tests of pages: driven by its own protocol (Marionette), so that nothing
else has to be installed."""
import json
import os
import shutil
import socket
import subprocess
import tempfile
import time
from pathlib import Path

from browser import Missing

PREFERENCES = {
    "app.update.enabled": False,
    "browser.shell.checkDefaultBrowser": False,
    "datareporting.policy.dataSubmissionEnabled": False,
    "toolkit.telemetry.enabled": False,
    # WebGL by software.
    "webgl.force-enabled": True,
    "webgl.disabled": False,
}


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Firefox:
    """A browser with one page. Close it with quit()."""

    def __init__(self, width=1200, height=900, preferences=()):
        program = shutil.which("firefox-esr") or shutil.which("firefox")
        if not program:
            raise Missing("there is no firefox (Debian's firefox-esr)")
        self.folder = tempfile.TemporaryDirectory(prefix="firefox_")
        port = free_port()
        wanted = {**PREFERENCES, "marionette.port": port, **dict(preferences)}
        Path(self.folder.name, "user.js").write_text("".join(
            f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in wanted.items()))
        environment = {"HOME": self.folder.name, "PATH": "/usr/bin:/bin"}
        # Without a display Firefox has no WebGL; Xvfb is one without a screen.
        self.display = self.open_display(width, height)
        if self.display:
            environment["DISPLAY"] = self.display_name
        else:
            environment["MOZ_HEADLESS"] = "1"
        self.process = subprocess.Popen(
            [program, "--marionette", "--no-remote", "--profile", self.folder.name,
             f"--width={width}", f"--height={height}"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
        self.number = 0
        try:
            self.connection = self.connect(port)
            self.receive()  # It greets.
            self.ask("WebDriver:NewSession", {"capabilities": {"alwaysMatch": {
                "pageLoadStrategy": "normal", "timeouts": {"script": 60000, "pageLoad": 120000}}}})
        except Exception:
            self.quit()
            raise

    def open_display(self, width, height):
        """Returns the process of a display that others do not see, or None where there is no Xvfb."""
        program = shutil.which("Xvfb")
        if not program:
            return None
        read, write = os.pipe()
        display = subprocess.Popen(
            [program, "-displayfd", str(write), "-screen", "0", f"{width}x{height + 120}x24", "-nolisten", "tcp"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, pass_fds=(write,))
        os.close(write)
        with os.fdopen(read) as number:
            self.display_name = ":" + number.readline().strip()
        return display

    def connect(self, port):
        for _ in range(600):
            try:
                return socket.create_connection(("127.0.0.1", port), timeout=180)
            except OSError:
                if self.process.poll() is not None:
                    raise Missing(f"firefox ended with {self.process.returncode}")
                time.sleep(0.1)
        raise Missing("firefox does not answer")

    def receive(self):
        """A message is its length, a colon and JSON."""
        length = b""
        while not length.endswith(b":"):
            length += self.connection.recv(1)
        size, data = int(length[:-1]), b""
        while len(data) < size:
            data += self.connection.recv(size - len(data))
        return json.loads(data)

    def ask(self, command, parameters):
        self.number += 1
        text = json.dumps([0, self.number, command, parameters]).encode()
        self.connection.sendall(str(len(text)).encode() + b":" + text)
        _, _, error, result = self.receive()
        if error:
            raise RuntimeError(f"{command}: {error['message']}")
        return result

    def get(self, address):
        self.ask("WebDriver:Navigate", {"url": address})

    def run(self, script, *arguments):
        """Runs JavaScript with `arguments` in the page, and returns what it returns."""
        return self.ask("WebDriver:ExecuteScript", {"script": script, "args": list(arguments)})["value"]

    def screenshot(self, path):
        import base64
        data = self.ask("WebDriver:TakeScreenshot", {"full": False, "hash": False})["value"]
        Path(path).write_bytes(base64.b64decode(data))

    def print(self, path):
        """Prints the page to a PDF."""
        import base64
        data = self.ask("WebDriver:Print", {"background": True})["value"]
        Path(path).write_bytes(base64.b64decode(data))

    def quit(self):
        try:
            self.ask("Marionette:Quit", {"flags": ["eForceQuit"]})
        except Exception:
            pass
        try:
            self.process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        if self.display:
            self.display.terminate()
            self.display.wait()
        self.folder.cleanup()
