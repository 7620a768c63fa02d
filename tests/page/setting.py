# SPDX-License-Identifier: Apache-2.0
"""What run.py was told: the page, the programs, the browser that is running, the seed."""
import pathlib

root = pathlib.Path(__file__).resolve().parents[2]
page = None
other_page = None
dpctl = None
axe = None
browser = None
seed = 0
pictures = None
