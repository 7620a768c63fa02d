// SPDX-License-Identifier: Apache-2.0
// The draft: the document that is edited, kept all the time. The windows of the page share it. One that finds the draft of
// another window in its place does not write over it: it keeps its own beside it, and asks.
import { documentOf, mappingOf } from '../mapping/model.js';
import { isSameDraft, readKept, textOf } from '../mapping/keeping.js';
import { forget, keep, keptNames, keptText, onKeptElsewhere } from '../files/storage.js';

const kShared = 'draft';
const kBeside = 'draft.'; // and what is this window's own

/** The actions with the draft. `collect` takes the documents of windows that are no longer there: true, they are kept. */
export function drafting({ store, ask, say, noteKept, edit, collect }) {
    const beside = `${kBeside}${Date.now().toString(36)}${Math.random().toString(36).slice(2)}`;
    let met = null; // the text of the shared draft as this window has read or written it last
    let shares = true;
    const present = () => store.state().history.present;

    function draftOf(text) {
        const draft = readKept(text ?? '')?.draft ?? null;
        return draft && ask.profile(draft.profile) ? draft : null;
    }

    function write(document) {
        const text = textOf({ draft: document });
        const isKept = keep(shares ? kShared : beside, text);
        if (shares && isKept) met = text; // else the older one of this window would pass for that of another
        noteKept('draft', isKept);
    }

    /** The shared draft is not what this window has left there. */
    function meet(text) {
        const other = draftOf(text);
        if (!other) return;
        met = text;
        if (isSameDraft(other, present())) return share();
        shares = false;
        const title = `Another window of this page has changed the draft: ${other.name}, ${other.profile}, parameters: ${other.list.length}.`;
        store.change({ otherDraft: { document: other, title }, said: { text: title, severity: 'warning' } });
    }

    function share() {
        shares = true;
        forget(beside);
        if (store.state().otherDraft) store.change({ otherDraft: null });
    }

    return {
        /** What the browser has kept, or null. */
        restored() {
            met = keptText(kShared);
            return draftOf(met);
        },
        /** Gives what windows have kept beside the draft to `collect`. Returns their names. */
        collected() {
            const names = [];
            for (const key of keptNames(kBeside)) {
                const draft = draftOf(keptText(key));
                if (!draft || !collect(draft)) continue;
                forget(key);
                names.push(draft.name);
            }
            return names;
        },
        /** Keeps the draft; the state says whether the browser can. */
        keep(document) {
            const there = keptText(kShared);
            if (shares && there !== null && there !== met) meet(there); // the browser has not told of it yet
            write(document);
        },
        watch: () => onKeptElsewhere(kShared, (text) => {
            if (shares || store.state().otherDraft) meet(text);
        }),
        takeOther() {
            const { document } = store.state().otherDraft;
            share();
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
