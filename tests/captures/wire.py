# SPDX-License-Identifier: Apache-2.0
"""Telegrams, frames of a drive line and pcapng, written by a hand of their own: no program that is judged made a capture.

Sources: wire reference 2 and 4 for telegrams, H026 and M590 for EI-ASCII and Modbus RTU, draft-ietf-opsawg-pcapng.
"""
import struct

DIAG, PRM, CFG, GET_CFG, CONTROL, RD_OUTP, RD_INP = 60, 61, 62, 59, 58, 57, 56
SC = "E5"
ACK, EOT = "06", "04"
STEP = 2_000_000  # ns between two packets
BEGIN = 1_767_225_600 * 1_000_000_000  # 2026-01-01 UTC


def octets(text):
    return bytes.fromhex(text)


def sd(da, sa, fc, unit=b"", sap=None):
    """A telegram: SD1 without data unit, else SD2. `sap`: (DSAP, SSAP)."""
    if sap is not None:
        da, sa, unit = da | 0x80, sa | 0x80, bytes(sap) + unit
    body = bytes([da, sa, fc]) + unit
    head = bytes([0x68, len(body), len(body), 0x68]) if unit else b"\x10"
    return head + body + bytes([sum(body) & 0xFF, 0x16])


def ei_read(mnemonic, unit="01"):
    return b"\x04" + bytes(c for digit in unit for c in (ord(digit), ord(digit))) + mnemonic.encode() + b"\x05"


def ei_text(mnemonic, text):
    """STX, what is said, ETX and BCC: the exclusive or of all behind STX."""
    said, check = mnemonic.encode() + text.encode() + b"\x03", 0
    for octet in said:
        check ^= octet
    return b"\x02" + said + bytes([check])


def ei_write(mnemonic, text, unit="01"):
    return ei_read("", unit)[:-1] + ei_text(mnemonic, text)


def rtu(*said):
    """A Modbus frame: what is said, and its CRC, low octet first."""
    crc = 0xFFFF
    for octet in said:
        crc ^= octet
        for _ in range(8):
            crc = crc >> 1 ^ (0xA001 if crc & 1 else 0)
    return bytes(said) + struct.pack("<H", crc)


def words(*values):
    return struct.pack(f">{len(values)}H", *values)


class Capture:
    """One file. `station` begins its name; `modbus` says what its drive line is."""

    def __init__(self, station, name, shows, source):
        self.name, self.shows, self.source = f"{station}-{name}", shows, source
        self.modbus = station == "2400f"
        self.packets = []  # interface, time, octets, was sent by the gateway
        self.now = 0

    def _packet(self, interface, data, sent):
        self.now += STEP
        self.packets.append((interface, self.now, data, sent))

    def pause(self, milliseconds):
        self.now += milliseconds * 1_000_000

    def hears(self, telegram, answer=None):
        """A telegram that the gateway hears, and its answer. Texts are octets as they are printed."""
        for data, sent in ((telegram, False), (answer, True)):
            if data is not None:
                self._packet(0, octets(data) if isinstance(data, str) else data, sent)

    def drive(self, question, answer):
        self._packet(1, question, True)
        self._packet(1, octets(answer) if isinstance(answer, str) else answer, False)

    def reads(self, mnemonic, text):
        self.drive(ei_read(mnemonic), ei_text(mnemonic, text))

    def writes(self, mnemonic, text):
        self.drive(ei_write(mnemonic, text), ACK)

    def outputs(self, mnemonic, text):
        """A write, and the read that proves it where its ACK was late."""
        self.writes(mnemonic, text)
        self.reads(mnemonic, text)

    def identity(self):
        """What is asked where a word is in doubt: who the drive is, and its last error."""
        for mnemonic, text in (("II", ">0590"), ("V0", ">0500"), ("EE", ">00C0")):
            self.reads(mnemonic, text)
        self.writes("EE", ">0000")

    def registers(self, first, *values):
        """A block. The first question of a line is function 4, the others are function 3: both give the same."""
        for function in (3, 4):
            self.drive(rtu(1, function, *words(first, len(values))), rtu(1, function, 2 * len(values), *words(*values)))

    def written(self, first, *values):
        """One register by function 6, several by function 16."""
        head = words(first, len(values))
        one = rtu(1, 6, *words(first, values[0]))
        block = rtu(1, 16, *head, 2 * len(values), *words(*values)), rtu(1, 16, *head)
        self.drive(*((one, one) if len(values) == 1 else block))

    def pcapng(self):
        drive = [(149 if self.modbus else 148, b"drive")] if any(p[0] for p in self.packets) else []
        blocks = [block(0x0A0D0D0A, struct.pack("<IHHq", 0x1A2B3C4D, 1, 0, -1), [(1, self.shows.encode())])]
        for link, name in [(257, b"bus")] + drive:
            blocks.append(block(1, struct.pack("<HHI", link, 0, 0), [(2, name), (9, b"\x09")]))
        for interface, at, data, sent in self.packets:
            at += BEGIN
            head = struct.pack("<IIIII", interface, at >> 32, at & 0xFFFFFFFF, len(data), len(data))
            blocks.append(block(6, head + padded(data), [(2, struct.pack("<I", 2 if sent else 1))]))
        return b"".join(blocks)


def padded(data):
    return data + bytes(-len(data) % 4)


def block(kind, body, options):
    for code, value in options:
        body += struct.pack("<HH", code, len(value)) + padded(value)
    body += bytes(4)  # end of the options
    length = struct.pack("<I", len(body) + 12)
    return struct.pack("<I", kind) + length + body + length


class Master:
    """A master class 1 that speaks to one slave: it has the frame count bits, and the octets that stay the same."""

    def __init__(self, capture, slave, address, ident):
        self.capture, self.slave, self.address, self.ident = capture, slave, address, ident
        self.fc = 0x6D  # the first telegram of a sequence

    def ask(self, unit, sap, answer):
        telegram = sd(self.slave, self.address, self.fc, unit, sap and (sap, 62))
        self.capture.hears(telegram, answer)
        self.fc = 0x5D if self.fc != 0x5D else 0x7D
        return telegram

    def reply(self, unit, sap=None, fc=0x08):
        return sd(self.address, self.slave, fc, unit, sap and (62, sap)) if unit else octets(SC)

    def diag(self, standard, blocks=""):
        """`standard`: the first four octets of the reply."""
        unit = octets(standard) + words(self.ident) + octets(blocks)
        self.ask(b"", DIAG, self.reply(unit, DIAG))

    def set_prm(self, user, status="88 64 05 00"):
        """Watchdog 5 s: a loaded machine has to replay it."""
        self.ask(octets(status) + words(self.ident) + b"\x00" + user, PRM, octets(SC))

    def chk_cfg(self, identifiers):
        self.ask(octets(identifiers), CFG, octets(SC))

    def get_cfg(self, identifiers):
        self.ask(b"", GET_CFG, self.reply(octets(identifiers), GET_CFG))

    def exchange(self, outputs, inputs, high=False):
        self.ask(outputs, None, self.reply(inputs, fc=0x0A if high else 0x08))

    def rd_outp(self, outputs):
        self.ask(b"", RD_OUTP, self.reply(outputs, RD_OUTP))

    def control(self, command, groups=0):
        self.capture.hears(sd(127, self.address, 0x46, bytes([command, groups]), (CONTROL, 62)))

    def unlock(self):
        self.set_prm(b"", "40 00 00 00")

    def starts_up(self, user, identifiers, blocks="", drive=None):
        """Power-on to Data_Exch, watchdog on. `drive` has its frames; None: there is no input to wait for."""
        owner = f"{self.address:02X}"
        self.diag("02 05 00 FF", blocks)
        self.set_prm(user)
        self.chk_cfg(identifiers)
        if drive:
            self.diag("00 0E 00 " + owner, blocks)
            drive()
            self.capture.pause(500)
        self.diag("00 0C 00 " + owner, blocks)
