# SPDX-License-Identifier: Apache-2.0
"""The page as a user has it: parts by role and name, pointer, keys, files. Given to each test as a fresh page."""
import base64
import pathlib
import subprocess
import tempfile
import unittest

import setting

KEYS = {"Enter": "\ue007", "Tab": "\ue004", "Shift": "\ue008", "Control": "\ue009", "Alt": "\ue00a", "Escape": "\ue00c",
        "Space": " ", "Left": "\ue012", "Up": "\ue013", "Right": "\ue014", "Down": "\ue015", "Delete": "\ue017",
        "Home": "\ue011", "End": "\ue010", "F10": "\ue03a"}

FIND = """
    const roles = {
        button: 'button:not([role]), [role=button]', textbox: 'input[type=text], input:not([type]), textarea',
        searchbox: 'input[type=search]', checkbox: 'input[type=checkbox]', combobox: 'select', option: '[role=option]',
        listbox: '[role=listbox]', tab: '[role=tab]', menuitem: '[role=menuitem]', region: 'section[aria-label], [role=region]',
        alert: '[role=alert]', status: '[role=status]', dialog: 'dialog[open]', menu: '[role=menu]', file: 'input[type=file]',
    };
    const text = (element) => {
        if (!element) return '';
        const copy = element.cloneNode(true);
        for (const part of copy.querySelectorAll('[aria-hidden=true]')) part.remove();
        return copy.textContent.replace(/\\s+/g, ' ').trim();
    };
    const named = (element) => element.getAttribute('aria-label')
        ?? (element.getAttribute('aria-labelledby') ?? '').split(' ').filter(Boolean).map((id) => text(document.getElementById(id))).join(' ')
        || (element.labels && element.labels.length ? text(element.labels[0]) : '') || text(element);
    const seen = (element) => element.getClientRects().length > 0 || element.type === 'file';
    const find = (role, name, within) => {
        const all = [...(within ? find('region', within) : document).querySelectorAll(roles[role])];
        const found = all.filter((element) => seen(element) && (name === undefined || name === null || named(element) === name));
        const starts = all.filter((element) => seen(element) && name && named(element).startsWith(name));
        const one = found[0] ?? starts[0];
        if (!one) throw new Error(`no ${role} "${name}" among: ${all.filter(seen).map(named).slice(0, 60).join(' | ')}`);
        return one;
    };
    const at = (element) => {
        element.scrollIntoView({ block: 'nearest' });
        const { left, top, width, height } = element.getBoundingClientRect();
        return { x: Math.round(left + width / 2), y: Math.round(top + height / 2), top: Math.round(top), bottom: Math.round(top + height) };
    };
""".replace("?? (element.getAttribute('aria-labelledby')", "|| (element.getAttribute('aria-labelledby')")


class PageTest(unittest.TestCase):
    """Opens a fresh page for each test; nothing is left of the test before."""

    maxDiff = 4000

    def setUp(self):
        self.browser = setting.browser
        self.browser.release_buttons()
        if self.browser.name == "chromium":
            self.browser.messages()  # those of the test before
        self.open()
        self.addCleanup(self.forget)

    def open(self):
        self.browser.open_page(setting.page)
        self.browser.run("""
            globalThis.addEventListener('error', (event) => { globalThis.failed = event.message; });
            globalThis.addEventListener('unhandledrejection', (event) => { globalThis.failed = String(event.reason); });
            globalThis.showSaveFilePicker = undefined;
            return 1""")

    def forget(self):
        failed = self.browser.run("localStorage.clear(); return globalThis.failed ?? null")
        self.assertIsNone(failed, "an error in the page")
        if self.browser.name == "chromium":
            self.assertEqual(self.browser.messages(), [], "what the page wrote to the console")

    # ---- what is there

    def js(self, body, *words):
        return self.browser.run(FIND + body, *words)

    def shown(self, role, name=None, within=None):
        """Whether such a part is to be seen."""
        return self.js("try { find(...words); return true; } catch { return false; }", role, name, within)

    def text(self, role, name=None, within=None):
        return self.js("return find(...words).innerText", role, name, within)

    def value(self, role, name):
        return self.js("return find(...words).value", role, name)

    def names(self, role, within=None):
        return self.js("return [...(words[1] ? find('region', words[1]) : document).querySelectorAll(roles[words[0]])]"
                       ".filter(seen).map(named)", role, within)

    def tags(self, title):
        """The tags of the rows of a list: "Inputs", "Outputs", "Read and write" or "Parameters"."""
        return self.js("return [...document.querySelectorAll(`[role=listbox][aria-label='${words[0]}'] [role=option]`)]"
                       ".map((row) => Number(row.dataset.tag))", title)

    def said(self):
        return self.text("status")

    def notice(self):
        return self.js("return [...document.querySelectorAll('[role=alert]')].map((one) => one.innerText).join(' ').trim()")

    # ---- the pointer

    def act(self, *actions):
        self.browser.act({"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": list(actions)})

    def _to(self, place, key="y"):
        return {"type": "pointerMove", "x": place["x"], "y": place[key], "duration": 0}

    def place(self, *words):
        return self.js("return at(find(...words))", *words)

    def row_place(self, title, tag):
        return self.js("return at(document.querySelector(`[role=listbox][aria-label='${words[0]}'] [data-tag='${words[1]}']`))",
                       title, tag)

    def press(self, place, button=0, times=1):
        self.act(self._to(place), *[{"type": kind, "button": button} for _ in range(times) for kind in ("pointerDown", "pointerUp")])

    def click(self, role, name=None, within=None):
        self.press(self.place(role, name, within))

    def drag(self, start, end):
        """From a place to the point (x, y)."""
        x, y = end
        self.act(self._to(start), {"type": "pointerDown", "button": 0},
                 {"type": "pointerMove", "x": start["x"] + 8, "y": start["y"] + 4, "duration": 20},
                 {"type": "pointerMove", "x": x, "y": y - 2, "duration": 40},
                 {"type": "pointerMove", "x": x, "y": y, "duration": 20}, {"type": "pointerUp", "button": 0})

    # ---- the keyboard

    def keys(self, *words):
        """Each word: keys held down together, as in "Control+Shift+s"; or "=text" to be typed."""
        actions = []
        for word in words:
            if word.startswith("="):
                actions += [{"type": kind, "value": letter} for letter in word[1:] for kind in ("keyDown", "keyUp")]
                continue
            held = [KEYS.get(key, key) for key in word.split("+")]
            actions += [{"type": "keyDown", "value": key} for key in held]
            actions += [{"type": "keyUp", "value": key} for key in reversed(held)]
        self.browser.act({"type": "key", "id": "keyboard", "actions": actions})

    def focus(self, role, name=None, within=None):
        self.js("find(...words).focus()", role, name, within)

    def tab_to(self, role, name):
        """Presses Tab until the part has the focus: it can be reached so."""
        for _ in range(120):
            if self.js("return document.activeElement === find(...words)", role, name):
                return
            self.keys("Tab")
        raise AssertionError(f"Tab does not reach {role} {name}")

    def type_into(self, role, name, text):
        self.js("const one = find(...words); one.focus(); one.select()", role, name)
        self.keys("Delete", *([f"={text}"] if text else []))

    def choose(self, name, value):
        """In a list to choose from, as the browser does it for pointer and keyboard."""
        self.js("const one = find('combobox', words[0]); one.value = words[1];"
                "one.dispatchEvent(new Event('input', { bubbles: true })); one.dispatchEvent(new Event('change', { bubbles: true }))",
                name, value)

    # ---- files

    def choose_file(self, trigger, path):
        """What `trigger` opens is answered with a file."""
        self.js("""globalThis.wanted = null;
            document.addEventListener('click', (event) => {
                if (event.target.type !== 'file') return;
                event.preventDefault();
                globalThis.wanted = event.target;
            }, { capture: true, once: false })""")
        trigger()
        self.browser.wait_for("return globalThis.wanted !== null", what="the question for a file")
        self.browser.give_files("return globalThis.wanted", pathlib.Path(path).resolve())

    def drop(self, files, onto="main"):
        """Drops files: (name, octets) or (name, number of octets)."""
        given = [(name, what if isinstance(what, int) else base64.b64encode(what).decode()) for name, what in files]
        self.js("""
            const data = new DataTransfer();
            for (const [name, what] of words[0]) {
                const octets = typeof what === 'number' ? new Uint8Array(what).fill(65)
                    : Uint8Array.from(atob(what), (one) => one.charCodeAt(0));
                data.items.add(new File([octets], name));
            }
            const target = document.querySelector(words[1]);
            for (const kind of ['dragenter', 'dragover', 'drop'])
                target.dispatchEvent(new DragEvent(kind, { bubbles: true, cancelable: true, dataTransfer: data }));
            await new Promise((done) => setTimeout(done, 0));""", given, onto)

    def wait_said(self, part):
        self.browser.wait_for("return document.getElementById('said').textContent.includes(words[0])"
                              " || [...document.querySelectorAll('[role=alert]')].some((one) => one.textContent.includes(words[0]))",
                              part, what=f"the sentence {part!r}")

    def saved(self, trigger):
        """What `trigger` gives to the downloads: (name, octets)."""
        self.js("""globalThis.given = [];
            globalThis.makeAddress ??= URL.createObjectURL;
            URL.createObjectURL = (blob) => { globalThis.blob = blob; return globalThis.makeAddress.call(URL, blob); };
            globalThis.addEventListener('click', (event) => {
                const link = event.target.closest?.('a[download]');
                if (!link) return;
                event.preventDefault();
                globalThis.given.push([link.download, globalThis.blob]);
            }, { capture: true })""")
        trigger()
        self.browser.wait_for("return globalThis.given.length > 0", what="a download")
        name, octets = self.browser.run("""const [name, blob] = globalThis.given[0];
            return [name, btoa(String.fromCharCode(...new Uint8Array(await blob.arrayBuffer())))]""")
        return name, base64.b64decode(octets)

    def copied(self, trigger):
        """The text that `trigger` puts into the clipboard."""
        self.js("""globalThis.copy = null;
            Object.defineProperty(navigator.clipboard, 'writeText', { configurable: true,
                value: async (text) => { globalThis.copy = text; } })""")
        trigger()
        return self.browser.wait_for("return globalThis.copy", what="a copied text")


def dpctl(*words, text=None):
    """What dpctl prints, in octets; `text` goes into the file that "FILE" stands for."""
    with tempfile.TemporaryDirectory() as folder:
        if text is not None:
            pathlib.Path(folder, "file").write_bytes(text)
        words = [str(pathlib.Path(folder, "file")) if word == "FILE" else word for word in words]
        return subprocess.run([setting.dpctl, *words, "--profiles", setting.root / "config/profiles"],
                              capture_output=True, timeout=60, check=True).stdout
