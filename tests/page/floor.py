# SPDX-License-Identifier: Apache-2.0
"""What Chrome 109 or Firefox 115, the newest browsers of Windows 7, do not have: no browser of Debian would say so.

esbuild lowers the language, not the interfaces. Each row is a pattern and a sample that it has to find; the test gives it
that sample (test_floor.py). In brackets: the first version of Chrome and of Firefox.
"""
import re

SCRIPT = [
    (r"\.(toSorted|toReversed|toSpliced)\(", "list.toSorted()"),  # 110, 115
    (r"\.with\(", "list.with(0, 1)"),  # 110, 115
    (r"\bArray\.fromAsync\b", "Array.fromAsync(list)"),  # 121, 115
    (r"\b(Object|Map)\.groupBy\b", "Object.groupBy(list, of)"),  # 117, 119
    (r"\bURL\.(canParse|parse)\b", "URL.canParse(text)"),  # 120, 115
    (r"\bPromise\.(withResolvers|try)\b", "Promise.withResolvers()"),  # 119, 121
    (r"\.(isSubsetOf|isSupersetOf|isDisjointFrom|symmetricDifference)\(", "some.isSubsetOf(all)"),  # 122, 127
    (r"\.(union|intersection|difference)\(", "some.union(others)"),  # 122, 127
    (r"\bIterator\b", "Iterator.from(list)"),  # 122, 131
    (r"\.(values|keys|entries)\(\)\s*\.(map|filter|take|drop|flatMap|reduce|toArray|forEach|some|every|find)\(",
     "map.values().map(of)"),  # 122, 131
    (r"\.toArray\(", "steps.toArray()"),  # 122, 131
    (r"\.(isWellFormed|toWellFormed)\(", "text.isWellFormed()"),  # 111, 119
    (r"\bAtomics\.waitAsync\b", "Atomics.waitAsync(a, 0, 0)"),  # 87, 145
    (r"\.(transferToFixedLength|resizable|maxByteLength)\b", "buffer.maxByteLength"),  # 111, 128
    (r"\.buffer\.transfer\(", "octets.buffer.transfer()"),  # 114, 122
    (r"\.(fromBase64|toBase64|fromHex|toHex|setFromBase64)\(", "Uint8Array.fromBase64(text)"),  # 140, 133
    (r"\bRegExp\.escape\b", "RegExp.escape(text)"),  # 136, 134
    (r"/[dgimsuy]*v[dgimsuy]*\.(test|exec)\(|RegExp\([^()]*,\s*['\"`][dgimsuy]*v", "/[\\p{L}--[a-z]]/v.test(text)"),  # 112, 116
    (r"\bIntl\.(Segmenter|DurationFormat)\b", "new Intl.Segmenter('en')"),  # 87, 125
    (r"\bError\.isError\b", "Error.isError(one)"),
    (r"\bMath\.(sumPrecise|f16round)\b", "Math.sumPrecise(list)"),
    (r"\bFloat16Array\b", "new Float16Array(1)"),  # 135, 129
    (r"\bJSON\.(rawJSON|isRawJSON)\b", "JSON.rawJSON('1')"),  # 114, 135
    (r"[pP]opover", "menu.showPopover()"),  # 114, 125
    (r"beforeunload(?![\s\S]{0,600}returnValue)", "addEventListener('beforeunload', (event) => event.preventDefault())"),  # Chrome 119
    (r"\b(commandForElement|commandfor)\b", "button.commandForElement = menu"),  # 135, 144
    (r"\bAbortSignal\.any\b", "AbortSignal.any(list)"),  # 116, 124
    (r"\bscheduler\.", "scheduler.yield()"),  # 94, 142
    (r"\bClipboardItem\b", "new ClipboardItem({})"),  # 76, 127
    (r"\bclipboard\.(readText|read|write)\(", "navigator.clipboard.readText()"),  # 66, 125
    (r"\bstartViewTransition\b", "document.startViewTransition(go)"),  # 111, 144
    (r"\b(setHTML|setHTMLUnsafe|parseHTML|parseHTMLUnsafe|getHTML)\(", "part.setHTMLUnsafe(text)"),  # 124, 123
    (r"\bSanitizer\b", "new Sanitizer({})"),
    (r"\bCloseWatcher\b", "new CloseWatcher()"),  # 126, none
    (r"\.moveBefore\(", "list.moveBefore(one, two)"),  # 133, 144
    (r"\.requestClose\(", "dialog.requestClose()"),  # 134, 139
    (r"scrollend\b", "part.onscrollend = go"),  # 114, 109
    (r"beforetoggle\b", "part.onbeforetoggle = go"),  # 114, 114
    (r"\bURLPattern\b", "new URLPattern()"),  # 95, 142
    (r"\buserAgentData\b", "navigator.userAgentData"),  # 90, none
    (r"\bCSS\.highlights\b", "CSS.highlights.clear()"),  # 105, 140
    (r"\bcaretPositionFromPoint\b", "document.caretPositionFromPoint(0, 0)"),  # 128, 20
    (r"\b(attributeStyleMap|computedStyleMap)\b", "part.attributeStyleMap.clear()"),  # 66, none
    (r"\bwindow\.navigation\b", "window.navigation.back()"),  # 102, 147
    (r"\bReadableStream\.from\b", "ReadableStream.from(list)"),  # none, 117
    (r"\bfor await\b", "for await (const part of stream) use(part)"),  # streams: 124, 110
    (r"\.bytes\(\)", "blob.bytes()"),  # 132, 128
    (r"\bscrollIntoViewIfNeeded\b", "part.scrollIntoViewIfNeeded()"),  # no standard
    (r"\bgetAsFileSystemHandle\b", "item.getAsFileSystemHandle()"),  # 86, none
    (r"\bEditContext\b", "new EditContext()"),  # 121, none
    (r"\bEyeDropper\b", "new EyeDropper()"),  # 95, none
]
STYLE = [
    (r":has\(", "a:has(b) { color: red }"),  # 105, 121
    (r"\blight-dark\(", "a { color: light-dark(red, blue) }"),  # 123, 120
    (r"\bcolor-mix\(", "a { color: color-mix(in srgb, red, blue) }"),  # 111, 113
    (r"\b(oklch|oklab|lch|lab|color)\((?=[\d.a-z])", "a { color: oklch(0.5 0.1 20) }"),  # 111, 113
    (r"\b(rgb|hsl)\(from ", "a { color: rgb(from red r g b) }"),  # 119, 128
    (r"@(property|scope|starting-style|position-try|view-transition|function)\b", "@scope (a) { b { color: red } }"),
    (r"\bsubgrid\b", "a { grid-template-columns: subgrid }"),  # 117, 71
    (r"\btext-wrap\b", "a { text-wrap: balance }"),  # 114, 121
    (r"\bwhite-space-collapse\b", "a { white-space-collapse: preserve }"),  # 114, 124
    (r"\bfield-sizing\b", "a { field-sizing: content }"),  # 123, none
    (r"\banchor(-name|-scope)?\s*[:(]", "a { anchor-name: --b }"),  # 125, 147
    (r"\b(interpolate-size|calc-size)\b", "a { interpolate-size: allow-keywords }"),  # 129, none
    (r"\bscrollbar-(color|width)\b", "a { scrollbar-width: thin }"),  # 121, 64
    (r":(popover-open|user-valid|user-invalid|open|state\(|dir\()", "a:popover-open { color: red }"),
    (r"\d(r?lh|cap|ric|rex|rch)\b", "a { height: 2lh }"),  # 109 and 111, 120
    (r"(?<![-\w])(round|mod|rem|abs|sign)\(", "a { width: round(1.5px, 1px) }"),  # 125, 118
    (r"\blinear\(", "a { transition: left 1s linear(0, 1) }"),  # 113, 112
    (r"(?<![-\w])mask(-image|-size)?\s*:", "a { mask: none }"),  # 120, 53
    (r"(?<!-)\bprint-color-adjust\b", "a { print-color-adjust: exact }"),  # 136, 97: with -webkit- beside it
    (r"(?<![-\w])zoom\s*:", "a { zoom: 2 }"),  # 1, 126
    (r"\bview-transition-name\b", "a { view-transition-name: b }"),  # 111, 144
    (r"\b(animation-timeline|scroll-timeline|transition-behavior|allow-discrete)\b", "a { animation-timeline: --b }"),
    (r"@media[^{]*\b(scripting|prefers-reduced-transparency|inverted-colors)\b", "@media (scripting) { a { color: red } }"),
]
ELEMENTS = [
    (r"\bpopover(target)?\b", "<p popover>"),  # 114, 125
    (r"<search\b", "<search>"),  # 118, 118
    (r"<details[^>]*\bname=", "<details name=\"one\">"),  # 120, 130
    (r"<dialog[^>]*\bclosedby=", "<dialog closedby=\"any\">"),  # 134, 141
    (r"<selectedcontent\b", "<selectedcontent>"),
    (r"\bcommandfor=", "<button commandfor=\"one\">"),  # 135, 144
]


def found(rows, text):
    """What of `rows` stands in `text`: the places, each with what is around it."""
    places = []
    for pattern, _ in rows:
        for hit in re.finditer(pattern, text, re.MULTILINE):
            places.append(text[max(0, hit.start() - 30):hit.end() + 30].replace("\n", " "))
    return places


def nested_rules(style):
    """Rules of a style that stand in another rule: Chrome 112 and Firefox 117 are the first to read them."""
    plain = re.sub(r"/\*.*?\*/|\"[^\"]*\"|'[^']*'", "", style, flags=re.DOTALL)
    places, open_blocks = [], []
    for piece in re.findall(r"[^{};]*[{};]", plain):
        if piece.endswith("}"):
            open_blocks.pop()
        elif piece.endswith("{"):
            if open_blocks and not open_blocks[-1]:
                places.append(piece.strip())
            open_blocks.append(piece.strip().startswith("@"))  # @media and its like hold rules
    return places
