// SPDX-License-Identifier: Apache-2.0
// What belongs to the mapping beside its lists: Demand Data, texts and numbers of the file.
import { hexWord } from '../files/octets.js';
import { bitTimesOf, identOf, kBitTimesWanted, kIdentWanted } from '../mapping/numbers.js';
import { isError } from '../questions.js';
import { area, button, checkbox, field, h, reasonAt, setText } from './dom.js';

/** A field of the document. parse() and show() lie between its text and the document. What is said of it stands under it. */
function boundField(app, key, label, note, { parse = (text) => text || null, show = (value) => value, wanted = '', ...properties } = {}) {
    const input = h('input', { type: 'text', autocomplete: 'off', spellcheck: false, 'data-field': key, ...properties });
    const { row } = field(label, input, note);
    const wrong = h('span', { class: 'wrong-note', role: 'alert' });
    const reasons = h('span', { class: 'reasons', id: `${input.id}-reasons` });
    input.setAttribute('aria-describedby', [input.getAttribute('aria-describedby'), reasons.id].filter(Boolean).join(' '));
    row.append(wrong, reasons);
    const parsed = () => parse(input.value);
    function mark(found) {
        const bad = parsed() === undefined;
        input.setAttribute('aria-invalid', String(bad || found.some(isError)));
        setText(wrong, bad ? `Not used. Write ${wanted}.` : '');
        reasons.replaceChildren(...found.map((one) => h('span', { class: one.severity }, one.text)));
    }
    input.addEventListener('input', () => {
        const value = parsed();
        app.edit.set(key, value ?? null); // not the number that stood there some letters ago
    });
    input.addEventListener('blur', () => {
        const value = parsed();
        if (value !== undefined && value !== null) input.value = show(value);
        app.edit.seal();
    });
    return {
        key, row, input,
        /** `found`: what is said of this field. */
        update(document, found) {
            if ((parsed() ?? null) !== document[key]) input.value = document[key] === null ? '' : show(document[key]);
            mark(found);
        },
    };
}

/** A rate in kbit/s, as masters name it. */
const rateText = (baud) => (baud >= 1e6 ? `${baud / 1e6} Mbit/s` : `${baud / 1e3} kbit/s`);

/** MaxTsdr at each rate in bit times: that of the profile, and what the file has instead. */
function showRates(list, own, made = own) {
    const now = new Map((made ?? own).map(({ baud, bits }) => [baud, bits]));
    const rows = own.filter(({ baud }) => now.has(baud)).map(({ baud, bits }) => {
        const differs = now.get(baud) !== bits;
        return h('div', { class: differs ? 'differs' : '' }, h('dt', {}, rateText(baud)), h('dd', {}, differs ? `${now.get(baud)} instead of ${bits}` : String(bits)));
    });
    list.replaceChildren(...rows);
}

/** What the plant's own file has otherwise, in words. */
const kPlantWords = {
    tags: (tags) => `Tags whose directions are in the master's project: ${tags.join(', ')}`,
    tags_at: (at) => `The tags begin at octet ${at} of User_Prm_Data`,
    identifiers: (all) => `Identifiers of the station: ${all.join(', ')}`,
    modules: (all) => `Modules: ${all.map(({ name, identifiers }) => `${name} (${identifiers})`).join(', ')}`,
    user_prm_data_len: (length) => `User_Prm_Data has ${length} octets`,
    max_module: (most) => `Max_Module is ${most}`,
    max_input_len: (length) => `Max_Input_Len is ${length}`,
    max_output_len: (length) => `Max_Output_Len is ${length}`,
    max_data_len: (length) => `Max_Data_Len is ${length}`,
};

/** What is kept of the plant's own file, and the way to let it go. */
function showPlant(element, plant, forget) {
    const key = JSON.stringify(plant);
    if (element.dataset.shown === key) return;
    element.dataset.shown = key;
    element.hidden = plant === null;
    if (plant === null) return element.replaceChildren();
    const rows = Object.entries(plant).map(([name, value]) => h('li', {}, kPlantWords[name](value)));
    return element.replaceChildren(h('p', {}, "Kept of the plant's own GSD file:"), h('ul', {}, rows),
        button('Make the file as the profile has it', forget));
}

/** The view of the details. */
export function detailsView(app) {
    const { ask, edit } = app;
    const demand = checkbox('Use Demand Data', false, (checked) => edit.set('demand', checked));
    demand.input.dataset.field = 'demand';
    const device = field('Device', h('select', { 'data-field': 'profile', on: { change: () => {
        edit.setDevice(device.input.value);
    } } }, ask.profiles.map((one) => h('option', { value: one.name }, `${one.name}: ${one.device}`))));
    const fields = [
        boundField(app, 'name', 'File name', 'Without .GSD', { parse: (text) => text, maxLength: 120 }),
        boundField(app, 'description', 'Description', 'Shown in the device list of the master', { maxLength: 300, placeholder: '' }),
        boundField(app, 'ident', 'Ident_Number', 'Hexadecimal, such as 0x1652', { parse: identOf, show: hexWord, wanted: kIdentWanted, class: 'short' }),
        boundField(app, 'model', 'Model_Name', 'Empty: that of the profile', { maxLength: 120 }),
        boundField(app, 'max_tsdr', 'MaxTsdr', 'Bit times, for each rate where it is more than that of the profile', { parse: bitTimesOf, show: String, wanted: kBitTimesWanted, class: 'short', inputMode: 'numeric' }),
    ];
    const noDemand = h('p', { class: 'wrong-note', role: 'alert' });
    const rates = h('dl', { class: 'rates', 'aria-label': 'MaxTsdr by rate' });
    const ident = fields.find((one) => one.key === 'ident');
    const grid = h('div', { class: 'fields' }, fields.map((one) => one.row));
    const element = area('File', 'Demand Data reads and writes any parameter when the master asks for it; it takes four words in ' +
        'each direction. The description is what the master shows in its device list.', { class: 'details' },
    demand.row, noDemand, device.row, grid, rates);
    const plant = h('div', { class: 'plant' });
    grid.after(plant);
    const first = area('Number of your device', 'The Ident_Number is needed first: no source states that of this device. The gateway ' +
        'and the project of the master have the same.', { class: 'first' });

    /** Where the profile has no Ident_Number its field comes first, else it stands with the others. */
    function placeIdent(comesFirst) {
        first.hidden = !comesFirst;
        const place = comesFirst ? first : grid;
        if (ident.row.parentElement === place) return;
        if (comesFirst) first.append(ident.row);
        else fields.find((one) => one.key === 'model').row.before(ident.row);
    }

    return {
        element,
        first,
        update(state) {
            const document = state.history.present;
            const profile = ask.profile(document.profile);
            const { findings, remarks, max_tsdr } = ask.preview(document);
            device.input.value = document.profile;
            demand.input.checked = document.demand;
            setText(noDemand, reasonAt(state, 'demand'));
            demand.row.hidden = !profile.demand && !document.demand;
            placeIdent(profile.ident === null);
            for (const one of fields) one.update(document, [...findings, ...remarks].filter(({ field: key }) => key === one.key));
            grid.querySelector('[data-field=model]').placeholder = profile.model;
            showRates(rates, profile.max_tsdr, max_tsdr);
            showPlant(plant, document.plant, () => edit.set('plant', null));
            ident.input.placeholder = profile.ident === null ? 'not known' : hexWord(profile.ident);
        },
    };
}
