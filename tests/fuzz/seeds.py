#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""seeds.py ROOT TARGET FOLDER: the inputs that a fuzz target begins with, from golden files and gsd/."""
import pathlib
import re
import struct
import sys

root, target, folder = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
folder.mkdir(parents=True, exist_ok=True)


def counted(octets):
    return bytes([len(octets)]) + bytes(octets)


def golden():
    """Every telegram of the wire reference."""
    text = (root / "tests/fdl/golden.hpp").read_text()
    return [bytes.fromhex(row) for row in re.findall(r'\{"\w+", "([0-9A-F ]+)"', text)]


def fdl():
    for octets in golden():
        yield bytes([4, 0, 0, 0]) + counted(octets)  # at 187.5 kbit/s, read whole
        yield bytes([6, 0, 0x30, 0]) + counted(octets) + bytes([8, 2]) + counted(octets)
    yield b"\x03\x00" + b"".join(b"\x10\x0e" + counted(octets) for octets in golden())
    for fc in (0x49, 0x6D, 0x5D, 0x7D):
        yield bytes([5, 0, 1, 0, 3, 5, 2, fc, 3, 0, 7, 0x80, 0x82, fc, 60, 62, 1, 2])


def dp():
    """A start-up of each device, then exchange, Demand Data, Sync and Freeze."""
    tags = bytes([0, 1, 0, 2]) + bytes(20)
    boards = {0: tags, 1: b"\x00\x00\x00\x00\x01\x00\x02", 2: b"\x00\x01\x00\x02"}
    for device, user in boards.items():
        start = bytes([device, 1, 0x38, 20]) + counted(user) + b"\x02" + counted(b"\x73\x50\x60") + bytes([11, 1, 1, 0, 7] + [1] * 8)
        for order in (b"\x10\x01", b"\x20\x05", b"\x30\x00", b"\x00\x00"):
            data = order + bytes([0, 3, 0, 0, 0, 7, 0x12, 0x34])
            yield start + b"\x06\x04" + counted(data) + bytes([12, 1, 0, 0, 9, 4]) + counted(data) + b"\x08\x09\x07"
        yield start + b"\x06\x04" + counted(bytes(range(10))) + bytes([5, 0x20, 1, 5, 8, 1, 5, 2, 1, 10, 200])


def ei_ascii():
    """Texts, frames, and calls: reads, writes, a refusal with its EE, a late answer."""
    for text in (b"1.5", b">1B0B", b"-32768.", b"  30.", b"65535", b".05"):
        letters = bytes(b"0123456789.->+ ABCDEFabcdefz~".index(c) for c in text)
        for kind in (0, 1, 2, 3, 0x80):
            yield bytes([0, kind] + [2] * (kind % 4 == 0) + [0x12, 0x34]) + counted(letters)
        yield bytes([1, 0, 0]) + b"aa" + text
        read = bytes([0, 1, 0, 0, 11]) + counted(letters)
        for mode in range(3):
            yield bytes([2, mode]) + read + bytes([2, 1, 0, 5, 1]) + read + bytes([2, 1, 0, 6, 2, 4, 4])
            yield bytes([2, mode, 0, 1, 0, 0, 0xBB]) + counted(letters) + read + bytes([2, 1, 0, 6, 0x51]) + read


def modbus():
    for octets in ("01 03 02 00 B7", "01 83 02", "01 06 00 07 00 05", "01 10 00 01 00 02"):
        frame = bytes.fromhex(octets)
        yield b"\x00" + bytes([10 + len(frame) % 2]) + frame
    for echo in range(3):
        calls = bytes([0, 3, 0, 0, 0, 0, 10, 0, 7, 2, 3, 0, 5, 0, 0, 10, 0x40, 3, 0, 0, 0, 0, 10]) + bytes(6)
        yield bytes([1, echo]) + calls + bytes([0x10, 0x4B, 0, 0, 0, 0, 10]) + bytes.fromhex("3F C0 00 00")
        yield bytes([1, echo]) + calls + bytes([2, 3, 0, 5, 0, 0, 1, 3]) + bytes([0, 3, 0, 0, 0, 0, 0x71, 2]) + calls
    yield bytes.fromhex("5b 88 3f 13")


def files(*patterns):
    for pattern in patterns:
        for path in sorted(root.glob(pattern)):
            yield path.read_bytes()


def gsd():
    yield from files("gsd/**/*.GSD", "gsd/**/*.gsd", "gsd/**/*.GS?", "gsd/**/*.gs?")
    yield bytes([0, 4, 1, 2, 3, 4, 4, 5, 6, 7, 8, 5, 0x33, 3, 9, 9, 9, 2, 1, 1, 0x50, 1, 2, 0x60])


def varlink():
    methods = 17
    for head in (0, 1):
        for method in range(methods):
            yield bytes([head, 3 + 4 * 2]) + b"ab" + bytes([method, 3 + 4 * 3]) + b"abc" + bytes([method])
            yield bytes([head, 2, method, 1 + 4 * 40]) + b'{"method":"org.varlink.service.GetInfo"}' + b"\0"
    yield b"\x01" + bytes([4 * 20]) + b'{"method":"org.dpsla' + b"\0" + bytes([1 + 4 * 19]) + b'ved.Control.Watch"}' + b"\0"
    yield b"\x00" + bytes([2 + 4 * 20]) + b'"station":"a","tag":' + b"\x0a" + bytes([2 + 4 * 9]) + b'"yes":nul' + b"\x0e"


def toml():
    yield b'text = "a"\ninteger = 0x10\nreal = 1.5\nboolean = true\ntexts = ["a", "b"]\nintegers = [1, 2]\n'
    yield b'choice = "b"\n[table]\ntext = "x"\n[[tables]]\nreal = 1e0\n[[tables.tables]]\ntext = """a\nb"""\n'
    # As they are without their comments, so that they are short.
    for octets in files("config/profiles/*.toml", "config/dpslaved.toml"):
        lines = [line.split(b" #")[0].rstrip() for line in octets.splitlines() if not line.startswith(b"#")]
        yield b"\n".join(line for line in lines if line) + b"\n"


def tag_table():
    yield b"tag,name,type,decimals,min,max\n7,SPEED,INT,2,-100.00,100.00\n9,MODE,ENUM,,,\n"
    for octets in files("config/tags/*.csv"):
        lines = octets.splitlines()
        for first in range(1, min(len(lines), 80), 8):
            yield b"\n".join(lines[:1] + lines[first : first + 8]) + b"\n"


def pcapng():
    """The beginnings of the captures of tests/captures, a small one in both byte orders, and packets to be written."""
    for octets in files("tests/captures/foreign/*.pcapng"):
        yield b"\x01" + octets[:1500]
    for order in "<>":
        def block(kind, body):
            return struct.pack(order + "II", kind, len(body) + 12) + body + struct.pack(order + "I", len(body) + 12)

        section = block(0x0A0D0D0A, struct.pack(order + "IHHq", 0x1A2B3C4D, 1, 0, -1))
        interface = block(1, struct.pack(order + "HHIHHB3xI", 257, 0, 0, 9, 1, 9, 0))  # times in nanoseconds
        flags, dropped = struct.pack(order + "HHI", 2, 4, 0x81000002), struct.pack(order + "HHQ", 4, 8, 7)
        packet = block(6, struct.pack(order + "IIIII", 0, 1, 2, 1, 1) + b"\xE5\0\0\0" + flags + dropped)
        statistics = block(5, struct.pack(order + "IIIHHQ", 0, 1, 2, 4, 8, 3))
        simple_packet = block(3, struct.pack(order + "I", 1) + b"\x10\0\0\0")
        yield b"\x01" + section + interface + packet + statistics + simple_packet
        for magic in 0xA1B2C3D4, 0xA1B23C4D:
            head = struct.pack(order + "IHHiIII", magic, 2, 4, 0, 0, 65535, 257)
            telegram = b"\x10\x05\x02\x49\x50\x16"
            yield b"\x01" + head + struct.pack(order + "IIII", 1, 2, 1, 1) + b"\xE5" + struct.pack(order + "IIII", 2, 3, 6, 6) + telegram
    for form in range(4):
        yield b"\x02" + bytes([form]) + bytes(6) + b"\x1F\x00" + b"\x01\x00\x02\x00\x03\xE5\x10\x02\x05\x00" * 4
    yield bytes([0, 3, 5]) + b"bus" + bytes([6, 0x10, 5, 2, 0x49, 0x50, 0x16, 3, 2, 0x41, 0x42]) + bytes(range(40))


def trace():
    """An incident with its head; a start-up and exchange of two devices, with replies; drive frames; noise."""
    station = '"stations":[{"name":"a","address":5,"profile":"box","state":"Data_Exch","master":2,"set_prm":"B8 01 01 0B 16 49 00 00 00 00 07","chk_cfg":"50"}]'
    head = ('{"number":7,"what":{"kind":"left","text":"a: left"},"at_ns":1,"unix_ns":2,' + station + "}\n").encode()

    def record(kind, octets, detail=0, rate=4, address=5, pause=500):
        return bytes([kind, detail, rate, address]) + pause.to_bytes(2, "big") + counted(octets)

    for slave in (5, 6):
        to, back = bytes([slave | 0x80, 0x82, 0x5D]), bytes([0x82, slave | 0x80, 0x08])
        prm = record(0x20, to + b"\x3D\x3E\xB8\x01\x01\x0B\x16\x49\x00\x00\x00\x00\x07") + record(2, b"\xE5")
        cfg = record(0x20, to + b"\x3E\x3E\x73\x50") + record(2, b"\xE5")
        diag = record(0x20, to + b"\x3C\x3E") + record(0x22, back + b"\x3E\x3C\x00\x0C\x00\x02\x16\x49\x04\x00\x12\x00")
        data = record(0x20, bytes([slave, 2, 0x7D]) + bytes([0x10, 1] + [0] * 6))
        reply = record(0x22, bytes([2, slave, 8]) + bytes([0x10, 1, 0, 0, 0, 0, 4, 0x4C, 0x13, 0xBA]))
        yield head + b"\x00\x40" + prm + cfg + diag + data + reply + record(0x20, bytes([0x7F | 0x80, 0x82, 0x46]) + b"\x3A\x3E\x20\x01")
    drive = record(5, b"\x0400 11PV\x05", rate=0) + record(6, b"\x02PV1.5\x03\x21", rate=0) + record(7, b"", rate=1)
    yield b"{}\n\x00\x09" + record(8, b"p3") + drive + record(5, bytes.fromhex("01 03 00 01 00 01 D5 CA"), rate=1)
    yield b"\n\x00\x00" + b"".join(record(0, octets) for octets in golden())
    yield b"\n\x00\x01" + record(0x10, b"\x10\x05") + record(1, b"") + record(4, b"", rate=6) + record(3, b"", detail=2) + record(0, b"\x02\x49\x50\x16")


for number, octets in enumerate(globals()[target]()):
    (folder / f"seed-{number:03}").write_bytes(octets)
