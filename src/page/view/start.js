// SPDX-License-Identifier: Apache-2.0
// The start screen: a new file, one from the disk, a sample, the library, the draft.
import { documentOf } from '../mapping/model.js';
import { standardDocument } from '../actions/edit.js';
import { area, button, field, h, setText } from './dom.js';

function newFile(app) {
    const { row, input } = field('Device', h('select', {}, app.ask.profiles.map((one) => h('option', { value: one.name }, `${one.name}: ${one.device}`))));
    input.value = '2408f';
    const make = () => {
        const profile = app.ask.profile(input.value);
        const document = documentOf(`NEW${profile.name.toUpperCase().slice(0, 5)}`, { profile: profile.name }, []);
        app.edit.open(document, `A new file for ${profile.device}.`);
    };
    return area('New file', 'Choose the device that you have, then start with an empty mapping.', { class: 'card' }, row,
        h('div', { class: 'bar' }, button('New file', make, { class: 'main' })));
}

function openFile(app) {
    return area('Open', 'A GSD file of these devices is opened for editing. Other files can be checked, not edited.', { class: 'card' },
        h('p', {}, 'A GSD file, a mapping (TOML), a table of tags (CSV) or an exported library (JSON). Or drop it anywhere on this page.'),
        h('div', { class: 'bar' }, button('Open a file…', () => app.pickToOpen(), { class: 'main' })));
}

function samples(app) {
    const standard = [false, true].map((demand) => {
        const document = standardDocument(app.ask, demand);
        return h('li', {}, button(document.name, () => app.edit.open(standardDocument(app.ask, demand), `${document.name} was opened.`)),
            ' ', h('span', {}, demand ? 'the standard mapping, with Demand Data' : 'the standard mapping of the 2408f and 2404f'));
    });
    const further = app.ask.samples('').map(({ name, mapping }) => h('li', {}, button(name, () =>
        app.edit.open(documentOf(name, mapping, app.ask.profile(mapping.profile).default_list), `${name} was opened.`)),
    ' ', h('span', {}, mapping.description ?? '')));
    return area('Samples', 'Mappings to start from.', { class: 'card' }, h('ul', { class: 'plain' }, standard, further));
}

function libraryArea(app) {
    const list = h('ul', { class: 'plain', 'data-library': '' });
    const note = h('p', { class: 'note' });
    const element = area('Library', 'Several files for one instrument, one for each application. They stay in this browser on this PC.', { class: 'card' },
        list, note, h('div', { class: 'bar' },
            button('Store the mapping in the library', () => app.library.store()),
            button('Export library and draft', () => app.save.downloadText('gsd-library.json', app.library.exported())),
            button('Import…', () => app.pickToOpen('.json'), { more: 'library and draft' })));
    let shown = null;
    return {
        element,
        update(state) {
            setText(note, state.library.length === 0 ? 'The library is empty.' : '');
            if (shown === state.library) return;
            shown = state.library;
            list.replaceChildren(...shown.map((entry) => h('li', {},
                button(entry.document.name, () => app.library.open(entry)), ' ',
                h('span', {}, `${entry.document.profile}, ${entry.document.list.length} parameters, ${entry.stored}`), ' ',
                button('Delete', () => app.library.remove(entry), { more: entry.document.name }))));
        },
    };
}

/** The view of the start screen. */
export function startView(app) {
    const library = libraryArea(app);
    const draft = h('p', { 'data-storage': '' });
    const now = h('p', { class: 'count' });
    const element = h('div', { class: 'start' },
        area('Draft', 'What you edit is kept as a draft all the time.', { class: 'card' }, now, draft,
            h('div', { class: 'bar' }, button('Continue with the mapping', () => app.go('mapping'), { class: 'main' }))),
        newFile(app), openFile(app), samples(app), library.element);
    return {
        element,
        update(state) {
            const document = state.history.present;
            setText(now, `${document.name}: ${app.ask.profile(document.profile).device}, ${document.list.length} parameters`);
            setText(draft, state.kept.draft ? `${state.restored ? 'The draft of the last time was restored. ' : ''}The draft is kept in this browser on this PC.`
                : 'This browser does not keep the draft: it is lost when the page is closed. Save it, or export it.');
            draft.classList.toggle('warning', !state.kept.draft);
            library.update(state);
        },
    };
}
