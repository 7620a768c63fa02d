// SPDX-License-Identifier: Apache-2.0
// What is printed: the chosen lists and the I/O map, with the hash of the file that they belong to.
import { kDirections, placesOf } from '../mapping/model.js';
import { sentencesOf } from '../questions.js';
import { octetsOf, sha256 } from '../files/octets.js';
import { h } from './dom.js';
import { kTitles } from './lists.js';
import { mapPart } from './octets.js';

function listPart(direction, document, preview) {
    const places = placesOf(document, direction);
    const columns = [['in', 'Octet in'], ['out', 'Octet out']].filter(([key]) => direction === key || direction === 'in-out');
    return h('table', {}, h('caption', {}, `${kTitles[direction]} of the master`),
        h('thead', {}, h('tr', {}, ['Place', 'Tag', 'Parameter', ...columns.map(([, name]) => name)].map((one) => h('th', { scope: 'col' }, one)))),
        h('tbody', {}, places.map((at, place) => {
            const facts = preview.parameters[at];
            const octets = columns.map(([key]) => facts?.[key]?.[0] ?? '');
            return h('tr', {}, [place + 1, document.list[at].tag, facts?.name ?? '', ...octets].map((cell) => h('td', {}, String(cell))));
        })));
}

function hashPart(made) {
    if (!made.octets) return [h('p', {}, 'No file yet, so no hash:'), sentencesOf(made).map((one) => h('p', {}, one))];
    return h('p', { 'data-hash': '' }, `SHA-256 of the file: ${sha256(octetsOf(made.octets))}`);
}

/** Parts of the mapping as they are printed: a set of inputs, outputs, map. The third list counts as both. */
function putPaper(app, parts) {
    const document = app.store.state().history.present;
    const preview = app.ask.preview(document);
    const profile = app.ask.profile(document.profile);
    const wanted = kDirections.filter((one) => placesOf(document, one).length > 0 &&
        ((one !== 'out' && parts.has('inputs')) || (one !== 'in' && parts.has('outputs'))));
    const paper = h('div', { id: 'paper' },
        h('h1', {}, `${document.name}.GSD`), h('p', {}, profile.device),
        document.description ? h('p', {}, document.description) : null,
        document.demand ? h('p', {}, 'With Demand Data.') : null,
        wanted.map((direction) => listPart(direction, document, preview)),
        parts.has('map') ? [h('h2', {}, 'I/O map'), mapPart(preview)] : null,
        hashPart(app.ask.make(document, `${document.name}.GSD`)));
    removePaper();
    window.document.body.append(paper);
}

function removePaper() {
    window.document.getElementById('paper')?.remove();
}

/** Prints parts of the mapping. */
export function print(app, parts) {
    putPaper(app, parts);
    window.print();
}

/** The menu of the browser prints too: then all parts, as they are now. What was printed is not left for the next time. */
export function watchPrint(app) {
    addEventListener('beforeprint', () => {
        if (!window.document.getElementById('paper')) putPaper(app, new Set(['inputs', 'outputs', 'map']));
    });
    addEventListener('afterprint', removePaper);
}
