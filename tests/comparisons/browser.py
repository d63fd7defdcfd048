"""A headless Chromium driven over its DevTools pipe: needs the browser alone, opens no port."""

import base64
import fcntl
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

SWITCHES = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--remote-debugging-pipe",
)

KEY_CODES = {"Tab": 9, "Home": 36, "ArrowLeft": 37, "ArrowRight": 39, " ": 32, "v": 86}


def chromium():
    """Path of the browser, or None when it is not installed."""
    return shutil.which("chromium") or shutil.which("chromium-browser")


class Browser:
    """One page of a private browser; a context manager. `problems` collects console errors, exceptions and network requests."""

    def __init__(self, width=1366, height=900):
        self.problems = []
        self._profile = tempfile.TemporaryDirectory(prefix="endoflow-browser-", ignore_cleanup_errors=True)
        self._number = 0
        self._buffer = b""
        self._start(width, height)
        target = self._call("Target.createTarget", {"url": "about:blank"})["targetId"]
        self._session = self._call("Target.attachToTarget", {"targetId": target, "flatten": True})["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self._call(f"{domain}.enable")
        self.resize(width, height)

    def _start(self, width, height):
        """Launch the browser, which reads commands from descriptor 3 and writes answers to descriptor 4."""
        command_read, self._commands = os.pipe()
        self._answers, answer_write = os.pipe()
        ends = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 10) for end in (command_read, answer_write)]
        self._process = subprocess.Popen(
            [chromium(), *SWITCHES, f"--user-data-dir={self._profile.name}", f"--window-size={width},{height}"],
            preexec_fn=lambda: [os.dup2(end, number) for end, number in zip(ends, (3, 4))],
            close_fds=False,  # 3 and 4 may be closed here; what else Python opened is not inherited
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        for end in (command_read, answer_write, *ends):
            os.close(end)
        self._session = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._session = None
            self._call("Browser.close", timeout=5)
            self._process.wait(5)
        except (OSError, RuntimeError, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()
        os.close(self._commands)
        os.close(self._answers)
        self._profile.cleanup()

    def _call(self, method, parameters=None, timeout=600):
        """Send one DevTools command and wait for its answer."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters or {}}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._commands, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._next_message(timeout)
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self._note(answer)

    def _next_message(self, timeout):
        end = time.monotonic() + timeout
        while b"\0" not in self._buffer:
            if not select.select([self._answers], [], [], max(0, end - time.monotonic()))[0]:
                raise RuntimeError("the browser does not answer")
            received = os.read(self._answers, 1 << 20)
            if not received:
                raise RuntimeError("the browser ended")
            self._buffer += received
        message, self._buffer = self._buffer.split(b"\0", 1)
        return json.loads(message)

    def _note(self, event):
        """Keep events that a healthy, self-contained page does not cause."""
        method, parameters = event.get("method"), event.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.problems.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.problems.append(parameters["entry"]["text"])
        elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "assert"):
            self.problems.append(str(parameters["args"]))
        elif method == "Network.requestWillBeSent" and not parameters["request"]["url"].startswith(
            ("file:", "data:", "about:")
        ):
            self.problems.append("network request: " + parameters["request"]["url"])

    def open(self, path, ready, timeout=600):
        """Open a file (pathlib.Path) and wait until the JavaScript expression `ready` is true."""
        self._call("Page.navigate", {"url": path.resolve().as_uri()})
        end = time.monotonic() + timeout
        while self.evaluate(ready) is not True:
            if time.monotonic() > end:
                raise RuntimeError(f"{path.name} did not become ready: {self.problems}")
            time.sleep(0.05)

    def visit(self, url):
        """Go to an address; the page before is left, also where the new address differs in its fragment alone."""
        self._call("Page.navigate", {"url": "about:blank"})
        self._call("Page.navigate", {"url": url})

    def download_to(self, directory):
        """Save what the page offers for download in a directory (pathlib.Path), without a question."""
        self._call("Page.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(directory)})

    def evaluate(self, expression):
        """Value of a JavaScript expression, promises awaited."""
        answer = self._call("Runtime.evaluate", {"expression": expression, "returnByValue": True, "awaitPromise": True})
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"]["exception"]["description"])
        return answer["result"].get("value")

    def press(self, key, shift=False):
        """Press and release a key of KEY_CODES."""
        common = {
            "key": key,
            "code": "Space" if key == " " else key,
            "windowsVirtualKeyCode": KEY_CODES[key],
            "modifiers": 8 * shift,
        }
        self._call("Input.dispatchKeyEvent", {"type": "keyDown", "text": key if len(key) == 1 else "", **common})
        self._call("Input.dispatchKeyEvent", {"type": "keyUp", **common})

    def click(self, x, y):
        """Click at page coordinates in CSS pixels."""
        for kind in ("mousePressed", "mouseReleased"):
            self._call(
                "Input.dispatchMouseEvent",
                {"type": kind, "x": x, "y": y, "button": "left", "buttons": 1, "clickCount": 1},
            )

    def resize(self, width, height):
        """Set the page's size in CSS pixels."""
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self._call("Emulation.setDeviceMetricsOverride", size)

    def prefer(self, scheme, motion="no-preference"):
        """Make the system ask for "light" or "dark", and for motion, "no-preference" or "reduce"."""
        features = {"prefers-color-scheme": scheme, "prefers-reduced-motion": motion}
        features = [{"name": name, "value": value} for name, value in features.items()]
        self._call("Emulation.setEmulatedMedia", {"features": features})

    def named_parts(self):
        """(role, name, description) of what a screen reader meets, in its order."""
        nodes = self._call("Accessibility.getFullAXTree")["nodes"]
        read = [[node.get(part, {}).get("value", "") for part in ("role", "name", "description")] for node in nodes if not node["ignored"]]
        return [tuple(part) for part in read]

    def screenshot(self, path, whole_page=False):
        """Save what is shown, or the whole page, as a PNG (pathlib.Path)."""
        answer = self._call(
            "Page.captureScreenshot", {"format": "png", "captureBeyondViewport": whole_page, **self._clip(whole_page)}
        )
        path.write_bytes(base64.b64decode(answer["data"]))

    def _clip(self, whole_page):
        if not whole_page:
            return {}
        size = self._call("Page.getLayoutMetrics")["cssContentSize"]
        return {"clip": {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}}
