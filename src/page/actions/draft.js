// SPDX-License-Identifier: Apache-2.0
// The draft: the document that is edited, kept all the time. The windows of the page share it. One that finds the draft of
// another window in its place does not write over it: it keeps its own beside it, and asks.
import { documentOf, mappingOf } from '../mapping/model.js';
import { isSameDraft, readKept, textOf } from '../mapping/keeping.js';
import { forget, keep, keptNames, keptText, onKeptElsewhere } from '../files/storage.js';

const kShared = 'draft';
const kBeside = 'draft.'; // and what is this window's own

/** Where this window keeps its draft: in the shared place, or in one of its own while another window has that. */
function newPlace() {
    const beside = `${kBeside}${Date.now().toString(36)}${Math.random().toString(36).slice(2)}`;
    let met = null; // the text in the shared place as this window has read or written it last
    let shares = true;
    return {
        shares: () => shares,
        read() {
            met = keptText(kShared);
            return met;
        },
        /** The text that another window has written into the shared place since then. Null: there is none. */
        foreign() {
            const there = keptText(kShared);
            return there === met ? null : there;
        },
        write(text) {
            const isKept = keep(shares ? kShared : beside, text);
            if (shares && isKept) met = text; // else the older one of this window would pass for that of another
            return isKept;
        },
        leave(text) {
            met = text;
            shares = false;
        },
        share(text = met) {
            met = text;
            shares = true;
            forget(beside);
        },
    };
}

function draftOf(ask, text) {
    const draft = readKept(text ?? '')?.draft ?? null;
    return draft && ask.profile(draft.profile) ? draft : null;
}

/** Gives what windows have kept beside the draft to `collect`, which returns true where it keeps it. Returns their names. */
function collected(ask, collect) {
    const names = [];
    for (const key of keptNames(kBeside)) {
        const draft = draftOf(ask, keptText(key));
        if (!draft || !collect(draft)) continue;
        forget(key);
        names.push(draft.name);
    }
    return names;
}

/** The actions with the draft. `collect` takes the document of a window that is no longer there. */
export function drafting({ store, ask, say, noteKept, edit, collect }) {
    const place = newPlace();
    const present = () => store.state().history.present;

    const write = (document) => noteKept('draft', place.write(textOf({ draft: document })));

    /** Another text stands in the shared place. What is no draft is written over. */
    function meet(text) {
        const other = draftOf(ask, text);
        if (!other) return;
        if (isSameDraft(other, present())) {
            place.share(text);
            if (store.state().otherDraft) store.change({ otherDraft: null });
            return;
        }
        place.leave(text);
        const title = `Another window of this page has changed the draft: ${other.name}, ${other.profile}, parameters: ${other.list.length}.`;
        store.change({ otherDraft: { document: other, title }, said: { text: title, severity: 'warning' } });
    }

    return {
        /** What the browser has kept, or null. */
        restored: () => draftOf(ask, place.read()),
        collected: () => collected(ask, collect),
        /** Keeps the draft; the state says whether the browser can. */
        keep(document) {
            const foreign = place.shares() ? place.foreign() : null;
            if (foreign !== null) meet(foreign); // the browser has not told of it yet
            write(document);
        },
        watch: () => onKeptElsewhere(kShared, (text) => {
            if (place.shares() || store.state().otherDraft) meet(text);
        }),
        takeOther() {
            const { document } = store.state().otherDraft;
            place.share();
            store.change({ otherDraft: null });
            edit.open(documentOf(document.name, mappingOf(document), [], document.table),
                `The draft ${document.name} of the other window was taken. Undo brings back that of this window.`);
        },
        keepOwn() {
            store.change({ otherDraft: null });
            write(present());
            say('This window keeps its own draft, beside that of the other window.');
        },
    };
}
