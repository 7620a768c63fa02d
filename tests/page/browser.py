# SPDX-License-Identifier: Apache-2.0
"""A browser as the tests use it: open a page, run a script in it, move pointer and keys, give files, take pictures.

Chromium and WebKit are driven over WebDriver, Firefox over WebDriver BiDi: Debian has no geckodriver.
"""
import base64
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest
import urllib.error
import urllib.request

from bidi import Bidi

PATIENCE_S = 60
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"


class Browser:
    """What is common: scripts take and give JSON values, actions are those of the WebDriver standard."""

    name = ""

    def run(self, body, *words):
        """Runs `body`, the body of an async function of `words`, in the page; gives what it returns."""
        raise NotImplementedError

    def wait_for(self, body, *words, what=""):
        """Runs `body` until it returns something that is true, and gives that; of an element only that it is there."""
        end = time.monotonic() + PATIENCE_S
        while True:
            # An element has no JSON: Firefox would give an empty object for it, which is not true in Python.
            value = self.run(f"const found = await (async () => {{ {body} }})(); return found instanceof Node ? true : found", *words)
            if value:
                return value
            if time.monotonic() > end:
                raise AssertionError(f"waited {PATIENCE_S} s for {what or body}")
            time.sleep(0.02)

    def open_page(self, path):
        self.open(pathlib.Path(path).resolve().as_uri())
        self.wait_for("return document.documentElement.dataset.ready === 'yes'", what="the page to be ready")

    def release_buttons(self):
        """No button of the pointer stays pressed, whatever was done with it before."""

    def load_for_the_first_time(self):
        """The next page is the first one of its window, where that makes a difference."""

    def call(self, requests):
        """The replies of the page's libraries to a list of requests."""
        return json.loads(self.run("return JSON.stringify(JSON.parse(words[0]).map((one) => dpslaved.call(one)))",
                                   json.dumps(requests)))


class WebDriver(Browser):
    def __init__(self, command, capabilities):
        self.folder = tempfile.mkdtemp(prefix="check-page-")
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.address = f"http://127.0.0.1:{port}"
        self.said = open(f"{self.folder}/driver.log", "w+", encoding="utf-8", errors="replace")
        self.driver = subprocess.Popen(command + [f"--port={port}"], stdout=self.said, stderr=subprocess.STDOUT,
                                       start_new_session=True)
        self.capabilities = capabilities(self.folder)
        self.session = ""
        try:
            self._wait_until_it_listens(port)
            self.begin()
        except BaseException:
            self.close()
            raise

    def begin(self):
        """Begins a session: the driver starts the browser."""
        made = self._send("POST", "/session", {"capabilities": {"alwaysMatch": self.capabilities}})
        self.session = f"/session/{made['sessionId']}"
        self.version = made["capabilities"].get("browserVersion", "")
        self.post("/timeouts", {"script": PATIENCE_S * 1000, "pageLoad": PATIENCE_S * 1000})

    def _wait_until_it_listens(self, port):
        end = time.monotonic() + PATIENCE_S
        while True:
            try:
                socket.create_connection(("127.0.0.1", port), timeout=1).close()
                return
            except OSError:
                if time.monotonic() > end or self.driver.poll() is not None:
                    raise
                time.sleep(0.05)

    def _send(self, method, path, body=None):
        request = urllib.request.Request(self.address + path, method=method,
                                         data=None if body is None else json.dumps(body).encode(),
                                         headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=2 * PATIENCE_S) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as refused:
            raise RuntimeError(f"{path}: {refused.read().decode(errors='replace')[:2000]}") from None

    def post(self, path, body):
        return self._send("POST", self.session + path, body)

    def open(self, address):
        self.post("/url", {"url": address})

    def window(self):
        """The window that all else is about."""
        return self._send("GET", self.session + "/window")

    def go_to(self, window):
        self.post("/window", {"handle": window})

    def new_window(self):
        """Opens a further window and goes to it."""
        self.go_to(self.post("/window/new", {"type": "window"})["handle"])

    def close_window(self, window):
        """Closes the window that all else is about, and goes to another one."""
        self._send("DELETE", self.session + "/window")
        self.go_to(window)

    def run(self, body, *words):
        script = ("const words = [...arguments], done = words.pop();"
                  f"(async () => {{ {body} }})().then((value) => done({{ value }}), (error) => done({{ error: String(error) }}));")
        outcome = self.post("/execute/async", {"script": script, "args": list(words)})
        if "error" in outcome:
            raise RuntimeError(outcome["error"])
        return outcome.get("value")

    def act(self, *sources):
        self.post("/actions", {"actions": list(sources)})

    def give_files(self, element, *paths):
        """`element` is the body of a function that returns an input for files."""
        found = self.post("/execute/sync", {"script": element, "args": []})
        self.post(f"/element/{found[ELEMENT]}/value", {"text": "\n".join(map(str, paths))})

    def picture(self):
        return base64.b64decode(self._send("GET", self.session + "/screenshot"))

    def quit(self):
        """Ends the browser, where the driver does not take it with it."""

    def close(self):
        try:
            self.quit()
        finally:
            stop(self.driver)
            self.said.close()
            shutil.rmtree(self.folder, ignore_errors=True)


class Chromium(WebDriver):
    name = "chromium"

    def __init__(self, logs=True, arguments=()):
        """Without `logs` the driver does not watch console and network: a measurement would see its work."""
        def capabilities(folder):
            return {
                "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"} if logs else {},
                "goog:chromeOptions": {
                    "binary": "/usr/bin/chromium",
                    "args": ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-background-networking",
                             "--window-size=1280,900", "--force-device-scale-factor=1", f"--user-data-dir={folder}/profile", *arguments],
                    "prefs": {"download.default_directory": f"{folder}/downloads"},
                },
            }
        super().__init__(["chromedriver"], capabilities)
        self.downloads = pathlib.Path(self.folder, "downloads")
        self.open("about:blank")
        if logs:
            self.requests()

    def quit(self):
        if self.session:
            self._send("DELETE", self.session)

    def cdp(self, command, **parameters):
        return self.post("/goog/cdp/execute", {"cmd": command, "params": parameters})

    def messages(self):
        """What came to the console since the last call."""
        return [entry["message"] for entry in self.post("/se/log", {"type": "browser"})]

    def requests(self):
        """Addresses asked for since the last call."""
        events = [json.loads(entry["message"])["message"] for entry in self.post("/se/log", {"type": "performance"})]
        return [event["params"]["request"]["url"] for event in events if event["method"] == "Network.requestWillBeSent"]


class WebKit(WebDriver):
    name = "webkit"

    def __init__(self):
        def capabilities(_):
            return {"webkitgtk:browserOptions": {"binary": minibrowser(), "args": ["--automation"]}}
        self.screen = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "1400x1000x24", "-nolisten", "tcp"],
                                       stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, start_new_session=True)
        display = self.screen.stdout.readline().strip()
        self.downloads = None
        self.other_button = False  # whether another than the left one was pressed in this session
        try:
            # Without its sandbox: a container has no user namespaces.
            super().__init__(["env", f"DISPLAY=:{display}", "WEBKIT_DISABLE_SANDBOX_THIS_IS_DANGEROUS=1",
                              "LIBGL_ALWAYS_SOFTWARE=1", "WebKitWebDriver"], capabilities)
        except BaseException:
            stop(self.screen)
            raise

    def begin(self):
        super().begin()
        self.post("/window/rect", {"width": 1280, "height": 900})

    def act(self, *sources):
        super().act(*sources)
        self.other_button |= any(one.get("button") for source in sources for one in source["actions"])

    def release_buttons(self):
        # The driver (2.50.6) releases the left button, whichever was pressed. As long as another one stays pressed the page
        # gets no pointerup, and letters come without their Shift. Only a new session ends that.
        if self.other_button:
            self.begin_again()

    def load_for_the_first_time(self):
        # A page that is loaded into a window as its second one gets no "storage" event any more (2.50.6).
        self.begin_again()

    def begin_again(self):
        self._send("DELETE", self.session)
        self.begin()
        self.other_button = False

    def messages(self):
        raise unittest.SkipTest("WebKitGTK's driver does not tell what came to the console")

    def requests(self):
        return self.run("return performance.getEntriesByType('resource').map((one) => one.name)")

    def close(self):
        try:
            super().close()
        finally:
            stop(self.screen)


class Firefox(Browser):
    name = "firefox"

    def __init__(self):
        self.folder = tempfile.mkdtemp(prefix="check-page-")
        self.downloads = pathlib.Path(self.folder, "downloads")
        self.downloads.mkdir()
        profile = pathlib.Path(self.folder, "profile")
        profile.mkdir()
        settings = {"browser.download.folderList": 2, "browser.download.dir": str(self.downloads),
                    "browser.download.useDownloadDir": True, "browser.shell.checkDefaultBrowser": False,
                    "datareporting.policy.dataSubmissionEnabled": False, "app.update.disabledForTesting": True,
                    "remote.log.level": "Info", "browser.startup.page": 0}
        (profile / "user.js").write_text("".join(f"user_pref({json.dumps(name)}, {json.dumps(value)});\n"
                                                 for name, value in settings.items()), encoding="utf-8")
        self.said = open(f"{self.folder}/firefox.log", "w+", encoding="utf-8", errors="replace")
        self.program = subprocess.Popen(
            ["firefox-esr", "--headless", "--no-remote", "--profile", str(profile), "--remote-debugging-port", "0",
             "--width", "1280", "--height", "900", "about:blank"],
            stdout=self.said, stderr=subprocess.STDOUT, start_new_session=True, env=home_in(self.folder))
        self.bidi = None
        try:
            self.bidi = Bidi(self._address(), PATIENCE_S)
            self.version = self.bidi.send("session.new", capabilities={})["capabilities"]["browserVersion"]
            # A window of its own: the first one has no focus, and keys would be lost.
            self.context = self.bidi.send("browsingContext.create", type="window")["context"]
            self.bidi.send("session.subscribe", events=["log.entryAdded", "network.beforeRequestSent"])
            self.bidi.send("browsingContext.setViewport", context=self.context, viewport={"width": 1280, "height": 900})
        except BaseException:
            self.close()
            raise

    def _address(self):
        sign = "WebDriver BiDi listening on "
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end and self.program.poll() is None:
            self.said.seek(0)
            for line in self.said:
                if line.startswith(sign) and line.endswith("\n"):
                    return line.removeprefix(sign).strip() + "/session"
            time.sleep(0.05)
        raise RuntimeError("Firefox does not listen")

    def window(self):
        return self.context

    def go_to(self, window):
        # Without a screen the focus stays in the newest window: a button of another one answers no key.
        self.context = window

    def new_window(self):
        self.go_to(self.bidi.send("browsingContext.create", type="window")["context"])

    def close_window(self, window):
        self.bidi.send("browsingContext.close", context=self.context)
        self.go_to(window)

    def open(self, address):
        self.bidi.send("browsingContext.navigate", context=self.context, url=address, wait="complete")

    def run(self, body, *words):
        outcome = self._call(f"async (text) => {{ const words = JSON.parse(text); const value = await (async () => {{ {body} }})();"
                             " return JSON.stringify(value ?? null); }", json.dumps(words))
        return json.loads(outcome["value"])

    def _call(self, function, *words):
        outcome = self.bidi.send("script.callFunction", functionDeclaration=function, awaitPromise=True,
                                 target={"context": self.context}, userActivation=True,
                                 arguments=[{"type": "string", "value": word} for word in words])
        if outcome["type"] == "exception":
            raise RuntimeError(outcome["exceptionDetails"]["text"])
        return outcome["result"]

    def act(self, *sources):
        self.bidi.send("input.performActions", context=self.context, actions=list(sources))

    def give_files(self, element, *paths):
        found = self._call(f"() => {{ {element} }}")
        self.bidi.send("input.setFiles", context=self.context, element={"sharedId": found["sharedId"]},
                       files=[str(path) for path in paths])

    def picture(self):
        return base64.b64decode(self.bidi.send("browsingContext.captureScreenshot", context=self.context)["data"])

    def messages(self):
        return [event["text"] or "" for event in self.bidi.take("log.entryAdded")]

    def requests(self):
        return [event["request"]["url"] for event in self.bidi.take("network.beforeRequestSent")
                if event["context"] == self.context]

    def close(self):
        if self.bidi:
            self.bidi.close()
        stop(self.program)
        self.said.close()
        shutil.rmtree(self.folder, ignore_errors=True)


def home_in(folder):
    return {**os.environ, "HOME": folder, "MOZ_DISABLE_CONTENT_SANDBOX": "1"}


def minibrowser():
    for path in sorted(pathlib.Path("/usr/lib").glob("*/webkit2gtk-4.1/MiniBrowser")):
        return str(path)
    raise RuntimeError("there is no MiniBrowser of webkit2gtk-4.1")


def stop(program):
    """Ends a program and what it started in its session."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(program.pid, number)
        except ProcessLookupError:
            break
        try:
            program.wait(timeout=5)
        except subprocess.TimeoutExpired:
            continue
    program.wait()


KINDS = {kind.name: kind for kind in (Chromium, Firefox, WebKit)}
