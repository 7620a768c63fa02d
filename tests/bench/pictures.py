# SPDX-License-Identifier: Apache-2.0
"""The pictures of docs/internals/performance.md as SVG, drawn from the curves that the programs of tools/bench wrote."""

import math
import pathlib
from collections.abc import Callable

WIDTH, HEIGHT = 760, 380
LEFT, RIGHT, TOP, BOTTOM = 70, 20, 40, 50
COLOURS = ["#0b5fa5", "#c4501b", "#3c7d3c", "#7a4fa0"]

Axis = tuple[Callable[[float], float], list[tuple[float, str]]]


class Chart:
    """Lines over two axes. An axis is a function of a value to 0..1, and the marks with their words."""

    def __init__(self, title: str, x: Axis, y: Axis, x_words: str, y_words: str):
        self.x, self.y = x[0], y[0]
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">',
            f"<title>{title}</title>",
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>',
            self._words(LEFT, 22, title, 'font-weight="bold"'),
            self._words((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 10, x_words, 'text-anchor="middle"'),
            f'<text transform="translate(16 {(TOP + HEIGHT - BOTTOM) / 2}) rotate(-90)" text-anchor="middle">{y_words}</text>',
        ]
        for value, words in x[1]:
            at = self._x(value)
            self.parts.append(f'<path d="M{at:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#dddddd"/>')
            self.parts.append(self._words(at, HEIGHT - BOTTOM + 18, words, 'text-anchor="middle"'))
        for value, words in y[1]:
            at = self._y(value)
            self.parts.append(f'<path d="M{LEFT} {at:.1f}H{WIDTH - RIGHT}" stroke="#dddddd"/>')
            self.parts.append(self._words(LEFT - 6, at + 4, words, 'text-anchor="end"'))
        self.lines = 0

    def _x(self, value: float) -> float:
        return LEFT + self.x(value) * (WIDTH - LEFT - RIGHT)

    def _y(self, value: float) -> float:
        return HEIGHT - BOTTOM - self.y(value) * (HEIGHT - TOP - BOTTOM)

    @staticmethod
    def _words(x: float, y: float, words: str, more: str = "") -> str:
        return f'<text x="{x:.1f}" y="{y:.1f}" {more}>{words}</text>'

    def line(self, name: str, points: list[list[float]], dashed: bool = False) -> None:
        colour = COLOURS[self.lines % len(COLOURS)]
        path = "L".join(f"{self._x(x):.1f} {self._y(y):.1f}" for x, y in points)
        dash = ' stroke-dasharray="6 4"' if dashed else ""
        self.parts.append(f'<path d="M{path}" fill="none" stroke="{colour}" stroke-width="2"{dash}/>')
        at = TOP + 18 + 20 * self.lines
        self.parts.append(f'<path d="M{LEFT + 12} {at - 4}h26" stroke="{colour}" stroke-width="2"{dash}/>')
        self.parts.append(self._words(LEFT + 46, at, name))
        self.lines += 1

    def bar(self, top: float, value: float, height: float, colour: str, words: str) -> None:
        """From 0 to `value`; `top` and `height` on the y axis. The words stand behind it."""
        y, bottom = self._y(top), self._y(top - height)
        self.parts.append(f'<path d="M{LEFT} {y:.1f}H{self._x(value):.1f}V{bottom:.1f}H{LEFT}Z" fill="{colour}"/>')
        self.parts.append(self._words(self._x(value) + 6, (y + bottom) / 2 + 4, words))

    def words(self, x: float, y: float, words: str) -> None:
        self.parts.append(self._words(self._x(x) + 4, self._y(y), words))

    def write(self, file: pathlib.Path) -> None:
        file.write_text("\n".join([*self.parts, "</svg>"]) + "\n", encoding="utf-8")


def shares() -> Axis:
    """Each mark has a tenth of the rest of the one before."""
    last = 4  # 99.99 %
    marks = [(0.0, "0 %"), (0.5, "50 %"), (0.9, "90 %"), (0.99, "99 %"), (0.999, "99.9 %"), (0.9999, "99.99 %")]
    return lambda share: min(-math.log10(max(1 - share, 1e-9)), last) / last, marks


def logarithmic(least: float, most: float) -> Axis:
    steps = [m * 10**e for e in range(6) for m in (1, 2, 5)]
    marks = [(value, f"{value:g}") for value in steps if least <= value <= most]
    span = math.log(most / least)
    return lambda value: min(max(math.log(value / least) / span, 0), 1), marks


def linear(most: float, step: float) -> Axis:
    marks = [(step * i, f"{step * i:g}") for i in range(int(most / step) + 1)]
    return lambda value: min(value / most, 1), marks


def turnaround(curve: dict, file: pathlib.Path) -> str:
    times = [x for points in curve.values() for x, _ in points]
    title = "Turnaround: share of the telegrams that are answered by then"
    chart = Chart(title, logarithmic(min(times) * 0.9, max(times) * 1.1), shares(), "µs", "telegrams")
    for name, points in curve.items():
        chart.line(name, points, dashed=name != "dpslaved")
    chart.write(file)
    return "Turnaround of dpslaved and of the null responder, cumulative"


def refresh(lines: list[dict], file: pathlib.Path) -> str:
    """Two bars for each line: what the frames take, and the cycle."""
    title = "Refresh of 12 values: what the wire takes, and the cycle of the daemon"
    most = max(max(line["wire_ms"], line["cycle_ms"]) for line in lines)
    chart = Chart(title, linear(50 * math.ceil(most / 50 + 1), 50), (lambda place: place, []), "ms", "")
    height = 1 / len(lines)
    for at, line in enumerate(lines):
        top = 1 - at * height
        chart.words(0.0, top - 0.3 * height, line["line"])
        for row, (name, value, colour) in enumerate((("wire", line["wire_ms"], "#8a8a8a"), ("cycle", line["cycle_ms"], COLOURS[0]))):
            chart.bar(top - (0.38 + 0.29 * row) * height, value, 0.25 * height, colour, f"{name} {value:.1f} ms")
    chart.write(file)
    return "Refresh of 12 values on a line, against the time that its frames take"


def write(curves: dict, folder: pathlib.Path) -> list[tuple[str, str]]:
    """Draws what is there. Gives the name of each picture, with what it shows."""
    folder.mkdir(exist_ok=True)
    drawn = []
    if "turnaround" in curves:
        drawn.append(("turnaround.svg", turnaround(curves["turnaround"], folder / "turnaround.svg")))
    if "refresh" in curves:
        drawn.append(("refresh.svg", refresh(curves["refresh"], folder / "refresh.svg")))
    return drawn
