// SPDX-License-Identifier: Apache-2.0
// The lists of the mapping: inputs, outputs, and on technology boxes the third one, read and write.
import { kDirections, kListNames, placesOf } from '../mapping/model.js';
import { demandText, shortText } from './about.js';
import { area, button, h, reasonAt, setText } from './dom.js';
import { makeDraggable } from './drag.js';
import { listbox } from './listbox.js';
import { openMenu } from './menu.js';
import { orderView } from './order.js';
import { entryRow } from './rows.js';
import { tabs } from './tabs.js';

/** The headings of the lists. */
export const kTitles = { in: 'Inputs', out: 'Outputs', 'in-out': 'Read and write' };
const kHints = {
    in: 'What the master reads from the device.',
    out: 'What the master writes to the device, in every cycle: an output overrides the front panel.',
    'in-out': 'What the master reads and writes: one parameter in both directions.',
};
const kHow = ' Select the list, then add by double click or Add; drag to reorder or to move. Alt and the arrow keys move, Delete deletes.';

/** What is done in one list, by buttons, keys and menu. */
function entryActions(app, direction) {
    const { store, ask, edit } = app;
    const name = kListNames[direction];
    const present = () => store.state().history.present;
    const otherLists = () => ask.profile(present().profile).lists.filter((one) => one !== direction);
    const choose = (at) => store.change({ selectedList: direction, selectedAt: at, reason: null });
    const chosen = () => (present().list[store.state().selectedAt]?.direction === direction ? store.state().selectedAt : -1);
    return {
        choose,
        select() {
            if (store.state().selectedList !== direction) choose(placesOf(present(), direction)[0] ?? -1);
        },
        onChosen(action) {
            const at = chosen();
            if (at < 0) app.explain(direction, `Select a parameter of the ${name} first.`);
            else action(at);
        },
        addFromTree() {
            const { treeTag } = store.state();
            if (treeTag === null) app.explain(direction, 'Select a parameter of the device first.');
            else edit.add(treeTag, direction);
        },
        key(event, at) {
            const lists = ask.profile(present().profile).lists;
            const beside = lists[lists.indexOf(direction) + { ArrowLeft: -1, ArrowRight: 1 }[event.key]];
            if (event.key === 'Delete') edit.remove(at);
            else if (event.altKey && event.key === 'ArrowUp') edit.step(at, -1);
            else if (event.altKey && event.key === 'ArrowDown') edit.step(at, 1);
            else if (event.altKey && /^Arrow/.test(event.key)) {
                if (beside) edit.move(at, beside);
                if (beside) app.focusList(beside);
            } else return undefined;
            return event.preventDefault();
        },
        menu(event, from) {
            const at = chosen();
            if (at < 0) return event.preventDefault();
            const { tag } = present().list[at];
            const known = ask.tags(present()).byNumber.get(tag) ?? null;
            return openMenu(event, from, ask.preview(present()).parameters[at]?.name || `Tag ${tag}`, [
                { text: demandText(known), action: () => app.copy(String(known?.demand ?? tag), 'The tag') },
                { text: 'Move up', action: () => edit.step(at, -1) },
                { text: 'Move down', action: () => edit.step(at, 1) },
                ...otherLists().map((to) => ({ text: `Move to ${kListNames[to]}`, action: () => edit.move(at, to) })),
                { text: 'Delete', action: () => edit.remove(at) },
                { text: 'Clear the list', action: () => edit.clear(direction) },
            ]);
        },
    };
}

/** The list box of one list, with keys, menu and drag. */
function entryList(app, direction, actions) {
    const placeOf = (row) => Number(row.dataset.at);
    const list = listbox({ class: 'rows', 'aria-label': kTitles[direction], on: { contextmenu: onMenu } }, {
        rowOf: (row) => row,
        keepPlace: true,
        choose: (row) => actions.choose(placeOf(row)),
        key(event, row) {
            if (event.key === 'ContextMenu' || (event.key === 'F10' && event.shiftKey)) return onMenu(event);
            return row ? actions.key(event, placeOf(row)) : undefined;
        },
    });
    function onMenu(event) {
        const row = list.itemOf(event.target);
        if (row) actions.choose(placeOf(row));
        actions.menu(event, list.element);
    }
    makeDraggable(list.element, (row) => ({
        label: row.querySelector('.name').textContent,
        drop: (target) => app.dropOn(target, { from: placeOf(row) }),
    }));
    return list;
}

/** One list. */
function listView(app, direction) {
    const { ask, edit } = app;
    const name = kListNames[direction];
    const actions = entryActions(app, direction);
    const list = entryList(app, direction, actions);
    const moves = kDirections.filter((one) => one !== direction).map((to) =>
        [to, button(`To ${kListNames[to]}`, () => actions.onChosen((at) => edit.move(at, to)), { more: `from ${name}`, class: 'move' })]);
    const count = h('span', { class: 'count' });
    const empty = h('p', { class: 'empty' }, 'No parameter. Choose one of the device and press Add, or drop it here.');
    const bar = h('div', { class: 'bar list-bar' },
        button('Up', () => actions.onChosen((at) => edit.step(at, -1)), { icon: '↑', compact: true, more: `in ${name}` }),
        button('Down', () => actions.onChosen((at) => edit.step(at, 1)), { icon: '↓', compact: true, more: `in ${name}` }),
        moves.map(([, one]) => one),
        button('Delete', () => actions.onChosen(edit.remove), { more: `from ${name}` }),
        button('Clear', () => edit.clear(direction), { more: name }),
        button('More', (event) => actions.onChosen(() => actions.menu(event, list.element)), { more: `in ${name}`, 'aria-haspopup': 'menu' }));
    const about = h('p', { class: 'about' });
    const reason = h('p', { class: 'wrong-note', role: 'alert' });
    const add = button('Add', actions.addFromTree, { icon: '→', more: `to ${name}`, class: 'add' });
    const element = area(kTitles[direction], kHints[direction] + kHow, {
        class: 'list', 'data-drop': direction, 'data-list': direction, on: { click: actions.select, focusin: actions.select },
    }, h('div', { class: 'list-rows' }, list.element, empty), h('div', { class: 'facts', tabIndex: 0, role: 'group', 'aria-label': `About the parameter of the ${name}` }, reason, about), bar);
    const heading = element.querySelector('h2');
    heading.append(' ', count);
    element.prepend(h('div', { class: 'bar spread' }, heading, add));

    let shown = { document: null, rows: [] };
    return {
        element,
        list: list.element,
        update(state) {
            const document = state.history.present;
            const { lists } = ask.profile(document.profile);
            element.hidden = !lists.includes(direction) && placesOf(document, direction).length === 0;
            if (shown.document !== document) shown = { document, rows: rowsOf(ask.preview(document), document, direction) };
            const { rows } = shown;
            list.show(rows, rows.find((row) => Number(row.dataset.at) === state.selectedAt) ?? null);
            const selected = state.selectedList === direction;
            element.classList.toggle('selected', selected);
            setText(count, `${rows.length}${selected ? ' · selected list' : ''}`);
            empty.hidden = rows.length > 0;
            const chosen = selected ? document.list[state.selectedAt] : undefined;
            const why = reasonAt(state, direction);
            setText(reason, why);
            setText(about, why || chosen?.direction !== direction ? '' : shortText(ask.tags(document).byNumber.get(chosen.tag) ?? null));
            // With three lists the menu has these: their rows of buttons would push the lists apart.
            for (const [to, one] of moves) one.hidden = !lists.includes(to) || lists.length > 2;
        },
    };
}

function rowsOf(preview, document, direction) {
    return placesOf(document, direction).map((at, place) => entryRow(preview, document, at, { list: direction, place }));
}

const kWays = ['By direction', 'In telegram order'];

/** All lists of the mapping, by direction or as one. */
export function listsView(app) {
    const views = kDirections.map((direction) => [direction, listView(app, direction)]);
    const order = orderView(app);
    const panel = h('div', { class: 'lists' }, views.map(([, view]) => view.element), order.element);
    const strip = tabs('Lists', panel, (way) => app.store.change({ inTelegramOrder: way === kWays[1] }));
    return {
        element: h('div', { class: 'lists' }, strip.list, panel),
        update(state) {
            strip.show(kWays, kWays[state.inTelegramOrder ? 1 : 0]);
            order.element.hidden = !state.inTelegramOrder;
            if (state.inTelegramOrder) order.update(state);
            for (const [, view] of views) {
                if (state.inTelegramOrder) view.element.hidden = true;
                else view.update(state);
            }
        },
        /** The focus goes to the list of a direction, or to the one that has all. */
        focusList(direction) {
            if (app.store.state().inTelegramOrder) order.list.focus();
            else views.find(([one]) => one === direction)[1].list.focus();
        },
    };
}
