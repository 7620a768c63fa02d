// SPDX-License-Identifier: Apache-2.0
// The parameters of the device on the left: tabs of the instrument's lists, and a search over all of them.
import { kListNames } from '../mapping/model.js';
import { tagOf } from '../mapping/numbers.js';
import { kStatusWords, search, suggestion } from '../mapping/search.js';
import { aboutPart, accessText, demandText } from './about.js';
import { area, button, field, h, reasonAt, setText } from './dom.js';
import { makeDraggable } from './drag.js';
import { listbox } from './listbox.js';
import { openMenu } from './menu.js';
import { tabs } from './tabs.js';

const kHint = 'Choose a list or search, then drag a parameter to a list, or choose it and press Add there. A double click or Enter ' +
    'adds it to the list that is selected. What the table says of it stands below.';

function rowOf(tag) {
    return h('div', { role: 'option', id: `tag-${tag.number}`, class: 'row', 'aria-selected': 'false', 'data-tag': tag.number },
        h('span', { class: 'grip', 'aria-hidden': 'true' }, '⠿'),
        h('span', { class: 'number' }, String(tag.number)),
        h('span', { class: 'name' }, tag.name || '(no name)', tag.mnemonic ? h('span', { class: 'mnemonic' }, ` ${tag.mnemonic}`) : null),
        h('span', { class: 'about' }, [accessText(tag), tag.section].filter(Boolean).join(' · ')));
}

function tableButtons(app) {
    const input = h('input', { type: 'file', accept: '.csv', class: 'unseen', tabIndex: -1, 'aria-label': 'Table file', on: {
        change: () => { if (input.files[0]) app.files.openTable(input.files[0]); input.value = ''; } } });
    const load = button('Load a table…', () => input.click(), { 'data-do': 'load-table', 'data-way': 'table' });
    const drop = button('Use the shipped table', () => {
        app.edit.set('table', null);
        app.say('The table of the profile is used.');
    });
    return { load, drop, input };
}

function byNumber(app) {
    const { row, input } = field('Add tag by number', h('input', { type: 'text', inputMode: 'numeric', autocomplete: 'off', class: 'short' }), ' ');
    const note = row.querySelector('.note');
    const reason = h('p', { class: 'wrong-note', role: 'alert' });
    const most = () => app.ask.profile(app.store.state().history.present.profile).max_tag;
    const form = h('form', { class: 'by-number', on: { submit: (event) => {
        event.preventDefault();
        const tag = tagOf(input.value, most());
        if (tag) app.edit.add(tag, undefined, null, 'number');
        else app.explain('number', `"${input.value}" is no tag of this device: write a number from 1 to ${most()}.`);
        input.select();
    } } }, row, h('button', { type: 'submit' }, 'Add tag'), reason);
    return {
        form,
        update(state) {
            setText(note, `A number from 1 to ${most()}`);
            const why = reasonAt(state, 'number');
            setText(reason, why);
            input.setAttribute('aria-invalid', String(why !== ''));
        },
    };
}

/** The list of parameters with its keys, its menu and its drag. */
function parameterList(app) {
    const { store, ask } = app;
    const rows = new WeakMap(); // by tag: a key of the search only puts them together anew
    const list = listbox({ class: 'rows tree-rows', 'aria-label': 'Parameters', on: { contextmenu: onMenu, dblclick: onDouble } }, {
        rowOf: (tag) => rows.get(tag) ?? rows.set(tag, rowOf(tag)).get(tag),
        choose: (tag) => store.change({ treeTag: tag.number, reason: null }),
        key: onKey,
    });
    makeDraggable(list.element, (row) => ({
        label: row.querySelector('.name').textContent,
        drop: (target) => app.dropOn(target, { tag: Number(row.dataset.tag) }),
    }));
    const directions = () => ask.profile(store.state().history.present.profile).lists;

    function onDouble(event) {
        const tag = list.itemOf(event.target);
        if (tag) app.edit.add(tag.number, undefined, null, 'tree');
    }
    function onKey(event, tag) {
        if (event.key === 'ContextMenu' || (event.key === 'F10' && event.shiftKey)) return onMenu(event);
        if (!tag || event.ctrlKey || event.altKey || event.metaKey) return undefined;
        const direction = { i: 'in', o: 'out', b: 'in-out' }[event.key.toLowerCase()];
        if (event.key === 'Enter' || event.key === ' ') app.edit.add(tag.number, undefined, null, 'tree');
        else if (directions().includes(direction)) app.edit.add(tag.number, direction, null, 'tree');
        else return undefined;
        return event.preventDefault();
    }
    function onMenu(event) {
        const under = list.itemOf(event.target);
        if (under) store.change({ treeTag: under.number });
        const { history, treeTag } = store.state();
        const tag = ask.tags(history.present).byNumber.get(treeTag);
        if (!tag) return event.preventDefault();
        return openMenu(event, list.element, tag.name, [
            { text: demandText(tag), action: () => app.copy(String(tag.demand ?? tag.number), 'The tag') },
            ...directions().map((direction) => ({ text: `Add to ${kListNames[direction]}`, action: () => app.edit.add(tag.number, direction, null, 'tree') })),
        ]);
    }
    return list;
}

/** Which rows are to be seen: {tab, tags}, the same ones as long as the state asks for the same. */
function newSelection() {
    let seen = {};
    return ({ tab: wanted, query }, index) => {
        const tab = index.tabs.find((one) => one.name === wanted) ?? index.tabs[0] ?? null;
        if (seen.index !== index || seen.query !== query || seen.tab !== tab)
            seen = { index, query, tab, tags: query.trim() ? search(index, query) : tab?.tags ?? [] };
        return seen;
    };
}

function countText(query, index, tags) {
    if (index.refusals.length > 0) return index.refusals.join(' ');
    if (index.tags.length === 0) return 'The shipped table of this device has no parameters: add tags by number, or load a table of your own.';
    return query.trim() ? `${tags.length} of ${index.tags.length} parameters` : `${tags.length} parameters in this list`;
}

/** The view of the tree. */
export function treeView(app) {
    const { store, ask } = app;
    const list = parameterList(app);
    const count = h('p', { class: 'count' });
    const meant = button('', () => app.store.change({ query: meant.dataset.query, treeTag: null }), { class: 'meant', 'data-query': '' });
    const reason = h('p', { class: 'wrong-note', role: 'alert' });
    const panel = h('div', { class: 'tree-panel' }, count, meant, list.element);
    const strip = tabs('Lists of the instrument', panel, (tab) => store.change({ tab, query: '', treeTag: null }), { vertical: true });
    const { row: searchRow, input: query } = field('Search parameters', h('input', { type: 'search', 'data-way': 'search', autocomplete: 'off', spellcheck: false, on: {
        input: () => store.change({ query: query.value, treeTag: null }),
        keydown: (event) => { if (event.key === 'ArrowDown' || event.key === 'Enter') { event.preventDefault(); list.element.focus(); } },
    } }));
    const number = byNumber(app);
    const table = tableButtons(app);
    const tableNote = h('p', { class: 'note' });
    const about = h('section', { class: 'about-tag', 'aria-label': 'About the parameter' });
    const element = area('Device parameters', kHint, { class: 'tree' }, searchRow, h('div', { class: 'tree-body' }, strip.list, panel), h('div', { class: 'chosen-tag', tabIndex: 0, role: 'group', 'aria-label': 'The chosen parameter' }, reason, about),
        number.form, h('div', { class: 'bar' }, table.load, table.drop, table.input), tableNote);
    const selection = newSelection();
    let described;

    return {
        element,
        update(state) {
            const document = state.history.present;
            const index = ask.tags(document);
            const { tab, tags } = selection(state, index);
            const searching = state.query.trim() !== '';
            if (query.value !== state.query) query.value = state.query;
            strip.list.hidden = index.tabs.length === 0;
            strip.show(index.tabs.map((one) => one.name), searching ? null : tab?.name ?? null);
            list.element.hidden = tags.length === 0;
            list.show(tags, tags.find((tag) => tag.number === state.treeTag) ?? null);
            list.element.classList.toggle('found', searching || tab?.name === kStatusWords);
            setText(count, countText(state.query, index, tags));
            meant.dataset.query = searching && tags.length === 0 ? suggestion(index, state.query) : '';
            meant.hidden = meant.dataset.query === '';
            setText(meant.firstChild, `Search for “${meant.dataset.query}”`);
            setText(reason, reasonAt(state, 'tree'));
            number.update(state);
            const tag = index.byNumber.get(state.treeTag) ?? null;
            if (tag !== described) about.replaceChildren(aboutPart(tag));
            described = tag;
            table.drop.hidden = !document.table;
            setText(tableNote, document.table ? `Table: ${document.table.name}` : '');
        },
    };
}
