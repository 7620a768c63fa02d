# SPDX-License-Identifier: Apache-2.0
"""Faults that were found in this project, as far as a capture can show them, each with the commit that mended it. Each answer is
the right one: the daemon of before gave another one, none, or asked the drive for something that is not in the file."""
import wire
from wire import Capture, Master, octets, words
from worked import IN_1234, OUT_0000, OUT_A501, controller, demand, example_starts, option_board, with_demand_data

LEFT_OUT = [
    "", "A capture says what was on the line and in which order. So these kinds of faults are not here:", "",
    "- a reply that began too late, or one that other octets overtook (70a9bfa, 16617b5, c665fd8): `tests/fdl`",
    "- the search of the rate (cbb3342, 9638f84): `tests/fdl/baud`",
    "- answers of a drive that are late, or that depend on the questions before them (8926287, a8f48db, 8b2cb7e, 4afc8c6): "
    "`tests/drive_line`",
    "- what only `dpctl`, the log or the lamps show"]


def example(name, shows, source):
    return Capture("example", name, shows, source)


def lost_octet():
    """The third octet behind the header is not heard. The slot time of the master is over, and it repeats."""
    c = example("lost-octet", "a request of which an octet was lost does not cost its retry", "0b1fa51")
    example_starts(c)
    c.hears(OUT_0000, IN_1234)
    for request, lost in ((OUT_A501, 5), (OUT_0000, 8), (OUT_A501, 9)):
        telegram = octets(request)
        c.hears(telegram[:lost] + telegram[lost + 1:])
        c.hears(telegram, IN_1234)
    for value in "0000", "A501":
        c.outputs("o1", ">" + value)
    return c


def stump():
    """Its first octet is lost, and it ends in DC 16: no token, whose last octet would be the 68 of the retry."""
    c = example("stump", "the end of a damaged request is not taken for a token that swallows each retry", "0b1fa51")
    example_starts(c)
    c.hears(OUT_0000, IN_1234)
    telegram = wire.sd(5, 2, 0x7D, words(0x0058))
    assert telegram.endswith(octets("DC 16"))
    c.hears(telegram[1:])
    c.hears(telegram, IN_1234)
    c.hears(OUT_0000, IN_1234)
    c.outputs("o1", ">0058")
    return c


def sync_first():
    """The drive is asked whether it has the tag, and no more: no write is in the file."""
    c = example("sync-first", "under Sync the drive gets no 0 that no master has sent", "a9acc4d")
    example_starts(c, tags=(2,), identifiers="21", status="B8")
    c.reads("o1", ">0000")
    owner, other = Master(c, 5, 2, 0x4711), Master(c, 5, 9, 0x4711)
    owner.fc = 0x7D
    owner.control(0x20)  # Sync, all
    owner.exchange(words(0xBEED), b"")
    c.pause(300)
    owner.exchange(words(0xBEED), b"")
    other.rd_outp(words(0))
    c.pause(300)
    owner.unlock()
    c.pause(300)
    owner.diag("02 05 00 FF")
    return c


def never_written():
    """Set_Prm, Chk_Cfg and no Data_Exchange: no write is in the file."""
    c = example("never-written", "outputs that a master never sent are not set to 0 when it leaves", "f336f77")
    example_starts(c, tags=(2,), identifiers="21")
    c.reads("o1", ">0000")
    owner = Master(c, 5, 2, 0x4711)
    owner.fc = 0x7D
    c.pause(300)
    owner.unlock()
    c.pause(300)
    owner.diag("02 05 00 FF")
    return c


def stray_eot():
    """Each question for tag 55 gets an EOT, and EE says that there is no error: the value is held."""
    c, master = option_board("stray-eot", "an EOT in place of an answer does not deny a tag", "")
    c.source = "f67f531, deed511"
    held = words(1250, 3400)

    def drive():
        c.identity()
        c.reads("bj", "12.5")
        c.reads("bk", "34.")

    master.starts_up(words(55, 56).ljust(24, b"\0"), "50 50", drive=drive)
    master.exchange(b"", held)
    c.drive(wire.ei_read("bj"), wire.EOT)
    for _ in range(4):
        c.pause(150)
        master.exchange(b"", held)
    return c


def unknown_scale():
    """No table has tag 59, and 125. does not say how many decimals it has: 0, and not ready."""
    c, master = option_board("unknown-scale", "a number whose decimals are not known is not put on the bus", "")
    c.source = "d4bd2b8, row X-49"
    master.diag("02 05 00 FF")
    master.set_prm(words(59).ljust(24, b"\0"))
    master.chk_cfg("50")
    master.diag("00 0E 00 02")
    c.identity()
    c.reads("bn", "125.")
    for _ in range(2):
        c.pause(300)
        master.diag("00 0E 00 02")
        master.exchange(b"", words(0), high=True)
    return c


def not_kept():
    """The drive takes 1.00 and then holds 0.50: it has refused nothing, so the answer is 1 and not 7."""
    c, master = option_board("not-kept", "a write that the drive takes and does not keep is no refusal", "")
    c.source = "018f410"
    master.starts_up(bytes(24), "73")
    none = words(0, 0, 0, 0)
    master.exchange(none, none)
    c.identity()
    c.writes("bl", "1.")
    c.reads("bl", "0.5")
    demand(master, none, 0x2000 + 57, 100, 0x1000 + 57, 100)
    return c


def exception_0():
    """A write of tag 270 gets an exception with code 0, which no answer has: it is no transfer, and no code stands for it."""
    c, master = controller("exception-0", "a Modbus exception with code 0 is no good answer to a write", "")
    c.source = "754eb02"
    none = with_demand_data(c, master)
    c.drive(wire.rtu(1, 6, *words(270, 1)), wire.rtu(1, 0x86, 0))
    for _ in range(3):
        master.exchange(words(0x2000 + 270, 0, 0, 1), none)
        c.pause(150)
    return c


def refused_block():
    """101, 102 and 104 are inputs, 103 is an output, which is read alone before the first Data_Exchange: it is the middle, at which
    the cut was made. The controller refuses to give 101 to 104 in one block."""
    c, master = controller("refused-block", "a refused block is cut where something is read", "")
    c.source = "9f07c50"

    def drive():
        for function in (3, 4):
            c.drive(wire.rtu(1, function, *words(101, 4)), wire.rtu(1, 0x80 | function, 2))
        c.registers(101, 1111, 2222)
        c.registers(103, 0)
        c.registers(104, 4444)
        c.registers(403, 0)

    master.starts_up(words(101, 102, 103, 104), "50 50 60 50", "03 00 00", drive)
    master.exchange(words(3333), words(1111, 2222, 4444))
    c.written(103, 3333)
    c.registers(101, 1111, 2222, 3333)  # from then on the output is compared
    c.registers(103, 3333, 4444)
    return c


def captures():
    return [lost_octet(), stump(), sync_first(), never_written(), stray_eot(), unknown_scale(), not_kept(), exception_0(),
            refused_block()]
