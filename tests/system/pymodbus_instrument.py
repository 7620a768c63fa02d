#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""An instrument on a Modbus RTU line whose protocol is pymodbus': a second opinion on ours. Register = tag.

    pymodbus_instrument.py PORT [--baud 9600] [--parity N] [--unit 1] [--value TAG=WORD ...]

Says "ready" once it listens, and "TAG = WORD" for each word that the line writes. On standard input "set TAG WORD" is
a change at its front panel, "drop TAG" takes the register away, "quit" (or SIGTERM) ends it. A tag that it does not
have is answered with exception 2, another unit with silence. Runs with pymodbus 3.0 (Debian 12) and later.
"""
import argparse
import asyncio
import inspect
import signal
import sys

from pymodbus.datastore import ModbusServerContext, ModbusSparseDataBlock

try:
    from pymodbus.datastore import ModbusSlaveContext as DeviceContext
except ImportError:  # 3.10
    from pymodbus.datastore import ModbusDeviceContext as DeviceContext
try:
    from pymodbus.server import ModbusSerialServer
except ImportError:  # 3.0
    from pymodbus.server.async_io import ModbusSerialServer
try:
    from pymodbus.framer import FramerType

    RTU = FramerType.RTU
except ImportError:  # before 3.7
    from pymodbus.transaction import ModbusRtuFramer as RTU

# Tags of a temperature controller with gaps between them: two blocks, a hole within the reach of one request, a pair
# of the IEEE area (tag 1 as a single, 18.3), and the first segment of a program.
VALUES = {
    1: 183, 2: 216, 3: 450, 4: 450, 5: 216,
    15: 0, 24: 216, 25: 300,
    75: 0x0021, 76: 0x0004, 77: 0,
    122: 0x2480,
    270: 0, 273: 0,
    0x8002: 0x4192, 0x8003: 0x6666,
    8192: 0, 8193: 0, 8194: 0, 8195: 0, 8196: 1,
    8328: 1, 8329: 50, 8330: 0, 8331: 0, 8332: 1, 8336: 1, 8337: 1000, 8338: 60,
}


class Registers(ModbusSparseDataBlock):
    """Those of VALUES and no others. pymodbus counts registers from 1, the protocol from 0."""

    def __init__(self, values):
        super().__init__({tag + 1: word for tag, word in values.items()})

    def setValues(self, address, values, *more):  # pylint: disable=invalid-name
        super().setValues(address, values, *more)
        for i, word in enumerate(values):
            say(f"{address - 1 + i} = {word}")

    def at_the_panel(self, line):
        """One line of standard input."""
        words = line.split()
        if words[:1] == ["set"]:
            self.values[int(words[1], 0) + 1] = int(words[2], 0)
        elif words[:1] == ["drop"]:
            del self.values[int(words[1], 0) + 1]
        elif words:
            raise SystemExit(f"no such command: {line.strip()}")
        say(f"done: {line.strip()}")


def say(text):
    print(text, flush=True)


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("port")
    parser.add_argument("--baud", type=int, default=9600)
    parser.add_argument("--parity", choices="NEO", default="N")
    parser.add_argument("--unit", type=int, default=1)
    parser.add_argument("--value", action="append", default=[], metavar="TAG=WORD")
    return parser.parse_args()


async def serve(options):
    values = dict(VALUES)
    for text in options.value:
        tag, word = text.split("=")
        values[int(tag, 0)] = int(word, 0)
    registers = Registers(values)
    device = DeviceContext(hr=registers, ir=registers)  # a 2400 treats functions 3 and 4 alike
    context = ModbusServerContext({options.unit: device}, single=False)

    parameters = inspect.signature(ModbusSerialServer.__init__).parameters
    others = "ignore_missing_devices" if "ignore_missing_devices" in parameters else "ignore_missing_slaves"
    server = ModbusSerialServer(context, framer=RTU, port=options.port, baudrate=options.baud, bytesize=8,
                                parity=options.parity, stopbits=1, **{others: True})
    if "background" in inspect.signature(server.serve_forever).parameters:
        await server.serve_forever(background=True)
    else:
        await server.start()

    end = asyncio.Event()
    loop = asyncio.get_running_loop()
    loop.add_signal_handler(signal.SIGTERM, end.set)

    def on_input():
        line = sys.stdin.readline()
        if line.strip() == "quit":
            end.set()
        elif line:
            registers.at_the_panel(line)
        else:
            loop.remove_reader(sys.stdin)

    try:
        loop.add_reader(sys.stdin, on_input)
    except PermissionError:  # a file: no commands come
        pass
    say("ready")
    await end.wait()
    await server.shutdown()


if __name__ == "__main__":
    asyncio.run(serve(arguments()))
