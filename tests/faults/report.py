#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the rows of the fault matrix with the times that a run has measured.

usage: report.py [--docs] PAGE TIMES
    TIMES    lines "F07 12.3": row and milliseconds; the longest of a row counts
    --docs   writes the times, and what they were measured with, into the page, and the picture beside it
"""
import datetime
import math
import pathlib
import platform
import re
import sys

ROW = re.compile(r"^\| (F\d\d) \|.*\| ([^|]*) \|$")
MEASURED = re.compile(r"^Measured .*$", re.M)
COMMAND = "tools/run faults --docs"


def in_words(ms):
    if ms < 1:
        return f"{ms * 1000:.0f} µs"
    return f"{ms:.0f} ms" if ms < 1000 else f"{ms / 1000:.1f} s"


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.partition(":")[2].strip()
    return platform.machine()


def processors():
    return pathlib.Path("/proc/cpuinfo").read_text().count("processor\t")


def read_times(path):
    times = {}
    for line in path.read_text().splitlines():
        row, ms = line.split()
        times[row] = max(times.get(row, 0), float(ms))
    return times


def with_times(line, times):
    """The row with its time, if there is one."""
    row = ROW.match(line)
    if not row or row.group(1) not in times:
        return line
    return line[:row.start(2)] + in_words(times[row.group(1)]) + " |"


def picture(times, measured):
    """Bars on a logarithmic scale, from 10 µs to 100 s."""
    left, top, height, width, decades = 60, 40, 16, 640, 7
    rows = sorted(times)
    bottom = top + height * len(rows)

    def x(ms):
        return left + width * min(max(math.log10(max(ms, 0.01)) + 2, 0), decades) / decades

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {left + width + 80} {bottom + 40}" '
           'font-family="sans-serif" font-size="12" role="img">',
           f"<title>Time until service was back, by row of the fault matrix. {measured}</title>",
           '<rect width="100%" height="100%" fill="#ffffff"/>',
           f'<text x="{left}" y="18" font-size="14">Time until service was back</text>']
    for decade in range(decades + 1):
        ms = 10.0 ** (decade - 2)
        out.append(f'<line x1="{x(ms):.1f}" y1="{top - 6}" x2="{x(ms):.1f}" y2="{bottom}" stroke="#cccccc"/>')
        out.append(f'<text x="{x(ms):.1f}" y="{bottom + 18}" text-anchor="middle" fill="#333333">{in_words(ms)}</text>')
    for place, row in enumerate(rows):
        y = top + height * place
        out.append(f'<text x="{left - 8}" y="{y + 11}" text-anchor="end" fill="#000000">{row}</text>')
        out.append(f'<rect x="{left}" y="{y + 2}" width="{x(times[row]) - left:.1f}" height="{height - 4}" fill="#2f6f9f"/>')
        out.append(f'<text x="{x(times[row]) + 4:.1f}" y="{y + 11}" fill="#333333">{in_words(times[row])}</text>')
    return "\n".join(out + ["</svg>", ""])


def main():
    arguments = sys.argv[1:]
    writes = "--docs" in arguments
    page, file = (pathlib.Path(one) for one in arguments if one != "--docs")
    times = read_times(file)
    text = "\n".join(with_times(line, times) for line in page.read_text().split("\n"))
    for line in text.split("\n"):
        if ROW.match(line) and ROW.match(line).group(1) in times:
            print(line)
    if not writes:
        return
    measured = (f"Measured on {datetime.date.today()} by `{COMMAND}` on {processors()} × {processor()}, "
                f"Linux {platform.release().split('-')[0]}.")
    page.write_text(MEASURED.sub(lambda _: measured, text))
    target = page.parent / "pictures" / "reliability.svg"
    target.parent.mkdir(exist_ok=True)
    target.write_text(picture(times, measured))


main()
