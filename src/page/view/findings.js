// SPDX-License-Identifier: Apache-2.0
// Findings as they stand in every place, each with a way to what mends it.
import { button, h } from './dom.js';

/** What the page calls the fields of the mapping. */
const kFields = {
    ident: 'the field Ident_Number', name: 'the field File name', model: 'the field Model_Name', description: 'the field Description',
    max_tsdr: 'the field MaxTsdr', demand: 'the field Use Demand Data', profile: 'the field Device', table: 'the tag table', list: 'the list',
};

/** Whether a finding has a way to what mends it. */
export function hasWay({ at, field }) {
    return Number.isInteger(at) || kFields[field] !== undefined;
}

/** A list of findings. lead(finding) leads to its parameter or field, where there is one. */
export function findingsList(findings, lead = null) {
    return h('ul', { class: 'findings' }, findings.map((one) => h('li', { class: one.severity, 'data-code': one.code ?? '' },
        h('span', { class: 'severity' }, one.severity), ' ',
        one.line > 0 ? h('span', { class: 'line' }, `line ${one.line}: `) : null, h('span', { 'data-text': '' }, one.text),
        lead && hasWay(one) ? [' ', button('Show', () => lead(one), { more: Number.isInteger(one.at) ? 'the parameter' : kFields[one.field] })] : null)));
}

/** How many findings there are, in the words of the core. */
export function summaryOf(findings) {
    const count = (severity) => findings.filter((one) => one.severity === severity).length;
    const some = (number, word) => `${number} ${word}${number === 1 ? '' : 's'}`;
    return findings.length === 0 ? 'no errors and no warnings' : `${some(count('error'), 'error')}, ${some(count('warning'), 'warning')}`;
}
