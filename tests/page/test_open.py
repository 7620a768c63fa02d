# SPDX-License-Identifier: Apache-2.0
"""The page in a browser: quiet, alone, and with the answers of dpctl."""
import socketserver
import threading
import unittest

import setting


class Opened(unittest.TestCase):
    def setUp(self):
        self.browser = setting.browser
        self.browser.open("about:blank")

    def test_writes_nothing_to_the_console(self):
        self.browser.messages()
        self.browser.open_page(setting.page)
        self.assertEqual(self.browser.messages(), [])

    def test_that_writes_to_the_console_would_be_noticed(self):
        self.browser.messages()
        self.browser.run("console.warn('a sample'); return 1")
        self.assertIn("a sample", "".join(self.browser.messages()))

    def test_asks_for_nothing(self):
        self.browser.requests()
        self.browser.open_page(setting.page)
        asked = [one for one in self.browser.requests() if not one.startswith(("data:", "blob:"))]
        self.assertIn(asked, [[], [setting.page.as_uri()]])

    def test_cannot_reach_a_server(self):
        ways = """
            const at = words[0];
            await fetch(at + 'fetch', { mode: 'no-cors' }).catch(() => 0);
            const element = (name, values) => new Promise((done) => {
                const made = Object.assign(document.createElement(name), values, { onload: done, onerror: done });
                document.head.append(made);
                setTimeout(done, 500);
            });
            await element('img', { src: at + 'img' });
            await element('script', { src: at + 'script' });
            await element('link', { rel: 'stylesheet', href: at + 'link' });
            await element('iframe', { src: at + 'iframe' });
            navigator.sendBeacon(at + 'beacon', 'x');
            try { new WebSocket(at.replace('http', 'ws') + 'socket'); } catch { /* refused */ }
            try { new EventSource(at + 'events'); } catch { /* refused */ }
            await new Promise((done) => setTimeout(done, 300));
            return 1"""
        with Server() as server:
            self.browser.open_page(setting.page)
            self.browser.run(ways, server.address)
            self.assertEqual(server.asked, [])
            self.browser.open(server.address)  # a page without a policy
            self.browser.run(ways, server.address)
            self.assertIn("/fetch", server.asked)
            self.assertIn("/img", server.asked)
        self.browser.open("about:blank")
        if self.browser.name != "webkit":
            self.browser.messages()


class Server(socketserver.ThreadingTCPServer):
    """Notes what it is asked for."""

    allow_reuse_address = True
    daemon_threads = True

    def __init__(self):
        server = self
        self.asked = []

        class Handler(socketserver.StreamRequestHandler):
            timeout = 5

            def handle(self):
                try:
                    words = self.rfile.readline().decode("latin-1").split()
                except OSError:
                    return  # a connection that was opened for later
                if len(words) < 2:
                    return
                server.asked.append(words[1])
                while self.rfile.readline().strip():
                    pass
                self.wfile.write(b"HTTP/1.1 200 OK\r\nContent-Type: text/html\r\nContent-Length: 0\r\nConnection: close\r\n\r\n")

        super().__init__(("127.0.0.1", 0), Handler)
        self.address = f"http://127.0.0.1:{self.server_address[1]}/"
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def __exit__(self, *_):
        self.shutdown()
        self.server_close()
