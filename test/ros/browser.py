"""A real browser without a window for tests: Chromium, told what to do over its DevTools protocol,
by tornado's web socket."""

import asyncio
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

import tornado.websocket

PROGRAMS = ("chromium-headless-shell", "chromium", "google-chrome", "chromium-browser")
TIMEOUT = 120.0  # for what is certain to come, on a busy machine, too [s]


def program():
    """The first of PROGRAMS that is installed, or None."""
    return next((found for found in map(shutil.which, PROGRAMS) if found), None)


class Browser:
    """One page. What it logs as an error, and what it asks other machines for, is kept in `errors`
    and `requests`."""

    def __init__(self, width=1280, height=800):
        self.errors, self.requests = [], []
        self._number = 0
        self._loop = asyncio.new_event_loop()
        self._profile = tempfile.mkdtemp(prefix="browser_")
        self._process = subprocess.Popen(
            [
                program(),
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-dev-shm-usage",
                "--hide-scrollbars",
                "--remote-debugging-port=0",
                "--remote-allow-origins=*",
                "--user-data-dir=" + self._profile,
                "--no-first-run",
                "--disable-background-networking",
                "--window-size=%d,%d" % (width, height),
                "about:blank",
            ],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        self._socket = self._loop.run_until_complete(self._connect())
        for domain in ("Page", "Runtime", "Network", "Log"):
            self._call(domain + ".enable")
        self.resize(width, height)

    async def _connect(self):
        from tornado.httpclient import AsyncHTTPClient

        told = pathlib.Path(self._profile) / "DevToolsActivePort"
        end = time.monotonic() + TIMEOUT
        while not told.exists() or not told.read_text().strip():
            if self._process.poll() is not None or time.monotonic() > end:
                raise AssertionError("the browser %s did not start" % program())
            await asyncio.sleep(0.05)
        port = int(told.read_text().split()[0])
        while True:
            answer = await AsyncHTTPClient().fetch(
                "http://127.0.0.1:%d/json" % port, connect_timeout=TIMEOUT, request_timeout=TIMEOUT
            )
            pages = [target for target in json.loads(answer.body) if target["type"] == "page"]
            if pages:
                return await tornado.websocket.websocket_connect(
                    pages[0]["webSocketDebuggerUrl"], max_message_size=2**28
                )
            if time.monotonic() > end:
                raise AssertionError("the browser %s has no page" % program())
            await asyncio.sleep(0.05)

    def _call(self, method, **parameters):
        self._number += 1
        return self._loop.run_until_complete(
            asyncio.wait_for(self._ask(self._number, method, parameters), TIMEOUT)
        )

    async def _ask(self, number, method, parameters):
        await self._socket.write_message(
            json.dumps({"id": number, "method": method, "params": parameters})
        )
        while True:
            text = await self._socket.read_message()
            if text is None:
                raise AssertionError("the browser has ended")
            message = json.loads(text)
            if message.get("id") == number:
                if "error" in message:
                    raise AssertionError("%s: %s" % (method, message["error"]["message"]))
                return message["result"]
            self._note(message)

    def _note(self, message):
        name, parameters = message.get("method"), message.get("params", {})
        if name == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif name == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.errors.append(
                "%s %s" % (parameters["entry"]["text"], parameters["entry"].get("url", ""))
            )
        elif name == "Network.requestWillBeSent":
            self.requests.append(parameters["request"]["url"])

    def resize(self, width, height):
        self._call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )

    def theme(self, name):
        """ "light" or "dark", as the system wishes."""
        self._call(
            "Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": name}]
        )

    def press(self, key):
        """A key, where the focus is."""
        code = {"Enter": 13, " ": 32}.get(key, 0)
        text = {"Enter": "\r", " ": " "}.get(key, "")
        kind = "keyDown" if text else "rawKeyDown"
        self._call(
            "Input.dispatchKeyEvent", type=kind, key=key, text=text, windowsVirtualKeyCode=code
        )
        self._call("Input.dispatchKeyEvent", type="keyUp", key=key, windowsVirtualKeyCode=code)

    def open(self, address):
        self._call("Page.navigate", url=address)
        self.wait("document.readyState === 'complete'")

    def value(self, expression):
        """Of JavaScript in the page, as JSON has it."""
        result = self._call(
            "Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True
        )
        if "exceptionDetails" in result:
            raise AssertionError(
                "%s: %s" % (expression, result["exceptionDetails"]["exception"]["description"])
            )
        return result["result"].get("value")

    def wait(self, expression, timeout=TIMEOUT):
        """Until the expression is true in the page."""
        end = time.monotonic() + timeout
        while not self.value(expression):
            if time.monotonic() > end:
                raise AssertionError(
                    "waited %g s in vain for %s; the page says: %s"
                    % (timeout, expression, self.value("document.body.innerText"))
                )
            time.sleep(0.05)

    def text(self, selector):
        """What stands in the element, as it is seen."""
        return self.value("document.querySelector(%s).innerText" % json.dumps(selector))

    def place(self, selector, across=0.5, down=0.5):
        """Of a point of the element, which is scrolled to as a person would, once it stands still;
        shares of its width and height."""
        return self.value(
            """(async () => {
          const found = document.querySelector(%s);
          found.scrollIntoView({block: 'nearest'});
          for (let before = null;;) {
            const box = found.getBoundingClientRect();
            if (before && ['x', 'y', 'width', 'height'].every((side) => before[side] === box[side]))
              return [box.x + %r * box.width, box.y + %r * box.height];
            before = box;
            await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
          }
        })()"""
            % (json.dumps(selector), across, down)
        )

    def mouse(self, kind, place, **more):
        self._call("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], **more)

    def click(self, selector, across=0.5, down=0.5, count=1):
        """With the mouse, in the middle of the element or elsewhere on it; count: 2 for a double
        click. Once more where the page moved meanwhile."""
        end = time.monotonic() + TIMEOUT
        while True:
            self.value(
                """(() => {
              window.clicked = [];
              window.wanted = %s;
              window.noteClick ||= (event) => clicked.push({hit: event.target.closest(wanted) !== null, on: event.target.outerHTML.slice(0, 200)});
              window.addEventListener('click', noteClick, {capture: true});
            })()"""  # noqa: E501
                % json.dumps(selector)
            )
            place = self.place(selector, across, down)
            for number in range(1, count + 1):
                for kind in ("mousePressed", "mouseReleased"):
                    self.mouse(kind, place, button="left", clickCount=number)
            clicked = self.value("clicked")
            if sum(click["hit"] for click in clicked) == count:
                return
            if time.monotonic() > end:
                raise AssertionError(
                    "clicks on %s at %s do not reach it, but %s"
                    % (selector, place, [click["on"] for click in clicked])
                )

    def drag(self, selector, start, end):
        """With the mouse, from one point of the element to another."""
        self.mouse("mousePressed", self.place(selector, *start), button="left", clickCount=1)
        self.mouse("mouseMoved", self.place(selector, *end), button="left", buttons=1)
        self.mouse("mouseReleased", self.place(selector, *end), button="left", clickCount=1)

    def download_to(self, folder):
        """What the page saves goes there."""
        self._call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(folder))

    def close(self):
        """Ends the browser with all its processes: the program may be a script that starts it."""
        self._socket.close()
        self._loop.run_until_complete(asyncio.sleep(0.1))  # for the goodbye to be heard
        os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait(timeout=TIMEOUT)
        self._loop.close()
        shutil.rmtree(self._profile, ignore_errors=True)
