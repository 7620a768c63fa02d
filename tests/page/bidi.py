# SPDX-License-Identifier: Apache-2.0
"""WebDriver BiDi: commands and their answers, and the events that came meanwhile, over one web socket."""
import asyncio
import json
import threading

import websockets


class Bidi:
    def __init__(self, address, patience_s):
        self._patience_s = patience_s
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._thread.start()
        self._socket = self._do(self._open(address))
        self._number = 0
        self._events = []

    def send(self, method, **parameters):
        """Gives the result of a command, or raises what it was refused with."""
        self._number += 1
        return self._do(self._ask(self._number, method, parameters))

    def take(self, method):
        """The events of this name since the last call."""
        self.send("session.status")
        taken = [event["params"] for event in self._events if event["method"] == method]
        self._events = [event for event in self._events if event["method"] != method]
        return taken

    def close(self):
        try:
            self._do(self._socket.close())
        finally:
            self._loop.call_soon_threadsafe(self._loop.stop)
            self._thread.join()

    @staticmethod
    async def _open(address):
        return await websockets.connect(address, max_size=None, ping_interval=None)

    async def _ask(self, number, method, parameters):
        await self._socket.send(json.dumps({"id": number, "method": method, "params": parameters}))
        while True:
            message = json.loads(await self._socket.recv())
            if message.get("type") == "event":
                self._events.append(message)
            elif message.get("id") == number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}: {message['message']}")
                return message["result"]

    def _do(self, what):
        async def in_time():
            return await asyncio.wait_for(what, 2 * self._patience_s)
        return asyncio.run_coroutine_threadsafe(in_time(), self._loop).result()
