# SPDX-License-Identifier: Apache-2.0
"""The worked examples. Telegrams of the wire reference stand here as it prints them, with their checksums; those of the manuals
are made of the data units that the manuals print. W: the wire reference, with its section."""
import wire
from wire import Capture, Master, octets, words

LEFT_OUT = [
    "", "Left out, because no station of the gateway has what they show: Set_Slave_Add (4.9), the extended diagnosis of all three "
    "kinds (5.3) and the ET 200S (4.1, 5.4).", "`tests/dp/golden_telegrams_test.cpp` has the last two.",
    "", "In the examples of the wire reference Set_Prm has tags behind its seven octets, because a parameter of the gateway has "
    "a tag. Its watchdog is 5 s, so that a loaded machine can replay it."]

ON_5D, ON_7D = "68 05 05 68 85 82 5D 3C 3E DE 16", "68 05 05 68 85 82 7D 3C 3E FE 16"  # Slave_Diag
NOT_READY = "68 0B 0B 68 82 85 08 3E 3C 00 0E 00 02 47 11 F1 16"
READY = "68 0B 0B 68 82 85 08 3E 3C 00 0C 00 02 47 11 EF 16"
IN_1234, OUT_0000 = "68 05 05 68 02 05 08 12 34 55 16", "68 05 05 68 05 02 5D 00 00 64 16"
OUT_A501 = "68 05 05 68 05 02 7D A5 01 2A 16"


def example(name, shows, source):
    return Capture("example", name, shows, f"wire reference {source}")


def example_starts(capture, tags=(1, 2), identifiers="11 21", value="1234", status="88"):
    """Lines 1 to 12 of W 4.2. Set_Prm has tags, and a watchdog of 5 s, not of 200 ms: a loaded machine has to replay it."""
    capture.hears("10 05 02 49 50 16", "10 02 05 00 07 16")
    capture.hears("68 05 05 68 85 82 6D 3C 3E EE 16", "68 0B 0B 68 82 85 08 3E 3C 02 05 00 FF 47 11 E7 16")
    capture.hears(wire.sd(5, 2, 0x5D, octets(status + " 64 05 0B 47 11 01") + words(*tags), (61, 62)), wire.SC)
    capture.hears(wire.sd(5, 2, 0x7D, octets(identifiers), (62, 62)), wire.SC)
    capture.identity()
    if 1 not in tags:
        capture.hears(ON_5D, READY)  # there is no input to wait for
        return
    capture.hears(ON_5D, NOT_READY)
    capture.reads("i1", ">" + value)
    capture.pause(500)
    capture.hears(ON_7D, READY)


def output_is_written(capture, value, mnemonic="o1"):
    capture.outputs(mnemonic, ">" + value)
    capture.pause(20)


def start_up():
    c = example("start-up", "start-up, Data_Exchange, Operate, Get_Cfg", "4.2 lines 1 to 16, 4.5")
    example_starts(c)
    c.hears(OUT_0000, IN_1234)
    c.hears("68 07 07 68 FF 82 46 3A 3E 00 00 3F 16")
    c.hears(OUT_A501, IN_1234)
    output_is_written(c, "A501")
    c.hears("68 05 05 68 85 82 5D 3B 3E DD 16", "68 07 07 68 82 85 08 3E 3B 11 21 BA 16")
    return c


def lost_reply():
    c = example("lost-reply", "a retry gets the same reply, with the inputs of before", "2.6")
    example_starts(c, value="AA55")
    c.hears(OUT_0000, "68 05 05 68 02 05 08 AA 55 0E 16")
    c.hears("68 05 05 68 05 02 7D 12 34 CA 16", "68 05 05 68 02 05 08 AA 55 0E 16")
    output_is_written(c, "1234")
    c.reads("i1", ">AA56")
    c.pause(50)
    c.hears("68 05 05 68 05 02 7D 12 34 CA 16", "68 05 05 68 02 05 08 AA 55 0E 16")
    c.hears("68 05 05 68 05 02 5D 12 35 AB 16", "68 05 05 68 02 05 08 AA 56 0F 16")
    return c


def read_back():
    c = example("read-back", "RD_Inp and RD_Outp by another master", "4.8")
    example_starts(c)
    c.hears(OUT_0000, IN_1234)
    c.hears(OUT_A501, IN_1234)
    output_is_written(c, "A501")
    c.hears("68 05 05 68 85 89 6D 38 3E F1 16", "68 07 07 68 89 85 08 3E 38 12 34 D2 16")
    c.hears("68 05 05 68 85 89 5D 39 3E E2 16", "68 07 07 68 89 85 08 3E 39 A5 01 33 16")
    return c


def global_control():
    """What each command does is read back by master 9."""
    c = example("global-control", "Sync, Unsync, Freeze, Unfreeze, Clear, Operate, and what they do", "4.10")
    example_starts(c, status="B8")
    owner, other = Master(c, 5, 2, 0x4711), Master(c, 5, 9, 0x4711)
    owner.fc = 0x5D
    live, later = words(0x1234), words(0x4321)
    owner.exchange(words(0xA501), live)
    output_is_written(c, "A501")
    c.hears("68 07 07 68 FF 82 46 3A 3E 20 01 60 16")  # Sync, group 1
    owner.exchange(words(0x1111), live)
    other.rd_outp(words(0xA501))
    owner.diag("00 2C 00 02")
    c.hears("68 07 07 68 FF 82 46 3A 3E 10 01 50 16")  # Unsync, group 1
    other.rd_outp(words(0x1111))
    output_is_written(c, "1111")
    c.hears("68 07 07 68 FF 82 46 3A 3E 08 00 47 16")  # Freeze, all
    c.reads("i1", ">4321")
    c.pause(50)
    owner.exchange(words(0x1111), live)
    owner.diag("00 1C 00 02")
    c.hears("68 07 07 68 FF 82 46 3A 3E 04 00 43 16")  # Unfreeze, all
    owner.exchange(words(0x1111), later)
    c.hears("68 07 07 68 FF 82 46 3A 3E 02 00 41 16")  # Clear all
    other.rd_outp(words(0))
    c.hears("68 07 07 68 FF 82 46 3A 3E 00 00 3F 16")  # Operate
    c.hears("68 07 07 68 FF 82 44 3A 3E 00 00 3D 16")  # Operate as SDN low
    owner.exchange(words(0xA501), later)
    other.rd_outp(words(0xA501))
    return c


def only_inputs():
    c = example("only-inputs", "Data_Exchange without outputs is SD1", "4.7")
    example_starts(c, tags=(1,), identifiers="11")
    c.hears("10 05 02 5D 64 16", IN_1234)
    c.hears("10 05 02 7D 84 16", IN_1234)
    return c


def only_outputs():
    c = example("only-outputs", "without inputs the reply is SC", "4.7")
    example_starts(c, tags=(2,), identifiers="21")
    c.hears("68 05 05 68 05 02 7D 00 00 84 16", wire.SC)
    c.hears("68 05 05 68 05 02 5D 01 02 67 16", wire.SC)
    output_is_written(c, "0102")
    return c


def fail_safe_clear():
    c = example("fail-safe-clear", "Data_Exchange without data clears the outputs", "4.7")
    example_starts(c)
    c.hears(OUT_0000, IN_1234)
    c.hears(OUT_A501, IN_1234)
    output_is_written(c, "A501")
    c.hears("10 05 02 5D 64 16", IN_1234)
    Master(c, 5, 9, 0x4711).rd_outp(words(0))
    return c


def not_in_exchange():
    c = example("not-in-exchange", "Data_Exchange before the start-up is refused: RS", "4.7, 2.4")
    c.hears("10 05 02 49 50 16", "10 02 05 00 07 16")
    c.hears("68 05 05 68 05 02 7D 00 00 84 16", "10 02 05 03 0A 16")
    return c


def fixed_length():
    c = example("fixed-length", "eight octets of outputs as SD2 and as SD3", "2.1")
    example_starts(c, tags=(2, 3, 4, 5), identifiers="21 21 21 21")
    c.hears("68 0B 0B 68 05 02 7D 01 02 03 04 05 06 07 08 A8 16", wire.SC)
    c.hears(wire.sd(5, 2, 0x5D, bytes(8)), wire.SC)
    c.hears("A2 05 02 7D 01 02 03 04 05 06 07 08 A8 16", wire.SC)
    Master(c, 5, 9, 0x4711).rd_outp(octets("01 02 03 04 05 06 07 08"))
    for mnemonic, value in (("o1", "0102"), ("o2", "0304"), ("o3", "0506"), ("o4", "0708")):
        c.outputs(mnemonic, ">" + value)
    return c


# ---- HA389815: option board of 584S, 590 and 620. The tags have two decimals here: 12.50 is 04E2.

PRM_590 = octets("00 37 00 38 01 20 00 00").ljust(24, b"\0")  # tags 55, 56, 288, end


def option_board(name, shows, source):
    c = Capture("590", name, shows, f"HA389815 {source}")
    return c, Master(c, 8, 2, 0x0533)


def drive_590(c):
    c.identity()
    c.reads("bj", "12.5")
    c.reads("bk", "-3.")


def tags_590():
    c, master = option_board("tags", "tags 55, 56 and 288, ended by tag 0", "chapter 6, User Parameter Data")
    master.starts_up(PRM_590, "50 50 60", drive=lambda: drive_590(c))
    master.get_cfg("50 50 60")
    master.exchange(words(100), words(1250, -300 & 0xFFFF))
    c.outputs("i0", "1.")
    c.pause(50)
    master.exchange(words(100), words(1250, -300 & 0xFFFF))
    return c


def identifiers_590():
    c, master = option_board("identifiers", "identifiers 50 50 60 60", "chapter 6, Configuration Data")
    master.starts_up(words(55, 56, 288, 57).ljust(24, b"\0"), "50 50 60 60", drive=lambda: drive_590(c))
    master.get_cfg("50 50 60 60")
    master.exchange(words(100, 200), words(1250, -300 & 0xFFFF))
    c.outputs("i0", "1.")
    c.outputs("bl", "2.")
    c.pause(50)
    master.exchange(words(100, 200), words(1250, -300 & 0xFFFF))
    return c


def ident_590():
    c, master = option_board("ident", "a Set_Prm with another Ident_Number than 0533 is refused",
                             "chapter 6, Identification Number")
    master.diag("02 05 00 FF")
    master.ident = 0x0534
    master.set_prm(PRM_590)
    master.ident = 0x0533
    master.diag("42 05 00 FF")
    return c


def demand(master, before, command, value, reply, answer, tag=0):
    """An order of Demand Data: the answer of before, and then its own one."""
    master.exchange(words(command, tag, 0, value), before)
    master.capture.pause(300)
    new = words(reply, tag, 0, answer)
    master.exchange(words(command, tag, 0, value), new)
    return new


def demand_590():
    """Values: a read gives 12.50 (04E2), a write of 1.00 (0064) is taken, tag 58 is read only."""
    c, master = option_board("demand-data", "commands 0, 1 and 2, answers 0, 1 and 7, code 1", "chapter 7")
    master.starts_up(bytes(24), "73")
    none = words(0, 0, 0, 0)
    master.exchange(none, none)
    c.identity()
    c.reads("bj", "12.5")
    one = demand(master, none, 0x1000 + 55, 0, 0x1000 + 55, 1250)
    c.writes("bl", "1.")
    c.reads("bl", "1.")
    two = demand(master, one, 0x2000 + 57, 100, 0x1000 + 57, 100)
    demand(master, two, 0x2000 + 58, 100, 0x7000 + 58, 1)
    master.exchange(none, none)
    return c


# ---- HA463561: technology box. The block of the diagnosis is always there: 04, trip, EXT DIAGNOSTIC.

QUIET_BOX = "04 00 00 00"
PRM_6053 = octets("00 00 00 01 0F 01 0D 01 10 00 FF")  # tags 271, 269, 272, 255


def box(name, shows, page, master=2):
    c = Capture("6053", name, shows, f"HA463561 {page}")
    return c, Master(c, 8, master, 0x1649)


def monitored(c, trip="0000", event="0000"):
    """The tags that stations/6053.toml has for the diagnosis."""
    c.identity()
    c.reads("l5", ">" + trip)
    c.reads("l6", ">" + event)


def tags_6053(name, shows, user):
    c, master = box(name, shows, "Configuration Data and User Parameter Data")

    def drive():
        c.reads("hk", "0.03")
        c.reads("h3", "12.5")
        monitored(c)

    master.starts_up(user, "60 60 50 50", QUIET_BOX, drive)
    master.get_cfg("60 60 50 50")
    master.exchange(words(1151, 500), words(3, 1250))
    c.outputs("hj", "11.51")
    c.outputs("hh", "5.")
    c.pause(50)
    master.exchange(words(1151, 500), words(3, 1250))
    return c


def encoding_6053():
    c, master = box("encoding", "300.00 is 7530, -300.00 is 8AD0, FALSE is 0000, TRUE is 0001", "Data Encoding")

    def drive():
        for mnemonic, text in (("h3", "300."), ("74", "-300."), ("78", ">00"), ("79", ">01")):
            c.reads(mnemonic, text)
        monitored(c)

    master.starts_up(bytes(3) + words(255, 256, 260, 261), "50 50 50 50", QUIET_BOX, drive)
    master.exchange(b"", octets("75 30 8A D0 00 00 00 01"))
    return c


def diagnosis_6053():
    c, master = box("diagnosis", "Link Overvolts and EXT DIAGNOSTIC 6AB5, announced by a reply of high priority",
                    "PROFIBUS Diagnostics", master=1)
    none = words(0, 0, 0, 0)
    monitored(c)
    master.starts_up(b"", "73", QUIET_BOX)
    master.exchange(none, none)
    monitored(c, "0001", "6AB5")
    c.pause(1500)
    master.exchange(none, none, high=True)
    master.diag("00 0C 00 01", "04 01 6A B5")
    master.exchange(none, none)
    return c


# ---- 2408f/2404f handbook. Register 403 is the status word of stations/2400f.toml.

QUIET_CONTROLLER = "03 00 00"


def controller(name, shows, chapter):
    c = Capture("2400f", name, shows, f"2408f/2404f handbook {chapter}")
    return c, Master(c, 8, 0x24, 0x4242)


def with_demand_data(c, master):
    """Chapter 7: 'Clear any previous demand data requests'."""
    none = words(0, 0, 0, 0)
    c.registers(403, 0)
    master.starts_up(b"", "73", QUIET_CONTROLLER)
    master.exchange(none, none)
    return none


def mapping_2400f():
    c, master = controller("mapping", "the mapping of EURO2400; 999.9 is 9999, 12.34 is 1234", "table 4-1 and chapter 4")
    inputs = words(9999, 1234, 500, 0)

    def drive():
        # One block, in which other registers are 0; and one with the outputs 15, 24 and 25, to be compared.
        c.registers(1, 9999, 0, 500, 0, 1234)
        c.registers(1, 9999, 0, 500, 0, 1234, *[0] * 20)
        c.registers(75, 0)
        c.registers(403, 0)

    master.starts_up(words(1, 5, 3, 75, 24, 25, 15, 274), "50 50 50 50 60 60 60 60", QUIET_CONTROLLER, drive)
    master.exchange(words(100, 200, 1, 0), inputs)
    c.written(24, 100, 200)  # or one by one, if the block was not answered in time
    for first, value in ((24, 100), (25, 200), (15, 1), (274, 0)):
        c.written(first, value)
        c.registers(first, value)
    c.pause(50)
    master.exchange(words(100, 200, 1, 0), inputs)
    return c


def diagnosis_2400f():
    c, master = controller("diagnosis", "manual mode, sensor break and IP1 fault: 4030", "chapter 4, Diagnostics Example")
    none = with_demand_data(c, master)
    c.registers(403, 0x4030)
    c.pause(1500)
    master.exchange(none, none, high=True)
    master.diag("00 0C 00 24", "03 40 30")
    master.exchange(none, none)
    return c


def autotune_2400f():
    c, master = controller("autotune", "starts an autotune and polls it until bit 12 clears", "chapter 7, worked example 1")
    none = with_demand_data(c, master)
    started = wire.rtu(1, 6, *words(270, 1))
    c.drive(started, started)
    one = demand(master, none, 8462, 1, 4366, 1)
    c.registers(76, 0x1000)
    two = demand(master, one, 4172, 0, 4172, 0x1000)
    c.registers(76, 0)
    c.pause(1500)
    demand(master, two, 4172, 0, 4172, 0)
    return c


def refused_2400f():
    c, master = controller("autotune-refused", "the controller refuses the autotune: 28942 and code 0",
                           "chapter 7, worked example 1, X-09")
    none = with_demand_data(c, master)
    c.drive(wire.rtu(1, 6, *words(270, 1)), wire.rtu(1, 0x86, 2))
    demand(master, none, 8462, 1, 28942, 0)
    return c


def program_2400f():
    c, master = controller("program", "reads of a program with extended tags, 8328 to 8463", "chapter 7, worked example 2, X-19")
    before = with_demand_data(c, master)
    for tag, value in ((8328, 1), (8329, 50), (8463, 7)):
        c.registers(tag, value)
        before = demand(master, before, 12288, 0, 0x1000, value, tag)
    return c


def captures():
    return [start_up(), lost_reply(), read_back(), global_control(), only_inputs(), only_outputs(), fail_safe_clear(),
            not_in_exchange(), fixed_length(), ident_590(), tags_590(), identifiers_590(), demand_590(),
            tags_6053("tags", "tags 271, 269, 272 and 255 behind three octets for DPV1", PRM_6053),
            tags_6053("tags-in-63-octets", "the same tags, filled with zeros as some tools do", PRM_6053.ljust(63, b"\0")),
            encoding_6053(), diagnosis_6053(), mapping_2400f(), diagnosis_2400f(), autotune_2400f(), refused_2400f(),
            program_2400f()]
