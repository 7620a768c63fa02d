// SPDX-License-Identifier: Apache-2.0
// What the table says of the parameter that is chosen in the tree.
import { h } from './dom.js';

const kAccess = { read_only: 'read only', read_write: 'read and write', write_only: 'write only', unknown: 'access not known' };

/** How a parameter may be used, in a few words. */
export function accessText(tag) {
    const access = tag.access === 'unknown' ? '' : kAccess[tag.access];
    return [access, tag.never_written ? 'never written' : '', tag.when ? `written when ${tag.when}` : ''].filter(Boolean).join(', ');
}

/** The Demand Data tag of a parameter. `tag` is null where it is in no table. */
export function demandText(tag) {
    if (!tag) return 'Demand Data tag: not in the table';
    return tag.demand === null ? 'No Demand Data tag' : `Demand Data tag: ${tag.demand}`;
}

function rangeText({ min, max }) {
    if (min === null && max === null) return null;
    return `${min ?? '…'} to ${max ?? '…'}`;
}

const labelsText = (tag) => tag.labels.map((one) => `${one.bit ? 'bit ' : ''}${one.number}: ${one.text}`).join('; ');
const kNoRange = 'not in the table';

/** Type, range and values of a parameter in one line. `tag` is null where it is in no table. */
export function shortText(tag) {
    if (!tag) return 'In no table: type, range and values are not known.';
    const labels = labelsText(tag);
    return [`Type ${tag.type || 'not in the table'}`, `range ${rangeText(tag) ?? kNoRange}`, labels && `values ${labels}`].filter(Boolean).join(' · ');
}

function decimalsText(tag) {
    if (tag.follows_display) return 'those of the display';
    return tag.decimals === null ? null : String(tag.decimals);
}

/** The facts of a parameter as a list. */
export function aboutPart(tag) {
    if (!tag) return h('p', { class: 'note' }, 'Choose a parameter: what the table says of it stands here.');
    const facts = [
        ['Type', tag.type], ['Range', rangeText(tag) ?? kNoRange], ['Values', labelsText(tag)], ['Access', accessText(tag) || kAccess[tag.access]],
        ['Decimals', decimalsText(tag)], ['Demand Data tag', tag.demand === null ? 'none' : String(tag.demand)], ['List', tag.section], ['Notes', tag.notes],
    ].filter(([, text]) => text);
    return h('div', {}, h('h3', {}, `${tag.number} ${tag.name}`),
        h('dl', {}, facts.map(([name, text]) => h('div', {}, h('dt', {}, name), h('dd', {}, text)))));
}
