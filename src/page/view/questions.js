// SPDX-License-Identifier: Apache-2.0
// The dialogs of the page: which profile, save as, replace and delete in the library, print.
import { kKinds } from '../actions/saving.js';
import { whyNoStation } from '../mapping/station.js';
import { ask } from './dialog.js';
import { checkbox, field, h } from './dom.js';

/** Which of several profiles a file is for. */
export function chooseProfile(name, sentences, candidates, ofProfile) {
    const { row, input } = field('Device', h('select', {}, candidates.map((one) =>
        h('option', { value: one }, `${one}: ${ofProfile(one)?.device ?? ''}`))));
    return ask(`Which device is ${name} for?`, [sentences.map((one) => h('p', {}, one)), row], [{ text: 'Open', value: () => input.value }]);
}

function stationFields(document, profile) {
    const name = field('Station name', h('input', { type: 'text', value: 'station-1' }));
    const address = field('PROFIBUS address', h('input', { type: 'text', inputMode: 'numeric', class: 'short' }), `${profile.min_address} to ${profile.max_address}`);
    const line = field('Drive line', h('input', { type: 'text', value: 'p3' }), 'Its name in [[line]]');
    const unit = field('Unit on that line', h('input', { type: 'text', class: 'short' }), 'As the profile has it: 00 or 1');
    const parts = h('div', { class: 'fields' }, name.row, address.row, line.row, unit.row);
    return {
        parts,
        value: () => ({ name: name.input.value.trim(), address: address.input.value, line: line.input.value.trim(), unit: unit.input.value.trim() }),
        valid() { return whyNoStation(document, profile, this.value()); },
    };
}

/** Save as, for a mapping and its profile: resolves with {kind, name, place}, or null. */
export function askSave(document, profile, kind) {
    const kinds = field('Kind of file', h('select', {}, Object.entries(kKinds).map(([value, { what, ending }]) =>
        h('option', { value, selected: value === kind }, `${what} (${ending})`))));
    const name = field('File name', h('input', { type: 'text', value: document.name, autocomplete: 'off', spellcheck: false }));
    const station = stationFields(document, profile);
    const show = () => {
        station.parts.hidden = kinds.input.value !== 'station';
        if (kinds.input.value === 'station' && name.input.value === document.name) name.input.value = 'station';
    };
    kinds.input.addEventListener('change', show);
    show();
    return ask('Save as', [kinds.row, name.row, station.parts], [{
        text: 'Save', value: () => ({ kind: kinds.input.value, name: name.input.value.trim(), place: station.value() }),
    }], () => {
        if (!name.input.value.trim()) return 'The file needs a name.';
        if (/[\\/:*?"<>|\u0000-\u001f]/.test(name.input.value)) return 'These characters cannot stand in a file name: \\ / : * ? " < > |';
        return kinds.input.value === 'station' ? station.valid() : '';
    });
}

/** The library has another mapping of this name: resolves with "replace", "both" or null. */
export function askReplace(name) {
    return ask(`The library has another mapping ${name}.`, [h('p', {}, 'Undo does not bring back what is replaced.')],
        [{ text: 'Replace', value: () => 'replace' }, { text: 'Keep both', value: () => 'both' }]);
}

/** Resolves with true or null. */
export function askDelete(name) {
    return ask(`Delete ${name} from the library?`, [h('p', {}, 'Undo does not bring it back.')], [{ text: 'Delete', value: () => true }]);
}

/** What to print: resolves with the set of the chosen parts, or null. */
export function askPrint() {
    const parts = [['inputs', 'Inputs'], ['outputs', 'Outputs'], ['map', 'I/O map']].map(([key, label]) => [key, checkbox(label, true, () => {})]);
    const chosen = () => new Set(parts.filter(([, one]) => one.input.checked).map(([key]) => key));
    return ask('Print', [h('fieldset', {}, h('legend', {}, 'What to print'), parts.map(([, one]) => one.row))],
        [{ text: 'Print', value: chosen }], () => (chosen().size === 0 ? 'Choose at least one part.' : ''));
}
