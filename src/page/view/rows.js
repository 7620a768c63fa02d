// SPDX-License-Identifier: Apache-2.0
// One row of a list of the mapping: the parameter, its number in the telegram, and what is wrong with it.
import { h, hueOf } from './dom.js';

/** Where a parameter is in the telegrams. */
function octetText(facts) {
    if (facts?.in && facts.out) return `octet ${facts.in[0]} in, ${facts.out[0]} out`;
    const pair = facts?.in ?? facts?.out;
    return pair ? `octet ${pair[0]}` : '';
}

/** The row of the parameter at `at`. `list` makes its id one of its own, `place` is its place in that list, from 0. */
export function entryRow(preview, document, at, { list, place, about = '' }) {
    const { tag } = document.list[at];
    const found = preview.findings.filter((one) => one.at === at);
    const facts = preview.parameters[at];
    const octets = [about, octetText(facts)].filter(Boolean).join(', ');
    const severity = found.some((one) => one.severity === 'error') ? 'error' : 'warning';
    return h('div', {
        role: 'option', id: `${list}-${at}-${tag}`, class: found.length > 0 ? `row ${severity}` : 'row',
        'aria-selected': 'false', 'data-at': at, 'data-tag': tag, title: found.map((one) => one.text).join(' '),
    },
    h('span', { class: 'grip', 'aria-hidden': 'true' }, '⠿'),
    h('span', { class: 'unseen' }, `${place + 1}.`),
    h('span', { class: hueOf(at + 1), 'aria-hidden': 'true' }, String(at + 1)),
    h('span', { class: 'number' }, String(tag)),
    h('span', { class: 'name' }, facts?.name || `tag ${tag}`),
    found.length > 0 ? h('span', { class: 'severity' }, severity) : null,
    octets ? h('span', { class: 'about' }, octets) : null);
}
