// SPDX-License-Identifier: Apache-2.0
// What the user does to the mapping. Each action is one step of the history and says what happened.
import {
    addEntry, clearDirection, documentOf, kListNames, moveEntry, placesOf, removeEntry, setField, stepEntry,
    stepInTelegram,
} from '../mapping/model.js';
import { isError } from '../questions.js';
import { push, redo, seal, undo } from '../mapping/history.js';

/** The findings that stop an action which adds: limits of the list, and what the parameter itself cannot be. */
const kLimits = ['prm_length', 'cfg_too_long', 'too_many_octets', 'tags_and_list'];
const kNoOutput = ['read_only', 'never_written'];

const kTyped = ['name', 'description', 'ident', 'model', 'max_tsdr']; // the letters of one of these are one step

/** How much the device takes, in the terms of the page. */
const mostOf = ({ max_parameters: parameters, max_words: words }) =>
    `The device takes ${parameters} parameters at most${words === null ? '' : `, ${words} words in and out together`}.`;

/** What all actions on the mapping need: how a step is done, what a limit forbids, how it is said. */
function stepping({ store, ask, say, explain }) {
    const present = () => store.state().history.present;
    const placeOf = (document, at) => placesOf(document, document.list[at].direction).indexOf(at) + 1;
    const nameOf = (document, at) => ask.preview(document).parameters[at]?.name || `tag ${document.list[at].tag}`;
    return {
        present,
        nameOf,
        step(document, parts = {}, key = '') {
            store.change({ history: push(store.state().history, document, key), notice: null, reason: null, ...parts });
        },
        /**
         * Does not let an action through that a limit forbids, or what the new entry at `at` is, and says why in the words of the
         * core, at the places of the page where it was asked for.
         */
        within(next, places, { at = null, limits = kLimits } = {}) {
            const { findings, used } = ask.preview(next);
            const stops = (one) => limits.includes(one.code) || (at !== null && one.at === at && kNoOutput.includes(one.code));
            // A mapping that is refused has no count: nothing shows then that it still fits.
            const over = used ? findings.filter(stops) : findings.filter(isError);
            if (over.length === 0) return true;
            const isLimit = used && over.some((one) => limits.includes(one.code));
            explain(places, ['Not added.', isLimit ? mostOf(used) : '', ...over.map((one) => one.text)].filter(Boolean).join(' '));
            return false;
        },
        /** Says where an entry is now, and what is wrong with it there. */
        told(document, at, what) {
            const { direction } = document.list[at];
            const errors = ask.preview(document).findings.filter((one) => one.at === at).map((one) => one.text);
            say([`${nameOf(document, at)} ${what} ${kListNames[direction]}, place ${placeOf(document, at)}.`, ...errors].join(' '));
        },
    };
}

/** Says why a step is not done, in the foot and at the places where it was asked for. */
export function explaining({ store }) {
    return (places, text) => store.change({ reason: { places: [places].flat(), text }, said: { text, severity: 'error' } });
}

const select = (direction, at) => ({ selectedList: direction, selectedAt: at });

/** The actions on the entries of one direction's list. */
function editingLists({ store, say }, { present, nameOf, step, within, told }) {
    return {
        /** `from`: the place of the page where it was asked for, if it is another one than the list. */
        add(tag, direction = store.state().selectedList, before = null, from = direction) {
            const { document, at } = addEntry(present(), direction, tag, before);
            if (!within(document, [direction, from], { at })) return;
            step(document, select(direction, at));
            told(document, at, 'was added to');
        },
        move(from, direction, before = null) {
            const { document, at } = moveEntry(present(), from, direction, before);
            const same = document.list.every((one, place) => one.tag === present().list[place].tag &&
                one.direction === present().list[place].direction);
            if (same) return;
            const was = present().list[from].direction;
            const grows = direction === 'in-out' && was !== 'in-out';
            if (was !== direction && !within(document, [was, direction], { at, limits: grows ? kLimits : [] })) return;
            step(document, select(direction, at));
            told(document, at, 'was moved to');
        },
        step(from, by) {
            const moved = stepEntry(present(), from, by);
            if (!moved) return say(`It is already ${by < 0 ? 'the first' : 'the last'} of the ${kListNames[present().list[from].direction]}.`);
            step(moved.document, select(moved.document.list[moved.at].direction, moved.at));
            told(moved.document, moved.at, 'is now in');
        },
        remove(from) {
            const { direction } = present().list[from];
            const name = nameOf(present(), from);
            const document = removeEntry(present(), from);
            const places = placesOf(document, direction);
            const next = places.find((at) => at >= from) ?? places[places.length - 1] ?? -1;
            step(document, select(direction, next));
            say(`${name} was deleted from ${kListNames[direction]}.`);
        },
        clear(direction) {
            if (placesOf(present(), direction).length === 0) return say(`The list ${kListNames[direction]} has no parameter.`);
            step(clearDirection(present(), direction), select(direction, -1));
            say(`The list ${kListNames[direction]} was cleared. Undo brings it back.`);
        },
    };
}

/** The actions on the order of the telegram, in which the directions may alternate. */
function editingOrder({ say }, { present, nameOf, step }) {
    function stepped({ document, at }) {
        step(document, select(document.list[at].direction, at));
        say(`${nameOf(document, at)} is now parameter ${at + 1} of ${document.list.length} in the telegram.`);
    }
    return {
        /** Before another entry of the telegram, or behind the last one. The direction stays. */
        moveInTelegram(from, before = present().list.length) {
            if (before === from || before === from + 1) return;
            stepped(moveEntry(present(), from, present().list[from].direction, before));
        },
        stepInTelegram(from, by) {
            const moved = stepInTelegram(present(), from, by);
            if (!moved) return say(`It is already the ${by < 0 ? 'first' : 'last'} parameter of the telegram.`);
            return stepped(moved);
        },
    };
}

/** The actions on the document as a whole and on its history. */
function editingDocument({ store, ask, say }, { present, step, within }) {
    function turn(way, done, none) {
        const { history } = store.state();
        const next = way(history);
        if (next === history) return say(none);
        const { lists } = ask.profile(next.present.profile);
        const list = lists.includes(store.state().selectedList) ? store.state().selectedList : lists[0];
        store.change({ history: next, selectedAt: -1, selectedList: list, notice: null });
        say(done);
    }
    return {
        /** Drops what was of the other device: its table, and the numbers and name that stood instead of the profile's. */
        setDevice(profile) {
            const own = { plant: 'what the plant\'s file has otherwise', table: 'the table of your own', ident: 'Ident_Number', model: 'Model_Name', max_tsdr: 'MaxTsdr' };
            const dropped = Object.keys(own).filter((key) => present()[key] !== null);
            const none = Object.fromEntries(Object.keys(own).map((key) => [key, null]));
            step({ ...present(), ...none, profile }, { selectedList: 'in', selectedAt: -1, tab: null, treeTag: null });
            say([`The mapping is for ${ask.profile(profile).device}.`, dropped.length === 0 ? ''
                : `Dropped, because it is of the other device: ${dropped.map((key) => own[key]).join(', ')}. Undo brings it back.`]
                .join(' ').trim());
        },
        set(key, value) {
            const next = setField(present(), key, value);
            if (key === 'demand' && value && !within(next, 'demand')) return store.change({});
            step(next, {}, kTyped.includes(key) ? key : '');
            if (key === 'demand') say(value ? 'Demand Data is used.' : 'Demand Data is not used.');
        },
        seal: () => store.change({ history: seal(store.state().history) }),
        undo: () => turn(undo, 'The last step was undone.', 'There is nothing to undo.'),
        redo: () => turn(redo, 'The step was done again.', 'There is nothing to do again.'),
        /** Another document. What was there before comes back with undo. */
        open(document, sentence) {
            const { lists } = ask.profile(document.profile);
            step(document, { selectedList: lists[0], selectedAt: -1, tab: null, query: '', treeTag: null, screen: 'mapping' });
            say(sentence);
        },
    };
}

/** The actions on the mapping. */
export function editing(app) {
    const steps = stepping(app);
    return { ...editingLists(app, steps), ...editingOrder(app, steps), ...editingDocument(app, steps) };
}

/** The layout with which the page opens: EURO2400.GSD of the handbook. With Demand Data it is EURD2400.GSD. */
export function standardDocument(ask, demand = false) {
    const profile = ask.profile('2408f');
    return documentOf(demand ? 'EURD2400' : 'EURO2400', { profile: profile.name, demand }, profile.default_list);
}
