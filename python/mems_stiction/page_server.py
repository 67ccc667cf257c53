"""The web server of the station's page, by tornado: files of the folder page, maps as PNG, the
state over a web socket.

A browser says that it is ready and gets the state once that has changed: a slow one gets fewer, and
no other one waits for it. A connection that is silent, or takes nothing, ends. The page reads only;
nothing of it comes from elsewhere.
"""

import asyncio
import errno
import io
import ipaddress
import json
import logging
import pathlib

import tornado.httpserver
import tornado.httputil
import tornado.ioloop
import tornado.netutil
import tornado.web
import tornado.websocket

from mems_stiction.page_maps import (
    LONGEST,
    LONGEST_ZOOMED,
    contact_png,
    height_png,
    height_range,
    measured_at,
    rings,
)
from mems_stiction.page_words import all_finite
from mems_stiction.row_table import write_csv

FOLDER = pathlib.Path(__file__).resolve().parent / "page"
SHORTEST_PERIOD = 0.2  # between two states for one browser [s], however fast scans come
LONGEST_PERIOD = 2.0  # ages are told again [s]
PATIENCE = 60.0  # with a connection that asks for nothing, or does not take what it asked for [s]
LONGEST_REQUEST = 65536  # bytes; browsers send some hundred
PICTURES = {"height": height_png, "contacts": contact_png}
POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; "
    "connect-src 'self'"
)
LOCAL_NAMES = ("localhost", "127.0.0.1", "[::1]")


class CannotServe(Exception):
    """Why there is no server, in one sentence."""


class _Guarded:
    """For every handler: a site elsewhere cannot read a page on loopback under a name of its own
    (DNS rebinding)."""

    def prepare(self):
        host = (
            self.request.host.rsplit(":", 1)[0]
            if not self.request.host.endswith("]")
            else self.request.host
        )
        if self.application.settings["is_local"] and host not in LOCAL_NAMES:
            self.set_status(403)
            self.finish("This page is for this machine alone.\n")

    def set_default_headers(self):
        self.set_header("Content-Security-Policy", POLICY)
        self.set_header("X-Content-Type-Options", "nosniff")
        self.set_header("Cache-Control", "no-store")


class _InTime(_Guarded):
    """The connection ends if the answer has not been taken in time."""

    def prepare(self):
        stream = self.request.connection.stream
        self._end = tornado.ioloop.IOLoop.current().call_later(
            self.application.settings["patience"], stream.close
        )
        super().prepare()

    def finish(self, chunk=None):
        taken = super().finish(chunk)
        taken.add_done_callback(lambda _: tornado.ioloop.IOLoop.current().remove_timeout(self._end))
        return taken


class _PageFile(_InTime, tornado.web.StaticFileHandler):
    pass


class _Picture(_InTime, tornado.web.RequestHandler):
    """/map/height.png, /map/contacts.png: of the newest scan, with ?zoomed in all its pixels, with
    ?turned clockwise. Drawn once for all browsers."""

    def get(self, name):
        found = self.application.settings["state"].map_of(name)
        if found is None:
            raise tornado.web.HTTPError(404)
        longest = LONGEST_ZOOMED if "zoomed" in self.request.arguments else LONGEST
        quarters = 1 if "turned" in self.request.arguments else 0
        picture = self.application.settings["drawn"].get(
            "%s %d %d" % (name, longest, quarters),
            *found,
            lambda image: PICTURES[name](image, longest, quarters),
        )
        if picture is None:
            raise tornado.web.HTTPError(404)
        self.set_header("Content-Type", "image/png")
        self.write(picture)


class _Measured(_InTime, tornado.web.RequestHandler):
    """/measure?id=STAMP&x=0.1&y=0.2[&x=0.3&y=0.4]: the heights at places of the newest scan, and
    what is between two of them."""

    def get(self):
        state = self.application.settings["state"]
        try:
            places = [
                (float(x), float(y))
                for x, y in zip(self.get_arguments("x"), self.get_arguments("y"))
            ]
        except ValueError:
            places = []
        if not 1 <= len(places) <= 2 or not all(
            0 <= share <= 1 for place in places for share in place
        ):
            raise tornado.web.HTTPError(400)
        found = state.map_of("height")
        if found is None or str(found[0]) != self.get_argument("id", ""):  # a newer scan has come
            raise tornado.web.HTTPError(404)
        self.write(all_finite(measured_at(found[1], state.size_of("height"), places)))


class _Wafers(_InTime, tornado.web.RequestHandler):
    """/wafers: maps of the wafers, and their parts. The state says by a number whether they have
    changed; most browsers do not look at them."""

    async def get(self):
        try:
            from mems_stiction.page_wafers import (
                told,
            )  # loads the core, which nothing else of the page needs
        except ImportError:
            raise tornado.web.HTTPError(501)
        settings = self.application.settings
        answer = await asyncio.get_running_loop().run_in_executor(
            None, settings["drawn"].get, "wafers", None, settings["state"].wafers(), told
        )
        if answer is None:
            raise tornado.web.HTTPError(500)
        self.write(answer)


class _Rows(_InTime, tornado.web.RequestHandler):
    """/scan.csv, /parts.csv: the newest prediction, and the newest verdict on each part."""

    def get(self, name):
        state = self.application.settings["state"]
        row = state.scan_row()
        rows = state.part_rows() if name == "parts" else [row] if row else []
        if not rows:
            raise tornado.web.HTTPError(404)
        file = "parts" if name == "parts" else "scan_%d" % row["number"]
        self.set_header("Content-Type", "text/csv; charset=utf-8")
        self.set_header("Content-Disposition", 'attachment; filename="%s.csv"' % file)
        text = io.StringIO()
        write_csv(text, list(dict.fromkeys(name for row in rows for name in row)), rows)
        self.write(text.getvalue())


class _Drawn:
    """The last thing that was made of each image, and of the wafers."""

    def __init__(self):
        self._cached = {}

    def get(self, name, stamp, image, make):
        """None where it cannot be made, which is said once."""
        if self._cached.get(name, (None,))[0] is not image:
            try:
                made = make(image)
            except Exception:
                logging.getLogger("tornado.application").exception("%s cannot be drawn", name)
                made = None
            self._cached[name] = (image, made)
        return self._cached[name][1]


class _StateSocket(_Guarded, tornado.websocket.WebSocketHandler):
    """Each message of the browser asks for the next state."""

    def open(self):
        self._seen = None

    async def on_message(self, _):
        state = self.application.settings["state"]
        waited = 0.0
        while state.version == self._seen and waited < LONGEST_PERIOD or not waited:
            await asyncio.sleep(SHORTEST_PERIOD)
            waited += SHORTEST_PERIOD
        snapshot = state.snapshot()
        self._seen = snapshot["version"]
        found = state.map_of("contacts")
        snapshot["stale_after"] = (
            self.application.settings["stale_after"] or snapshot["stale_after"]
        )
        snapshot["rings"] = (
            found and self.application.settings["drawn"].get("rings", *found, rings) or []
        )
        found = state.map_of("height")
        snapshot["height_range"] = (
            self.application.settings["drawn"].get("range", *found, height_range) if found else None
        )
        try:
            await self.write_message(json.dumps(all_finite(snapshot), allow_nan=False))
        except (tornado.websocket.WebSocketClosedError, tornado.iostream.StreamClosedError):
            pass


class _Application(tornado.web.Application):
    """Refuses bodies in pieces before they are read: nothing here takes a body, and tornado 6.2
    reads for ever behind a piece of negative length."""

    def find_handler(self, request, **kwargs):
        if "Transfer-Encoding" not in request.headers:
            return super().find_handler(request, **kwargs)
        stream = request.connection.detach()
        stream.write(b"HTTP/1.1 400 Bad Request\r\nConnection: close\r\n\r\n")
        stream.close()
        return tornado.httputil.HTTPMessageDelegate()


def application(state, is_local, stale_after, patience=PATIENCE):
    """state: a PageState. stale_after [s]: without a scan for so long, the page marks what it shows
    as old; None: by the rate of the scans."""
    return _Application(
        [
            (r"/state", _StateSocket),
            (r"/map/(height|contacts)\.png", _Picture),
            (r"/()", _PageFile, {"path": str(FOLDER), "default_filename": "index.html"}),
            (r"/measure", _Measured),
            (r"/wafers", _Wafers),
            (r"/(scan|parts)\.csv", _Rows),
            (r"/([a-z]+\.(?:html|css|js))", _PageFile, {"path": str(FOLDER)}),
        ],
        state=state,
        is_local=is_local,
        stale_after=stale_after,
        patience=patience,
        drawn=_Drawn(),
        websocket_ping_interval=10.0,
        websocket_max_message_size=LONGEST_REQUEST,
    )


def bound_sockets(address, port):
    """The sockets of the page. Raises CannotServe with what to do."""
    try:
        return tornado.netutil.bind_sockets(port, address)
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            raise CannotServe(
                "port %d of %s is taken, perhaps by another station_page: end that, or choose "
                "another with --port" % (port, address)
            )
        if error.errno == errno.EACCES:
            raise CannotServe(
                "port %d may not be opened by this user: choose one from 1024 on with --port" % port
            )
        raise CannotServe("%s cannot be listened on: %s" % (address, error.strerror or error))


def is_loopback(address):
    """Whether nobody but this machine can look."""
    try:
        return ipaddress.ip_address(address).is_loopback
    except ValueError:
        return address == "localhost"


class PageServer:
    """Serves until stop(). Made and run in one thread; stop() may be called from any, and by a
    signal's handler."""

    def __init__(self, state, address, port, stale_after, patience=PATIENCE):
        asyncio.set_event_loop(asyncio.new_event_loop())
        self._sockets = bound_sockets(address, port)
        self.port = self._sockets[0].getsockname()[1]
        self._loop = tornado.ioloop.IOLoop.current()
        self._server = tornado.httpserver.HTTPServer(
            application(state, is_loopback(address), stale_after, patience),
            idle_connection_timeout=patience,
            body_timeout=patience,
            max_header_size=LONGEST_REQUEST,
            max_body_size=LONGEST_REQUEST,
        )
        self._server.add_sockets(self._sockets)

    def run(self):
        self._loop.start()
        self._server.stop()

    def stop(self):
        self._loop.asyncio_loop.call_soon_threadsafe(self._loop.stop)
