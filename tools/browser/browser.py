"""A headless Chromium, driven through its debugging pipe (https://chromedevtools.github.io/devtools-protocol/).

Needs the program `chromium` (Debian: the package of this name) and nothing besides Python.
"""

import base64
import json
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

# No network, and WebGL without a graphics card.
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-quic",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--force-prefers-reduced-motion",
    "--remote-debugging-pipe",
]


class Browser:
    """One page of a headless browser. Use it in a `with` statement."""

    def __init__(self, width=1280, height=900, touch=False):
        self.folder = tempfile.mkdtemp(prefix="browser")
        to_child, self.commands = os.pipe()
        self.answers, from_child = os.pipe()
        # The browser reads commands from descriptor 3 and writes answers to descriptor 4.
        pipes = f"exec chromium {' '.join(FLAGS)} --user-data-dir={self.folder} 3<&{to_child} 4>&{from_child}"
        self.process = subprocess.Popen(
            ["bash", "-c", pipes], pass_fds=(to_child, from_child), stderr=subprocess.DEVNULL
        )
        os.close(to_child)
        os.close(from_child)
        self.number, self.buffer, self.events = 0, b"", []
        self.session = None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ["Page", "Runtime", "Log"]:
            self.call(f"{domain}.enable")
        self.resize(width, height, touch)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def resize(self, width, height, touch=False):
        """Sets the size of the page [px]; with `touch`, the page is that of a phone."""
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": touch}
        self.call("Emulation.setDeviceMetricsOverride", **size)
        self.call("Emulation.setTouchEmulationEnabled", enabled=touch)

    def call(self, method, **arguments):
        """Sends a command and returns its result."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": arguments}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.commands, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.read()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self.events.append(answer)

    def read(self):
        while b"\0" not in self.buffer:
            part = os.read(self.answers, 1 << 20)
            if not part:
                raise RuntimeError("the browser has ended")
            self.buffer += part
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def open(self, path, ready, seconds=60):
        """Opens a file and waits until the expression `ready` is true. Returns the time that it took [s]."""
        begun = time.monotonic()
        self.call("Page.navigate", url=Path(path).resolve().as_uri())
        self.wait(ready, seconds)
        return time.monotonic() - begun

    def wait(self, expression, seconds=60):
        """Waits until an expression is true."""
        end = time.monotonic() + seconds
        while not self.value(f"Boolean({expression})"):
            if time.monotonic() > end:
                raise TimeoutError(f"not true after {seconds} s: {expression}; errors: {self.errors()}")
            time.sleep(0.1)

    def value(self, expression):
        """Returns the value of an expression in the page."""
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def press(self, key, shift=False):
        """Presses a key."""
        text = {"text": key} if len(key) == 1 else {}
        for kind in ["keyDown", "keyUp"]:
            arguments = {"type": kind, "key": key, "modifiers": 8 if shift else 0}
            self.call("Input.dispatchKeyEvent", **arguments, **(text if kind == "keyDown" else {}))

    def mouse(self, kind, x, y, buttons=0):
        """Sends a mouse event: mousePressed, mouseMoved or mouseReleased."""
        button = "none" if kind == "mouseMoved" and not buttons else "left"
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, buttons=buttons, clickCount=1)

    def drag(self, start, end, steps=5):
        """Drags the mouse from one position to another [px]."""
        self.mouse("mouseMoved", *start)
        self.mouse("mousePressed", *start, buttons=1)
        for step in range(1, steps + 1):
            self.mouse("mouseMoved", *[a + (b - a) * step / steps for a, b in zip(start, end)], buttons=1)
        self.mouse("mouseReleased", *end)

    def click(self, x, y):
        """Clicks a position [px]."""
        self.drag((x, y), (x, y), steps=0)

    def screenshot(self, path, whole=False):
        """Saves a picture of the page, or of the whole page beyond the window."""
        data = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=whole)["data"]
        Path(path).write_bytes(base64.b64decode(data))

    def errors(self):
        """Returns the errors and warnings of the console so far."""
        self.value("0")
        found = []
        for event in self.events:
            what = event.get("params", {})
            if event.get("method") == "Runtime.exceptionThrown":
                found.append(what["exceptionDetails"].get("exception", {}).get("description", "exception"))
            elif event.get("method") == "Runtime.consoleAPICalled" and what["type"] in ["error", "warning"]:
                found.append(str([argument.get("value") for argument in what["args"]]))
            elif event.get("method") == "Log.entryAdded" and what["entry"]["level"] in ["error", "warning"]:
                found.append(what["entry"]["text"])
        return found
