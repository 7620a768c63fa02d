// SPDX-License-Identifier: Apache-2.0
// The dialogs of the page: which profile, save as, replace and delete in the library, print.
import { kKinds } from '../actions/saving.js';
import { identOf, kIdentWanted } from '../mapping/numbers.js';
import { whyNoStation } from '../mapping/station.js';
import { ask } from './dialog.js';
import { checkbox, field, h } from './dom.js';
import { findingsList } from './findings.js';

/** Which of several profiles a file is for. */
export function chooseProfile(name, sentences, candidates, ofProfile) {
    const none = h('option', { value: '', selected: true }, 'Choose the device');
    const { row, input } = field('Device', h('select', {}, none, candidates.map((one) =>
        h('option', { value: one }, `${one}: ${ofProfile(one)?.device ?? ''}`))));
    return ask(`Which device is ${name} for?`, [sentences.map((one) => h('p', {}, one)), row], [{ text: 'Open', value: () => input.value }],
        () => (input.value === '' ? { text: 'Choose the device. None is taken on a guess.', input } : null));
}

function stationFields(profile) {
    const name = field('Station name', h('input', { type: 'text', value: 'station-1' }));
    const address = field('PROFIBUS address', h('input', { type: 'text', inputMode: 'numeric', class: 'short' }), `${profile.min_address} to ${profile.max_address}`);
    const line = field('Drive line', h('input', { type: 'text', value: 'p3' }), 'Its name in [[line]]');
    const unit = field('Unit on that line', h('input', { type: 'text', class: 'short' }), 'As the profile has it: 00 or 1');
    const parts = h('div', { class: 'fields' }, name.row, address.row, line.row, unit.row);
    return {
        parts,
        value: () => ({ name: name.input.value.trim(), address: address.input.value, line: line.input.value.trim(), unit: unit.input.value.trim() }),
        valid() {
            const why = whyNoStation(profile, this.value());
            return why && { text: why.text, input: { name, address, line, unit }[why.field].input };
        },
    };
}

/** The number of the device, where neither the mapping nor its profile has one: a GSD file and a station need it. */
function identField() {
    const { row, input } = field('Ident_Number', h('input', { type: 'text', class: 'short', autocomplete: 'off', spellcheck: false }),
        'Hexadecimal, such as 0x1652. It is in the GSD file that came with the device, and in the project of the master.');
    return {
        row, input,
        value: () => identOf(input.value) ?? null,
        valid: () => (identOf(input.value) ? null : { text: `Write the Ident_Number of your device: ${kIdentWanted}.`, input }),
    };
}

/** Why a name cannot be that of a file. */
function whyNoFileName(input) {
    if (!input.value.trim()) return { text: 'The file needs a name.', input };
    if (/[\\/:*?"<>|\u0000-\u001f]/.test(input.value)) return { text: 'These characters cannot stand in a file name: \\ / : * ? " < > |', input };
    return null;
}

/**
 * Save as, for a mapping and its profile: resolves with {kind, name, place, ident}, `ident` null where it was not asked for, or
 * with null. errorsOf(ident) gives the errors that a GSD file would have; lead(finding) leads to what mends one.
 */
export function askSave(document, profile, kind, { errorsOf, lead }) {
    const kinds = field('Kind of file', h('select', {}, Object.entries(kKinds).map(([value, { what, ending }]) =>
        h('option', { value, selected: value === kind }, `${what} (${ending})`))));
    const name = field('File name', h('input', { type: 'text', value: document.name, autocomplete: 'off', spellcheck: false }));
    const ident = identField();
    const station = stationFields(profile);
    const errors = h('div', { role: 'alert' });
    const kindNow = () => kinds.input.value;
    const asksIdent = () => kindNow() !== 'mapping' && document.ident === null && profile.ident === null;
    const errorsNow = () => (kindNow() === 'gsd' ? errorsOf(ident.value()).filter((one) => one.field !== 'ident') : []);
    const show = (finish) => {
        station.parts.hidden = kindNow() !== 'station';
        ident.row.hidden = !asksIdent();
        if (kindNow() === 'station' && name.input.value === document.name) name.input.value = 'station';
        const found = errorsNow();
        errors.replaceChildren(found.length === 0 ? '' : findingsList(found, (one) => { finish(); lead(one); }));
    };
    const parts = (finish) => {
        kinds.input.addEventListener('change', () => show(finish));
        show(finish);
        (asksIdent() ? ident : name).input.autofocus = true;
        return [kinds.row, name.row, ident.row, station.parts, errors];
    };
    return ask('Save as', parts, [{
        text: 'Save', value: () => ({
            kind: kindNow(), name: name.input.value.trim(), place: station.value(), ident: asksIdent() ? ident.value() : null,
        }),
    }], () => whyNoFileName(name.input) ?? (asksIdent() ? ident.valid() : null) ?? (kindNow() === 'station' ? station.valid() : null) ??
        (errorsNow().length > 0 ? { text: 'A GSD file is made when these errors are gone. A mapping can be saved with them.', input: null } : null));
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
        [{ text: 'Print', value: chosen }], () => (chosen().size === 0 ? { text: 'Choose at least one part.', input: null } : null));
}
