# SPDX-License-Identifier: Apache-2.0
"""Random mapping files: most of them right in their form, many refused for what they ask."""
import json

DIRECTIONS = ["in", "out", "in-out"]
LETTERS = ["a", "Z", "7", " ", "\"", ";", "\\", "ü", "Ã", "=", "#", "'", "Ω", "¼", "<b>"]
WRONG_LINES = ["list = 7", "in = [0]", "out = [65536]", "ident = \"x\"", "demand = 1", "max_tsdr = -1", "profile = ", "unknown = 1",
               "in = [1, 1]", "list = [\"on:1\"]", "model = \"\\u0001\"", "[table]", "description = 'a", "description = \"a\\tb\"", "ident = 0", "in = 1.5"]
WRONG_ROWS = ["", "7", "x,y,z,", "7,a,b,c,d", "\"7", "tag,name,type,access", "65536,a,INT,", "1,a\tb,INT,"]


def text(random, longest):
    return "T" + "".join(random.choice(LETTERS) for _ in range(random.randrange(longest)))


def tag(random, profile, rows):
    if random.randrange(400) == 0:
        return random.randint(1, 65535)
    if rows and (profile["only_listed_tags"] or random.randrange(10)):
        return random.choice(rows)["number"]
    return random.randint(1, profile["max_tag"])


def parameters(random, profile, rows):
    most = random.choice([3, 12, 12, 30, 60, 130])
    if random.randrange(8):
        most = min(most, profile["max_parameters"])
    directions = DIRECTIONS if random.randrange(16) == 0 else profile["lists"]
    chosen, used = [], set()
    for _ in range(random.randint(0, most)):
        row = tag(random, profile, rows)
        direction = random.choice(directions)
        writable = next((one["writable"] for one in rows if one["number"] == row), True)
        if not writable and random.randrange(50) and "in" in directions:
            direction = "in"
        if row in used and random.randrange(100):
            continue
        used.add(row)
        chosen.append((direction, row))
    return chosen


def own_table(random, chosen):
    """The lines of a tag table of the user's own with the chosen tags, in the form of a mapping file."""
    cells = [(str(row), text(random, 30), random.choice(["INT", "WORD", "BOOL", "STRING"]), random.choice(["", "ro", "rw", "wo"]))
             for row in sorted({row for _, row in chosen})]
    lines = ["tag,name,type,access"]
    lines += [",".join(['"' + cell.replace('"', '""') + '"' for cell in one]) for one in cells]
    if random.randrange(10) == 0:
        lines.insert(random.randrange(len(lines) + 1), random.choice(WRONG_ROWS))
    rows = "\n".join(lines).replace("\\", "\\\\").replace('"""', '""\\"')
    return ["[table]", f'file = {json.dumps(text(random, 8) + ".csv", ensure_ascii=False)}', f'rows = """\n{rows}\n"""']


def mapping_file(random, profile, rows):
    """The text of a mapping file for `profile` (as the call "profiles" has it), with its tags `rows`."""
    lines = [f"profile = {json.dumps(profile['name'])}"]
    chosen = parameters(random, profile, rows)
    if random.randrange(2):
        lines.append("list = [" + ", ".join(f'"{direction}:{row}"' for direction, row in chosen) + "]")
    else:
        for direction in DIRECTIONS:
            of_it = [str(row) for one, row in chosen if one == direction]
            if of_it or random.randrange(10) == 0:
                lines.append(f"{direction.replace('-', '_')} = [{', '.join(of_it)}]")
    if random.randrange(3) == 0:
        lines.append(f"demand = {random.choice(['true', 'true', 'false'])}")
    if (profile["ident"] is None and random.randrange(20)) or random.randrange(4) == 0:
        lines.append(f"ident = {random.randint(1, 0xFFFF)}")
    if random.randrange(4) == 0:
        lines.append(f"max_tsdr = {random.choice([11, 60, 400, 800, random.randint(11, 65535)])}")
    if random.randrange(3) == 0:
        lines.append(f"description = {json.dumps(text(random, 40), ensure_ascii=False)}")
    if random.randrange(3) == 0:
        lines.append(f"model = {json.dumps(text(random, 24), ensure_ascii=False)}")
    if random.randrange(4) == 0:
        lines += own_table(random, chosen)
    if random.randrange(25) == 0:
        lines.insert(random.randrange(len(lines) + 1), random.choice(WRONG_LINES))
    return "\n".join(lines) + "\n"
