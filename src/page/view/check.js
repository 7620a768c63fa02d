// SPDX-License-Identifier: Apache-2.0
// Check and compare: the format check of any GSD file, and two files side by side.
import { area, button, checkbox, h } from './dom.js';
import { findingsList, summaryOf } from './findings.js';
import { sentencesOf } from '../questions.js';

const kSides = ['First file', 'Second file'];

function slot(app, side) {
    const input = h('input', { type: 'file', class: 'unseen', tabIndex: -1, 'aria-label': kSides[side], on: {
        change: () => { if (input.files[0]) app.sides.check(input.files[0], side); input.value = ''; } } });
    const name = h('p', { class: 'file-name' });
    const forget = button('Remove', () => app.sides.forget(side), { more: kSides[side] });
    const edit = button('Open for editing', () => app.files.openRead(app.store.state().sides[side]), { more: kSides[side] });
    const element = area(kSides[side], side === 0 ? 'Any GSD file: it is checked.' : 'With a second file, both are compared.', { class: 'card slot', 'data-drop-file': side },
        name, h('div', { class: 'bar' }, button('Choose…', () => input.click(), { more: kSides[side] }), input,
            button('Take the mapping', () => app.sides.checkPresent(side), { more: `as ${kSides[side]}` }), edit, forget));
    return {
        element,
        update(state) {
            const file = state.sides[side];
            name.textContent = file ? file.name : 'Drop a GSD file here.';
            forget.hidden = edit.hidden = !file;
        },
    };
}

function checkPart(app, file, title) {
    const checked = app.ask.check(file);
    const shown = app.ask.show(file);
    const wrong = checked.findings ? shown.refusals : [];
    return h('section', { class: 'card result', 'aria-label': `Check of ${title}` }, h('h2', {}, file.name),
        h('p', { class: checked.exit === 0 ? 'good' : 'bad', 'data-result': checked.exit },
            checked.findings ? `${file.name}: ${summaryOf(checked.findings)}` : sentencesOf(checked).join(' ')),
        file.device.profile ? h('p', { class: 'note' }, `Judged as a file for the profile ${file.device.profile}.`) : null,
        findingsList(checked.findings ?? []),
        shown.lines.length > 0 ? h('pre', { tabIndex: 0, role: 'region', 'aria-label': `What ${title} says` }, shown.lines.join('\n')) : null,
        wrong.map((one) => h('p', {}, one)));
}

function meaningPart(reply) {
    if (reply.same) return null;
    return h('table', { class: 'meaning' }, h('caption', {}, 'What differs in meaning'),
        h('thead', {}, h('tr', {}, ['What', ...kSides].map((one) => h('th', { scope: 'col' }, one)))),
        h('tbody', {}, reply.meaning.map((one) => h('tr', {}, h('th', { scope: 'row' }, one.what), h('td', {}, one.left), h('td', {}, one.right)))));
}

/** Lines of the two files beside each other: those that only one has stand in one row as long as both have some. */
function pairsOf(lines) {
    const pairs = [];
    let left = [], right = [];
    const flush = () => {
        for (let at = 0; at < Math.max(left.length, right.length); ++at) pairs.push([left[at] ?? null, right[at] ?? null]);
        left = [];
        right = [];
    };
    for (const one of lines) {
        if (one.left > 0 && one.right > 0) {
            flush();
            pairs.push([one, one]);
        } else (one.left > 0 ? left : right).push(one);
    }
    flush();
    return pairs;
}

function linesPart(reply, onlyDifferent) {
    const pairs = pairsOf(reply.text).filter(([left, right]) => !onlyDifferent || left !== right);
    const cells = (one, key, mark) => [h('td', { class: 'line' }, one ? String(one[key]) : ''),
        h('td', { class: 'code' }, mark ? h('span', { class: 'mark' }, mark) : null, one ? one.line : '')];
    return h('div', { class: 'wide', tabIndex: 0, role: 'region', 'aria-label': 'Lines of both files' },
        h('table', { class: 'lines' }, h('caption', { class: 'unseen' }, 'Lines of both files'),
            h('thead', {}, h('tr', {}, ['Line', kSides[0], 'Line', kSides[1]].map((one) => h('th', { scope: 'col' }, one)))),
            h('tbody', {}, pairs.map(([left, right]) => h('tr', { class: left === right ? '' : 'differs' },
                cells(left, 'left', left && left !== right ? '− ' : ''), cells(right, 'right', right && left !== right ? '+ ' : ''))))));
}

function comparePart(app, sides) {
    const reply = app.ask.diff(...sides);
    if (!reply.text) return h('section', { class: 'card result', 'aria-label': 'Comparison' }, sentencesOf(reply).map((one) => h('p', { class: 'bad' }, one)));
    const lines = h('div', {});
    const only = checkbox('Only the lines that differ', !reply.same, (checked) => lines.replaceChildren(linesPart(reply, checked)));
    lines.append(linesPart(reply, !reply.same));
    return h('section', { class: 'card result', 'aria-label': 'Comparison', 'data-same': String(reply.same) }, h('h2', {}, 'Comparison'),
        h('p', {}, reply.same ? 'The files say the same.' : 'The files say different things.'), meaningPart(reply), only.row, lines);
}

/** The view of the screen. */
export function checkView(app) {
    const slots = kSides.map((_, side) => slot(app, side));
    const results = h('div', { class: 'results' });
    let shown = null;
    return {
        element: h('div', { class: 'check-screen' }, h('div', { class: 'slots' }, slots.map((one) => one.element)), results),
        update(state) {
            if (shown === state.sides) return;
            shown = state.sides;
            for (const one of slots) one.update(state);
            results.replaceChildren(...[
                shown.every(Boolean) ? comparePart(app, shown) : null,
                ...shown.map((file, side) => (file ? checkPart(app, file, kSides[side]) : null)),
            ].filter(Boolean));
        },
    };
}
