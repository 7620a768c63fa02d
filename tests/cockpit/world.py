# SPDX-License-Identifier: Apache-2.0
"""The real dpslaved with a simulated bus, drive and master, and Cockpit's local session of one user."""
import contextlib
import json
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time

PATIENCE_S = 30
USER = "nobody"
OPERATORS = "users"  # a group that every Debian has


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_for(question, what):
    end = time.monotonic() + PATIENCE_S
    while not (answer := question()):
        if time.monotonic() > end:
            raise AssertionError(f"it never came: {what}")
        time.sleep(0.1)
    return answer


class World:
    def __init__(self, root, programs):
        self.root = root
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="dpslaved-cockpit."))
        self.folder.chmod(0o755)
        self.running = []
        self.programs = self.folder / "bin"
        self.programs.mkdir()
        for name in ("dpslaved", "dpctl", "dpsim"):
            shutil.copy2(programs / name, self.programs / f"real-{name}")
        self.dpctl_command()

    def command(self, name, line):
        path = self.programs / name
        path.write_text(f"#!/bin/sh\n{line}\n")
        path.chmod(0o755)

    def dpctl_command(self, before=":"):
        """The dpctl that Cockpit finds; `before`: a line of shell that it does first."""
        self.command("dpctl", f'{before}\nexec {self.programs}/real-dpctl --socket {self.folder}/control.sock "$@"')

    def start(self, name, *words, environment=None):
        log = open(self.folder / f"{name}.log", "w", encoding="utf-8")
        # A pipe that stays open: dpsim ends at the end of its input.
        process = subprocess.Popen([str(word) for word in words], stdin=subprocess.PIPE, stdout=log,
                                   stderr=subprocess.STDOUT, env=environment, cwd=self.folder, start_new_session=True)
        log.close()
        self.running.append((name, process))
        return process

    def said(self, name):
        return (self.folder / f"{name}.log").read_text(encoding="utf-8", errors="replace")

    def dpsim(self, name, *words):
        return self.start(name, self.programs / "real-dpsim", *words)

    def bring_up(self):
        """Station "unwinder" in data exchange; the drive has 12.5 in tag 55. Station "winder" is a technology box that no master
        and no drive knows."""
        self.dpsim("bus", "line", "--baud", 19200, "--a", "bus-plc", "--b", "bus-gateway")
        self.dpsim("cable", "line", "--baud", 9600, "--bits", 10, "--a", "drive-end", "--b", "drive-gateway")
        for name in ("bus", "cable"):
            wait_for(lambda name=name: "ready" in self.said(name), f"{name} ready")
        for table in ("example.csv", "empty.csv"):
            shutil.copy(self.root / "config/tags" / table, self.folder)
        self.drive = self.dpsim("drive", "drive", "--profile", "590", "--port", "drive-end", "--baud", 9600,
                                "--table", "example.csv", "--log")
        wait_for(lambda: "ready" in self.said("drive"), "the drive")
        self.drive.stdin.write(b"set 55 12.50\n")
        self.drive.stdin.flush()
        for lamp in ("red", "green"):
            led = self.folder / "sys/class/leds" / lamp
            led.mkdir(parents=True)
            for name, text in (("brightness", "0"), ("max_brightness", "1"), ("trigger", "none")):
                (led / name).write_text(text + "\n")
        (self.folder / "test.toml").write_text(f"""
[bus]
port = "bus-gateway"
baud = 19200
direction = "none"
[leds]
sysfs = "{self.folder}/sys"
[control]
socket = "{self.folder}/control.sock"
operator_group = "{OPERATORS}"
[[line]]
name = "p3"
port = "drive-gateway"
protocol = "ei-ascii"
baud = 9600
wire_time = "yes"
[[station]]
name = "unwinder"
address = 5
profile = "590"
line = "p3"
unit = "00"
tags = "example.csv"
[station.leds]
red = "led:red"
green = "led:green"
[[station]]
name = "winder"
address = 6
profile = "605"
line = "p3"
unit = "01"
tags = "empty.csv"
""")
        self.start_daemon()
        (self.folder / "script").write_text("start 30s\nout 1 = 500\nrun 600s\n")
        self.master = self.dpsim("master", "master", "--port", "bus-plc", "--baud", 19200, "--slave", 5, "--tags",
                                 "55,56w,288", "--watchdog", "20s", "--script", "script")
        self.exchanges()

    def start_daemon(self):
        self.daemon = self.start("daemon", self.programs / "real-dpslaved", "--config", "test.toml", "--profiles",
                                 self.root / "config/profiles")
        wait_for((self.folder / "control.sock").exists, "the daemon")

    def exchanges(self):
        wait_for(lambda: subprocess.run([self.programs / "dpctl", "status", "unwinder", "--wait", "0", "--quiet", "--with-drive"],
                                        check=False).returncode == 0, "data exchange")

    def causes(self):
        """Those that the doctor names now."""
        said = subprocess.run([self.programs / "dpctl", "--json", "doctor"], check=False, stdout=subprocess.PIPE).stdout
        return [finding["cause"] for finding in json.loads(said)["findings"]]

    def tec(self, station, name):
        """The value of a row of the TEC OPTION, as dpctl shows it."""
        said = subprocess.run([self.programs / "dpctl", "--json", "show", station], check=True, stdout=subprocess.PIPE).stdout
        return next(row["value"] for row in json.loads(said)["stations"][0]["tec"]["rows"] if row["name"] == name)

    def packages(self, page):
        """Those of Cockpit, as the Debian packages have them; `page`: the configurator and its manifest, or None."""
        folder = self.folder / "share/cockpit"
        shutil.copytree(self.root / "src/cockpit", folder / "dpslaved")
        if page is not None:
            own = folder / "dpslaved-configurator"
            own.mkdir()
            shutil.copy(page / "manifest.json", own)
            (self.folder / "share/dpslaved").mkdir()
            shutil.copy(page / "configurator.html", self.folder / "share/dpslaved")
            (own / "configurator.html").symlink_to("../../dpslaved/configurator.html")
        subprocess.run(["chmod", "-R", "a+rX", self.folder / "share"], check=True)

    @contextlib.contextmanager
    def session(self, groups):
        """The address of a Cockpit in which USER is logged in, with these groups beside his own."""
        port = free_port()
        home = self.folder / f"home-{port}"
        home.mkdir()
        shutil.chown(home, USER)
        environment = {
            "PATH": f"{self.programs}:/usr/bin:/bin", "HOME": str(home), "LANG": "C.UTF-8", "USER": USER,
            "XDG_DATA_HOME": str(self.folder / "share"), "XDG_CONFIG_DIRS": str(home), "XDG_RUNTIME_DIR": str(home),
        }
        rights = ["setpriv", f"--reuid={USER}", "--regid=nogroup"]
        rights += [f"--groups={','.join(groups)}"] if groups else ["--clear-groups"]
        name = f"cockpit-{port}"
        server = self.start(name, *rights, "/usr/lib/cockpit/cockpit-ws", "--no-tls", "--address=127.0.0.1",
                            f"--port={port}", "--local-session=cockpit-bridge", environment=environment)
        try:
            wait_for(lambda: answers(port), "Cockpit")
            yield f"http://127.0.0.1:{port}/cockpit/@localhost/"
        finally:
            self.stop(server)

    def stop(self, process):
        process.terminate()
        process.stdin.close()
        try:
            process.wait(5)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        self.running = [one for one in self.running if one[1] is not process]

    def close(self):
        for _, process in reversed(list(self.running)):
            self.stop(process)
        shutil.rmtree(self.folder, ignore_errors=True)


def answers(port):
    with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), 1):
        return True
    return False
