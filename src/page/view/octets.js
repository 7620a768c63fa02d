// SPDX-License-Identifier: Apache-2.0
// The octets of the telegrams. Each parameter has a number and a colour, the same everywhere.
import { hex } from '../files/octets.js';
import { kTitles } from './lists.js';
import { h, hueOf } from './dom.js';

/** What each octet of a telegram belongs to: the parameter's number, "D" for Demand Data, "" for others. */
export function ownersOf(preview, telegram) {
    const owner = preview[telegram].map(() => '');
    const own = (pair, number) => { if (pair) owner.fill(number, pair[0], pair[0] + pair[1]); };
    own(preview.demand?.[telegram], 'D');
    preview.parameters.forEach((one, at) => own(one[telegram], at + 1));
    return owner;
}

/** Runs of octets by what they belong to: {octets, number}. */
function runsOf(octets, owner) {
    const runs = [];
    octets.forEach((octet, at) => {
        const last = runs[runs.length - 1];
        if (last && last.number === owner[at]) last.octets.push(octet);
        else runs.push({ octets: [octet], number: owner[at] });
    });
    return runs;
}

function strip(title, preview, telegram) {
    const octets = preview[telegram];
    const text = octets.length === 0 ? 'no octets' : `${octets.length} octet${octets.length === 1 ? '' : 's'}`;
    return [h('h3', {}, title, ' ', h('span', { class: 'count' }, text)),
        h('p', { class: 'octets' }, runsOf(octets, ownersOf(preview, telegram)).map(({ octets: run, number }) =>
            h('span', { class: `chip ${number === '' ? 'hue' : hueOf(number)}` },
                h('span', { class: 'of' }, number === '' ? '·' : String(number)), ' ', run.map(hex).join(' '), ' ')))];
}

const range = (pair) => (pair ? (pair[1] === 1 ? `${pair[0]}` : `${pair[0]}–${pair[0] + pair[1] - 1}`) : '');

/** The octets of a preview: Set_Prm, Chk_Cfg, and each parameter's part of them. */
export function octetsPart(preview) {
    const numbered = preview.parameters.map((one, at) => ({ ...one, number: at + 1 }));
    const row = (number, hue, cells) => h('tr', {}, h('td', {}, h('span', { class: hue }, String(number))), cells.map((cell) => h('td', {}, cell)));
    return h('div', {},
        strip('Set_Prm: User_Prm_Data', preview, 'set_prm'),
        strip('Chk_Cfg', preview, 'chk_cfg'),
        h('table', {}, h('caption', { class: 'unseen' }, 'Octets of each parameter'),
            h('thead', {}, h('tr', {}, ['No.', 'Parameter', 'Set_Prm', 'Chk_Cfg', 'Input', 'Output'].map((one) => h('th', { scope: 'col' }, one)))),
            h('tbody', {},
                preview.demand ? row('D', hueOf('D'), ['Demand Data', '', range(preview.demand.chk_cfg), range(preview.demand.in), range(preview.demand.out)]) : null,
                numbered.map((one) => row(one.number, hueOf(one.number),
                    [`${one.tag} ${one.name || ''}`, range(one.set_prm), range(one.chk_cfg), range(one.in), range(one.out)])))));
}

function mapTable(direction, values, preview) {
    const key = direction;
    if (values.length === 0) return h('p', {}, `${kTitles[direction]}: none.`);
    const number = (octet) => preview.parameters.findIndex((one) => one[key] && octet >= one[key][0] && octet < one[key][0] + one[key][1]) + 1;
    return h('table', {}, h('caption', {}, kTitles[direction]),
        h('thead', {}, h('tr', {}, ['No.', 'Octets', 'Tag', 'What'].map((one) => h('th', { scope: 'col' }, one)))),
        h('tbody', {}, values.map((one) => h('tr', {},
            h('td', {}, h('span', { class: hueOf(one.demand ? 'D' : number(one.octet)) }, one.demand ? 'D' : String(number(one.octet) || '·'))),
            h('td', {}, range([one.octet, one.octets])), h('td', {}, one.tag === null ? '' : String(one.tag)), h('td', {}, one.what)))));
}

const kNoMap = 'The tool of the master puts the modules together, so there is no map yet.';
const kTooLong = 'The mapping does not fit into a telegram: see the findings.';

/** The I/O map of a preview as tables. */
export function mapPart(preview) {
    if (!preview.map) return h('p', {}, kTooLong);
    if (!preview.map.fixed) return h('p', {}, kNoMap);
    return h('div', { class: 'maps' },
        h('p', { class: 'count' }, `${preview.map.in_octets} octets in, ${preview.map.out_octets} octets out`),
        mapTable('in', preview.map.inputs, preview), mapTable('out', preview.map.outputs, preview));
}

/** The I/O map as text, for the clipboard. */
export function mapText(preview) {
    if (!preview.map) return kTooLong;
    if (!preview.map.fixed) return kNoMap;
    const lines = (title, values) => [`${title}\tTag\tWhat`, ...values.map((one) => `${range([one.octet, one.octets])}\t${one.tag ?? ''}\t${one.what}`)];
    return [...lines('Input octets', preview.map.inputs), '', ...lines('Output octets', preview.map.outputs)].join('\r\n') + '\r\n';
}

/** Set_Prm and Chk_Cfg as text, for the clipboard. */
export function octetsText(preview) {
    return `Set_Prm\t${preview.set_prm.map(hex).join(' ')}\r\nChk_Cfg\t${preview.chk_cfg.map(hex).join(' ')}\r\n`;
}
