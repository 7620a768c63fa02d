#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a user without any right may do to the control socket, until it is ended.

usage: attacker.py SOCKET UID [ATTACK]    with UID other than its own it becomes that user first (as root)

ATTACK is "all" (all habits at once, 200 connections), or one of
  pipeline   7 connections, each sends calls without end and takes the replies
  connects   1000 connections that say nothing
  slow       7 connections, each sends calls without end and takes no reply
  garbage    7 connections, each sends octets that are no call; ends after 64 MiB
  bad-json   7 connections, each sends messages that are no JSON, or no call
A connection that the daemon has ended is made again.
"""
import itertools
import os
import socket
import sys


def call(method, parameters="{}", more=""):
    return ('{"method":"%s","parameters":%s%s}\0' % (method, parameters, more)).encode()


OWN = "org.dpslaved.Control."
MANY = 200
# What a connection sends, again and again or once, and whether it takes what is answered.
SILENT = (b"", "once", False)
GARBAGE = (b"x" * 65536, "again", False)
NO_JSON = (b'{"method":}\0[]\0null\0{"method":7}\0\xff\xfe\0{"method":"org.dpslaved.Control.GetStatus","parameters":"x"}\0',
           "again", True)
HABITS = [
    (call(OWN + "GetStatus") * MANY, "again", True),
    (call(OWN + "GetCounters") * MANY, "again", False),
    (call("org.varlink.service.GetInterfaceDescription", '{"interface":"org.dpslaved.Control"}') * MANY, "again", True),
    (call(OWN + "ReadTag", '{"tag":62}') * MANY, "again", True),
    (call(OWN + "WriteTag", '{"tag":62,"value":"1"}') * MANY, "again", True),
    (call(OWN + "Watch", more=',"more":true'), "once", False),
    (b'{"method":"org.dpslaved.', "once", False),
    GARBAGE,
    (b"{" * 1000 + b"\0", "again", True),
]
# Which habits, and how many connections.
ATTACKS = {
    "all": (HABITS, 200),
    "pipeline": (HABITS[0:1] + HABITS[2:5], 7),
    "connects": ([SILENT], 1000),
    "slow": (HABITS[1:2], 7),
    "garbage": ([GARBAGE], 7),
    "bad-json": ([NO_JSON], 7),
}
MOST_GARBAGE = 64 << 20


class Caller:
    def __init__(self, path, habit):
        self.path, (self.octets, self.how_often, self.reads) = path, habit
        self.socket = None
        self.sent = 0

    def act(self):
        try:
            if self.socket is None:
                self.socket = socket.socket(socket.AF_UNIX)
                self.socket.setblocking(False)
                self.socket.connect(self.path)
                if self.how_often == "once":
                    self.socket.send(self.octets)
            while self.how_often == "again":
                self.sent += self.socket.send(self.octets)
            self.listen()
        except BlockingIOError:
            self.listen()
        except OSError:
            self.close()

    def listen(self):
        """Takes what there is, if that is its habit; finds out whether the daemon has ended the connection."""
        try:
            flags = 0 if self.reads else socket.MSG_PEEK
            while self.socket is not None:
                if not self.socket.recv(1 << 20, flags):
                    self.close()
                elif not self.reads:
                    return
        except BlockingIOError:
            pass
        except OSError:
            self.close()

    def close(self):
        self.socket.close()
        self.socket = None


def main():
    path, uid, attack = sys.argv[1], int(sys.argv[2]), (sys.argv + ["all"])[3]
    if uid != os.geteuid():
        os.setgroups([])
        os.setgid(uid)
        os.setuid(uid)
    habits, count = ATTACKS[attack]
    callers = [Caller(path, habit) for habit, _ in zip(itertools.cycle(habits), range(count))]
    for turn in itertools.count():
        for one in callers:
            one.act()
        if turn == 3:
            print("attacking", flush=True)
        if attack == "garbage" and sum(one.sent for one in callers) >= MOST_GARBAGE:
            print("sent", sum(one.sent for one in callers), flush=True)
            return


main()
