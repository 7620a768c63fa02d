// SPDX-License-Identifier: Apache-2.0
// What belongs to the mapping beside its lists: Demand Data, texts and numbers of the file.
import { hexWord } from '../files/octets.js';
import { area, checkbox, field, h, setText } from './dom.js';

/** A number that is typed in a base, within limits; null for nothing, undefined for anything else. */
function numberIn(least, most, base, digits) {
    return (text) => {
        if (text.trim() === '') return null;
        const value = digits.test(text) ? parseInt(text.trim().replace(/^0x/i, ''), base) : NaN;
        return value >= least && value <= most ? value : undefined;
    };
}

// Always hexadecimal, as the note beside the field and each GSD file have it: 1652 is 0x1652.
const identOf = numberIn(1, 0xffff, 16, /^\s*(0x)?[0-9a-f]{1,6}\s*$/i);
const bitTimesOf = numberIn(11, 0xffff, 10, /^\s*[0-9]{1,8}\s*$/);

/** A field of the document. parse() and show() lie between its text and the document. */
function boundField(app, key, label, note, { parse = (text) => text || null, show = (value) => value, wanted = '', ...properties } = {}) {
    const input = h('input', { type: 'text', autocomplete: 'off', spellcheck: false, 'data-field': key, ...properties });
    const { row } = field(label, input, note);
    const wrong = h('span', { class: 'wrong-note', role: 'alert' });
    row.append(wrong);
    const parsed = () => parse(input.value);
    function mark() {
        const bad = parsed() === undefined;
        input.setAttribute('aria-invalid', String(bad));
        setText(wrong, bad ? `Not used. Write ${wanted}.` : '');
    }
    input.addEventListener('input', () => {
        const value = parsed();
        mark();
        app.edit.set(key, value ?? null); // not the number that stood there some letters ago
    });
    input.addEventListener('blur', () => {
        const value = parsed();
        if (value !== undefined && value !== null) input.value = show(value);
        app.edit.seal();
    });
    return {
        row,
        update(document) {
            if ((parsed() ?? null) === document[key]) return mark();
            input.value = document[key] === null ? '' : show(document[key]);
            return mark();
        },
    };
}

/** The view of the details. */
export function detailsView(app) {
    const { ask, edit } = app;
    const demand = checkbox('Use Demand Data', false, (checked) => edit.set('demand', checked));
    const device = field('Device', h('select', { on: { change: () => {
        edit.setDevice(device.input.value);
    } } }, ask.profiles.map((one) => h('option', { value: one.name }, `${one.name}: ${one.device}`))));
    const fields = [
        boundField(app, 'name', 'File name', 'Without .GSD', { parse: (text) => text, maxLength: 120 }),
        boundField(app, 'description', 'Description', 'Shown in the device list of the master', { maxLength: 300, placeholder: '' }),
        boundField(app, 'ident', 'Ident_Number', 'Hexadecimal, such as 0x1652', { parse: identOf, show: hexWord, wanted: '0x0001 to 0xFFFF', class: 'short' }),
        boundField(app, 'model', 'Model_Name', 'Empty: that of the profile', { maxLength: 120 }),
        boundField(app, 'max_tsdr', 'MaxTsdr', 'Bit times. Empty: those of the profile', { parse: bitTimesOf, show: String, wanted: '11 to 65535', class: 'short', inputMode: 'numeric' }),
    ];
    const element = area('File', 'Demand Data reads and writes any parameter when the master asks for it; it takes four words in ' +
        'each direction. The description is what the master shows in its device list.', { class: 'details' },
    demand.row, device.row, h('div', { class: 'fields' }, fields.map((one) => one.row)));

    return {
        element,
        update(state) {
            const document = state.history.present;
            const profile = ask.profile(document.profile);
            device.input.value = document.profile;
            demand.input.checked = document.demand;
            demand.row.hidden = !profile.demand && !document.demand;
            for (const one of fields) one.update(document);
            element.querySelector('[data-field=model]').placeholder = profile.model;
            element.querySelector('[data-field=ident]').placeholder = profile.ident === null ? 'not known' : hexWord(profile.ident);
        },
    };
}
