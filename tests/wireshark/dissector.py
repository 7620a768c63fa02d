#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""dissector.py CASE ROOT: tshark reads packets with config/wireshark, and what it shows is as expected. 77: there is no tshark.

The packets are written here by hand; the telegrams are those of wire reference 2.1, 4.2 and 5.3.
"""
import pathlib
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile

PROFIBUS, USER0, USER1, USER2 = 257, 147, 148, 149
NS = 1_700_000_000_000_000_000

# Telegram, what it is called, words of the column Info, and fields of it.
TELEGRAMS = [
    ("10 05 02 49 50 16", "request, FDL status", "", {"sd": "0x10", "da": "5", "sa": "2", "fc": "0x49", "fc.function": "9"}),
    ("10 02 05 00 07 16", "acknowledgement without data", "OK", {"fc.station": "0", "fc.reply": "0", "fcs": "0x07"}),
    ("68 05 05 68 85 82 6D 3C 3E EE 16", "Slave_Diag", "",
     {"le": "5", "ler": "5", "sd2": "0x68", "da": "5", "sa": "2", "fc.fcb": "1", "fc.fcv": "0", "fc.function": "13",
      "dsap": "60", "ssap": "62", "ed": "0x16"}),
    ("68 0B 0B 68 82 85 08 3E 3C 02 05 00 FF 47 11 E7 16", "Slave_Diag, reply",
     "Station_Not_Ready, Prm_Req, no master, ident 0x4711",
     {"dsap": "62", "ssap": "60", "fc.reply": "8", "diag.station_not_ready": "1", "diag.prm_req": "1", "diag.always": "1",
      "diag.cfg_fault": "0", "diag.master": "255", "ident": "0x4711"}),
    ("68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16", "Set_Prm", "Lock, ident 0x4711, watchdog 200 ms",
     {"fc.fcb": "0", "fc.fcv": "1", "prm.lock_req": "1", "prm.unlock_req": "0", "prm.wd_on": "1", "prm.sync_req": "0",
      "prm.wd_fact_1": "20", "prm.wd_fact_2": "1", "prm.min_tsdr": "11", "prm.group": "0x01", "ident": "0x4711"}),
    ("E5", "SC", "", {"sd": "0xe5"}),
    ("68 07 07 68 85 82 7D 3E 3E 11 21 32 16", "Chk_Cfg", "11 21", {"cfg.identifier": "11,21"}),
    ("A2 85 82 5D 3E 3E 10 10 11 20 20 21 72 16", "Chk_Cfg", "10 10 11 20 20 21", {"sd": "0xa2", "dsap": "62"}),
    ("68 05 05 68 85 82 5D 3B 3E DD 16", "Get_Cfg", "", {"dsap": "59"}),
    ("68 07 07 68 82 85 08 3E 3B 11 21 BA 16", "Get_Cfg, reply", "11 21", {"cfg.identifier": "11,21"}),
    ("68 05 05 68 05 02 5D 00 00 64 16", "Data_Exchange", "00 00", {"outputs": "0000"}),
    ("A2 05 02 7D 01 02 03 04 05 06 07 08 A8 16", "Data_Exchange", "01 02 03 04 05 06 07 08", {"outputs": "0102030405060708"}),
    ("68 05 05 68 02 05 08 12 34 55 16", "Data_Exchange, reply", "12 34", {"inputs": "1234"}),
    ("68 05 05 68 02 05 0A 12 34 57 16", "Data_Exchange, reply", "DH; 12 34", {"fc.reply": "10", "inputs": "1234"}),
    ("10 05 02 7D 84 16", "Data_Exchange without data", "", {"fc.fcb": "1"}),
    ("68 07 07 68 FF 82 46 3A 3E 00 00 3F 16", "Global_Control", "Operate, all slaves",
     {"da": "127", "fc.function": "6", "gc.command": "0x00", "gc.group": "0x00"}),
    ("68 07 07 68 FF 82 46 3A 3E 20 01 60 16", "Global_Control", "Sync, groups 0x01", {"gc.sync": "1", "gc.unsync": "0"}),
    ("68 07 07 68 FF 82 46 3A 3E 02 00 41 16", "Global_Control", "Clear_Data, all slaves", {"gc.clear_data": "1"}),
    ("68 05 05 68 85 89 6D 38 3E F1 16", "RD_Inp", "", {"sa": "9"}),
    ("68 07 07 68 89 85 08 3E 38 12 34 D2 16", "RD_Inp, reply", "12 34", {"inputs": "1234"}),
    ("68 05 05 68 85 89 5D 39 3E E2 16", "RD_Outp", "", {"dsap": "57"}),
    ("68 07 07 68 89 85 08 3E 39 A5 01 33 16", "RD_Outp, reply", "A5 01", {"outputs": "a501"}),
    ("68 09 09 68 FE 82 6D 37 3E 05 47 11 00 BF 16", "Set_Slave_Add", "new address 5, ident 0x4711",
     {"da": "126", "ssa.address": "5", "ssa.no_change": "0x00"}),
    ("68 1A 1A 68 82 85 08 3E 3C 08 0C 00 02 47 11 04 E1 00 80 45 01 10 04 00 80 02 24 8C 06 A7 95 16", "Slave_Diag, reply",
     "Ext_Diag, WD_On, of master 2, ident 0x4711",
     {"diag.ext_diag": "1", "diag.master": "2", "diag.block": "04e10080,4501100400,800224,8c06a7"}),
    ("DC 04 02", "token", "", {"da": "4", "sa": "2"}),
]

# Telegram or a piece of one, the expert information it gets, and words of it. FCS computed by hand.
WRONG = [
    ("10 05 02 49 51 16", "bad_fcs", "FCS is 0x51 and should be 0x50"),
    ("10 05 02 49 50 17", "no_telegram", "the last octet is 0x17"),
    ("68 05 06 68 85 82 6D 3C 3E EE 16", "no_telegram", "LE and LEr must be equal"),
    ("68 05 05 69 85 82 6D 3C 3E EE 16", "no_telegram", "LE and LEr must be equal"),
    ("68 03 03 68 05 02 7D 84 16", "no_telegram", "LE is 3"),
    ("68 FA FA 68 05 02 7D 84 16", "no_telegram", "LE is 250"),
    ("68 05 05 68 85 82 6D 3C", "no_telegram", "it has 8 octets and should have 11"),
    ("68 05", "no_telegram", "it ends after 2 octets"),
    ("10 85 02 49 D0 16", "no_telegram", "announces a SAP"),
    ("E5 E5", "no_telegram", "octets behind the telegram"),
    ("7F 10", "no_telegram", "0x7F begins no telegram"),
    ("10 02 05 03 0A 16", "refused", "RS: service or SAP not activated"),
    ("10 02 05 02 09 16", "refused", "RR: no resource for the data"),
    ("68 0B 0B 68 82 85 08 3E 3C 06 05 00 FF 47 11 EB 16", "reported", "Cfg_Fault"),
    ("68 0A 0A 68 82 85 08 3E 3C 00 0C 00 02 47 DE 16", "contents", "Slave_Diag has at least 6 octets, here are 5"),
    ("68 0D 0D 68 82 85 08 3E 3C 08 0C 00 02 47 11 05 01 FD 16", "contents", "the header of a block and its length disagree"),
    ("68 06 06 68 FF 82 46 3A 3E 20 5F 16", "contents", "Global_Control has at least 2 octets, here are 1"),
    ("68 08 08 68 FF 82 46 3A 3E 20 01 00 60 16", "contents", "Global_Control has 2 octets"),
    ("68 06 06 68 85 82 7D 3E 3E 40 40 16", "contents", "announces octets that are not there"),
    ("68 0B 0B 68 85 82 5D 3D 3E 88 14 01 0B 47 11 DF 16", "contents", "Set_Prm has at least 7 octets, here are 6"),
    ("68 08 08 68 FE 82 6D 37 3E 05 47 11 BF 16", "contents", "Set_Slave_Add has at least 4 octets, here are 3"),
]

# EI-ASCII reference, section 1: the table of frames.
EI_ASCII = [
    ("04 30 30 31 31 50 56 05", "read PV at 01"),
    ("04 30 30 31 31 31 50 56 05", "read PV at 01"),
    ("02 50 56 31 36 2E 34 03 18", "value PV = 16.4"),
    ("04 30 30 31 31 02 53 4C 32 32 2E 30 03 02", "write SL = 22.0 at 01"),
    ("04 30 30 31 31 49 49 05", "read II at 01"),
    ("02 49 49 3E 32 36 35 30 03 3C", "value II = >2650"),
    ("04 30 30 30 30 02 37 6A 3E 30 34 37 46 03 15", "write 7j = >047F at 00"),
    ("06", "ACK: accepted"),
    ("15", "NAK: refused"),
    ("04", "EOT: the end, or the mnemonic is not known"),
]
EI_ASCII_WRONG = [
    ("02 50 56 31 36 2E 34 03 19", "bad_bcc", "BCC is 0x19 and should be 0x18"),
    ("02 50 56 31 36", "no_frame", "ETX and BCC are not at its end"),
    ("04 30 30 31", "no_frame", "an address"),
    ("04 30 31 31 31 49 49 05", "no_frame", "must stand there twice"),
    ("15", "refused", "The drive refuses"),
]
# Modbus reference, section 5: tag 403 of a 2400f is asked and is 0; a write that is refused.
MODBUS = [("01 03 01 93 00 01 75 DB", "3"), ("01 03 02 00 00 B8 44", "3"), ("01 86 02 C3 A1", "6")]
MODBUS_WRONG = [("01 03 02 00 00 B8 45", "the CRC is wrong"), ("01 03", "2 octets"), ("01 86 00 42 60", "does not fit"),
                ("01 03 03 00 00 E9 84", "does not fit"), ("01 2B 0E BF 34", "function code 43 is not used")]


def octets(text):
    return bytes.fromhex(text)


def block(kind, body):
    body += b"\0" * (-len(body) % 4)
    return struct.pack("<II", kind, len(body) + 12) + body + struct.pack("<I", len(body) + 12)


def option(code, value):
    return struct.pack("<HH", code, len(value)) + value + b"\0" * (-len(value) % 4)


def capture(packets):
    """A pcapng file of packets (link type, name of the interface, octets), one each millisecond."""
    file = block(0x0A0D0D0A, struct.pack("<IHHq", 0x1A2B3C4D, 1, 0, -1))
    interfaces = sorted({(link, name) for link, name, _ in packets})
    for link, name in interfaces:
        file += block(1, struct.pack("<HHI", link, 0, 0) + option(2, name.encode()) + option(9, b"\x09") + option(0, b""))
    for number, (link, name, data) in enumerate(packets):
        at = NS + number * 1_000_000
        file += block(6, struct.pack("<IIIII", interfaces.index((link, name)), at >> 32, at & 0xFFFFFFFF, len(data), len(data))
                      + data)
    return file


class Shark:
    """tshark with the files of config/wireshark in the folder of the Lua plugins of a user, and with no other settings."""

    def __init__(self, root):
        self.root = root
        self.folder = tempfile.TemporaryDirectory()
        home = pathlib.Path(self.folder.name)
        self.environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": str(home), "XDG_CONFIG_HOME": str(home / "config"),
                            "LC_ALL": "C.UTF-8", "TZ": "UTC"}
        shutil.copytree(root / "config/wireshark", home / ".local/lib/wireshark/plugins")

    def run(self, file, *more):
        path = pathlib.Path(self.folder.name) / "capture.pcapng"
        path.write_bytes(file)
        run = subprocess.run(["tshark", "-r", path, *more], env=self.environment, capture_output=True, text=True, errors="replace", check=False)
        assert run.returncode == 0, f"{run.args}: {run.stderr}"
        assert "Lua" not in run.stderr, run.stderr
        return run.stdout

    def fields(self, file, names):
        """Of each packet a dict; a field that it has more than once is joined by commas."""
        wanted = [word for name in names for word in ("-e", name)]
        text = self.run(file, "-T", "fields", "-E", "separator=/t", "-E", "occurrence=a", *wanted)
        return [dict(zip(names, line.split("\t"))) for line in text.split("\n")[:-1]]


def of(link, rows, name="bus"):
    return capture([(link, name, octets(row[0])) for row in rows])


def check_sound(text):
    """What tshark -V printed has no fault of the dissector itself. Others may call their own packets malformed."""
    for found in re.finditer(r"\[Malformed Packet: (?!PKTAP).*|Lua Error.*|Dissector bug.*", text):
        raise AssertionError(text[max(0, found.start() - 1500):found.end()])


def names_each_service(shark):
    for link in (PROFIBUS, USER0):
        shown = shark.fields(of(link, TELEGRAMS), ["profibus.service", "_ws.col.Protocol", "_ws.col.Info", "_ws.expert.message"])
        assert len(shown) == len(TELEGRAMS)
        for (text, service, info, _), packet in zip(TELEGRAMS, shown):
            assert packet["profibus.service"] == service, (text, packet)
            assert packet["_ws.col.Protocol"] == "PROFIBUS", (text, packet)
            assert packet["_ws.col.Info"].startswith(service), (text, packet)
            assert info in packet["_ws.col.Info"], (text, info, packet)
            assert packet["_ws.expert.message"] == "" or "Ext_Diag" in packet["_ws.expert.message"], (text, packet)


def shows_the_fields_of_each_service(shark):
    names = sorted({f"profibus.{name}" for row in TELEGRAMS for name in row[3]})
    shown = shark.fields(of(PROFIBUS, TELEGRAMS), names)
    for (text, _, _, wanted), packet in zip(TELEGRAMS, shown):
        for name, value in wanted.items():
            assert packet[f"profibus.{name}"] == value, (text, name, value, packet[f"profibus.{name}"])


def joins_replies_to_their_requests(shark):
    rows = [(text,) for text in ("10 05 02 49 50 16", "10 02 05 00 07 16", "68 07 07 68 FF 82 46 3A 3E 00 00 3F 16", "E5",
                                 "68 07 07 68 85 82 7D 3E 3E 11 21 32 16", "7F", "E5", "E5",
                                 "68 05 05 68 05 02 5D 00 00 64 16", "68 05 05 68 02 06 08 12 34 56 16")]
    shown = shark.fields(of(PROFIBUS, rows), ["profibus.request_in", "profibus.since_request", "_ws.col.Info"])
    asked = [packet["profibus.request_in"] for packet in shown]
    # Nothing answers Global_Control; a second SC has no request; the last reply comes from another station.
    assert asked == ["", "1", "", "", "", "", "5", "", "", ""], asked
    assert float(shown[6]["profibus.since_request"]) == 0.002, shown[6]
    assert shown[6]["_ws.col.Info"] == "SC: to Chk_Cfg of frame 5", shown[6]


def names_what_is_wrong(shark):
    shown = shark.fields(of(PROFIBUS, WRONG), ["_ws.expert.message", *[f"profibus.{row[1]}" for row in WRONG]])
    assert len(shown) == len(WRONG)
    for (text, flaw, words), packet in zip(WRONG, shown):
        assert packet[f"profibus.{flaw}"] != "", (text, flaw, packet)
        assert words in packet["_ws.expert.message"], (text, words, packet)


def noise_of(chance, length):
    """Any octets behind an address and a function code that is used."""
    some = bytes([1, chance.choice((3, 4, 6, 7, 8, 16, 0x83, 0x86, 0x90))])
    return (some if chance.randrange(2) else b"") + bytes(chance.randrange(256) for _ in range(length))


def with_crc(frame):
    value = 0xFFFF
    for octet in frame:
        value ^= octet
        for _ in range(8):
            value = (value >> 1) ^ (0xA001 if value & 1 else 0)
    return frame + bytes([value & 0xFF, value >> 8])


def survives_hostile_packets(shark):
    """Every truncated telegram is called one, and nothing that can be heard makes the dissector fail."""
    cut = [octets(row[0])[:length] for row in TELEGRAMS for length in range(1, len(octets(row[0])))]
    shown = shark.fields(capture([(PROFIBUS, "bus", one) for one in cut]), ["profibus.no_telegram"])
    assert len(shown) == len(cut)
    for one, packet in zip(cut, shown):
        assert packet["profibus.no_telegram"] != "", one.hex(" ")

    chance = random.Random(257)
    hostile = [(PROFIBUS, "bus", one) for one in cut] + [(PROFIBUS, "bus", b""), (USER1, "drive", b""), (USER2, "drive", b"")]
    for row in TELEGRAMS + WRONG:
        right = octets(row[0])
        for place in range(len(right)):
            wrong = bytearray(right)
            wrong[place] ^= 1 << chance.randrange(8)
            hostile.append((chance.choice((PROFIBUS, USER0)), "bus", bytes(wrong)))
    for row in MODBUS + MODBUS_WRONG:
        right = octets(row[0])
        hostile += [(USER2, "drive", right[:i] + bytes([chance.randrange(256)]) + right[i + 1:]) for i in range(len(right))]
    hostile += [(USER2, "drive", with_crc(noise_of(chance, chance.randrange(1, 60)))) for _ in range(600)]
    for row in EI_ASCII + EI_ASCII_WRONG:
        right = octets(row[0])
        hostile += [(USER1, "drive", right[:length]) for length in range(1, len(right))]
        hostile += [(USER1, "drive", right[:i] + bytes([chance.randrange(256)]) + right[i + 1:]) for i in range(len(right))]
    for _ in range(1500):
        noise = noise_of(chance, chance.randrange(1, 300))
        link = chance.choice((PROFIBUS, USER0, USER1, USER2))
        if link in (PROFIBUS, USER0) and chance.randrange(2):  # a sound frame of a service with any contents
            du = bytes([chance.randrange(55, 63), 62]) + noise[:chance.randrange(0, 240)]
            body = bytes([0x85, 0x82, 0x5D]) + du if chance.randrange(2) else bytes([0x82, 0x85, 0x08, 62, du[0]]) + du[2:]
            noise = bytes([0x68, len(body), len(body), 0x68]) + body + bytes([sum(body) % 256, 0x16])
        hostile.append((link, chance.choice(("bus", "drive", "eth0")), noise))
    text = shark.run(capture(hostile), "-V")
    assert text.count("\nFrame ") + text.startswith("Frame ") == len(hostile)
    check_sound(text)


def reads_ei_ascii(shark):
    shown = shark.fields(of(USER1, EI_ASCII, "drive"), ["eiascii.service", "_ws.col.Protocol", "_ws.expert.message"])
    for (text, service), packet in zip(EI_ASCII, shown):
        assert packet["eiascii.service"] == service, (text, packet)
        assert packet["_ws.col.Protocol"] == "EI-ASCII", (text, packet)
        assert packet["_ws.expert.message"] == "" or text == "15", (text, packet)
    shown = shark.fields(of(USER1, EI_ASCII_WRONG, "drive"),
                         ["_ws.expert.message", *[f"eiascii.{row[1]}" for row in EI_ASCII_WRONG]])
    for (text, flaw, words), packet in zip(EI_ASCII_WRONG, shown):
        assert packet[f"eiascii.{flaw}"] != "" and words in packet["_ws.expert.message"], (text, packet)


def hands_modbus_to_its_own_dissector(shark):
    shown = shark.fields(of(USER2, MODBUS, "drive"), ["_ws.col.Protocol", "modbus.func_code", "mbrtu.crc16", "_ws.expert.message"])
    for (text, function), packet in zip(MODBUS, shown):
        assert packet["_ws.col.Protocol"] == "Modbus RTU", (text, packet)
        assert packet["modbus.func_code"] == function and packet["mbrtu.crc16"] != "", (text, packet)
        assert packet["_ws.expert.message"] == "" or function == "6", (text, packet)
    shown = shark.fields(of(USER2, MODBUS_WRONG, "drive"), ["_ws.col.Protocol", "modbus", "_ws.expert.message"])
    for (text, words), packet in zip(MODBUS_WRONG, shown):
        assert packet["_ws.col.Protocol"] == "Modbus RTU" and packet["modbus"] == "", (text, packet)
        assert words in packet["_ws.expert.message"], (text, words, packet)


def leaves_the_packets_of_others_alone(shark):
    others = [(PROFIBUS, "eth0", b"\x45\x00\x00\x14"), (300, "other", b"\xAA\xBB"), (USER0, "eth0", b"\x45\x00"),
              (USER1, "eth0", b"\x06\x06"), (USER2, "eth0", b"\x01\x03\x00\x00"), (1, "eth0", b"\x68" * 60)]
    shown = shark.fields(capture(others), ["_ws.col.Protocol", "profibus", "eiascii", "mbrtu"])
    for (link, _, _), packet in zip(others, shown):
        assert packet["profibus"] == packet["eiascii"] == packet["mbrtu"] == "", (link, packet)
    # The choice that a user made for such a link type holds: DLT_USER hands these to the dissector named there.
    text = shark.run(capture(others[2:4]), "-o", 'uat:user_dlts:"User 0 (DLT=147)","data","0","","0",""', "-V")
    assert "DLT: 147, Payload: data" in text and "not handled: DLT=148" in text, text


def reads_the_captures_of_a_foreign_master(shark):
    """Every packet is named, and nothing in them is wrong but a Cfg_Fault: of the scenario, or left from the one before."""
    files = sorted((shark.root / "tests/captures/foreign").glob("*.pcapng"))
    assert len(files) == 14, files
    data = b"".join(file.read_bytes() for file in files)  # each is a section of one capture
    text = shark.run(data, "-V")
    check_sound(text)
    assert "[Malformed" not in text
    names = ["frame.section_number", "_ws.col.Protocol", "profibus.service", "eiascii.service", "_ws.expert.message"]
    section, number = 0, 0
    for packet in shark.fields(data, names):
        number = number + 1 if int(packet["frame.section_number"]) == section else 1
        section = int(packet["frame.section_number"])
        place = (files[section - 1].name, number, packet)
        assert packet["_ws.col.Protocol"] in ("PROFIBUS", "EI-ASCII", "Modbus RTU"), place
        if packet["_ws.col.Protocol"] != "Modbus RTU":
            assert packet["profibus.service"] + packet["eiascii.service"] != "", place
        wrong = packet["_ws.expert.message"]
        assert wrong in ("", "The slave reports Cfg_Fault"), place
        assert wrong == "" or "more-identifiers" in place[0] or number < 20, place
    assert section == len(files), section


def main():
    if shutil.which("tshark", path="/usr/bin:/bin") is None:
        print("there is no tshark: apt-get install tshark")
        return 77
    globals()[sys.argv[1]](Shark(pathlib.Path(sys.argv[2])))
    return 0


if __name__ == "__main__":
    sys.exit(main())
