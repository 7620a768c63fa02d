// SPDX-License-Identifier: Apache-2.0
// All parameters in the order of the telegram. Inputs and outputs may alternate in it; the lists by direction do not show
// that, so it is changed here.
import { kListNames } from '../mapping/model.js';
import { area, button, h, setText } from './dom.js';
import { makeDraggable } from './drag.js';
import { listbox } from './listbox.js';
import { entryRow } from './rows.js';

const kTitle = 'Order in the telegram';
const kHint = 'The order of the parameters in Set_Prm and Chk_Cfg. Inputs and outputs may alternate. ' +
    'Drag to reorder. Alt and the arrow keys move, Delete deletes.';

/** What is done here, by buttons and keys. */
function orderActions(app) {
    const { store, edit } = app;
    const present = () => store.state().history.present;
    const choose = (at) => store.change({ selectedList: present().list[at].direction, selectedAt: at });
    return {
        choose,
        onChosen(action) {
            const { selectedAt } = store.state();
            if (present().list[selectedAt]) action(selectedAt);
            else app.say('Select a parameter first.', 'error');
        },
        key(event, at) {
            if (event.key === 'Delete') edit.remove(at);
            else if (event.altKey && event.key === 'ArrowUp') edit.stepInTelegram(at, -1);
            else if (event.altKey && event.key === 'ArrowDown') edit.stepInTelegram(at, 1);
            else return;
            event.preventDefault();
        },
    };
}

/** The view of the whole list. */
export function orderView(app) {
    const { ask, edit } = app;
    const actions = orderActions(app);
    const placeOf = (row) => Number(row.dataset.at);
    const list = listbox({ class: 'rows', 'aria-label': kTitle }, {
        rowOf: (row) => row,
        keepPlace: true,
        choose: (row) => actions.choose(placeOf(row)),
        key: (event, row) => { if (row) actions.key(event, placeOf(row)); },
    });
    makeDraggable(list.element, (row) => ({
        label: row.querySelector('.name').textContent,
        drop: (target) => app.dropOn(target, { from: placeOf(row) }),
    }));
    const count = h('span', { class: 'count' });
    const empty = h('p', { class: 'empty' }, 'No parameter. Add one to a list by direction.');
    const bar = h('div', { class: 'bar list-bar' },
        button('Up', () => actions.onChosen((at) => edit.stepInTelegram(at, -1)), { icon: '↑', compact: true, more: 'in the telegram' }),
        button('Down', () => actions.onChosen((at) => edit.stepInTelegram(at, 1)), { icon: '↓', compact: true, more: 'in the telegram' }),
        button('Delete', () => actions.onChosen(edit.remove), { more: 'from the telegram' }));
    const element = area(kTitle, kHint, { class: 'list', 'data-drop': 'telegram' },
        h('div', { class: 'list-rows' }, list.element, empty), bar);
    element.querySelector('h2').append(' ', count);

    let shown = { document: null, rows: [] };
    return {
        element,
        list: list.element,
        update(state) {
            const document = state.history.present;
            if (shown.document !== document) {
                const preview = ask.preview(document);
                shown = { document, rows: document.list.map(({ direction }, at) =>
                    entryRow(preview, document, at, { list: 'telegram', place: at, about: kListNames[direction] })) };
            }
            list.show(shown.rows, shown.rows[state.selectedAt] ?? null);
            setText(count, String(shown.rows.length));
            empty.hidden = shown.rows.length > 0;
        },
    };
}
