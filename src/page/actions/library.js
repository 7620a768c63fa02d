// SPDX-License-Identifier: Apache-2.0
// The library of several files for one instrument: kept by the browser, exported and imported as one file with the draft.
import { documentOf, mappingOf } from '../mapping/model.js';
import { hasOther, isSame, merged, readKept, textOf, withDocument } from '../mapping/keeping.js';
import { keep, keptText, onKeptElsewhere } from '../files/storage.js';

/** The library as the browser keeps it for all windows of the page. */
function sharedLibrary({ store, noteKept, known }) {
    let met = null; // the text that this window has read or written last

    /** The entries that a text has, of what this page knows. Null: it is no such text. */
    function entriesOf(text) {
        met = text;
        return readKept(text ?? '')?.library.filter((one) => known(one.document)) ?? null;
    }

    function meet(text) {
        const library = entriesOf(text);
        if (library) store.change({ library });
    }

    return {
        restored: () => entriesOf(keptText('library')) ?? [],
        watch: () => onKeptElsewhere('library', meet),
        /** The entries, with what another window has kept, also when the browser has not told of it. */
        present() {
            const text = keptText('library');
            if (text !== null && text !== met) meet(text);
            return store.state().library;
        },
        /** True: the browser has kept it. */
        set(library) {
            const text = textOf({ library });
            const isKept = keep('library', text);
            if (isKept) met = text;
            store.change({ library });
            noteKept('library', isKept);
            return isKept;
        },
    };
}

/** The actions with the library. */
export function keeping({ store, ask, say, notify, noteKept, edit, askReplace, askDelete }) {
    const known = (document) => document !== null && ask.profile(document.profile) !== undefined;
    const copyOf = ({ name, table, ...rest }) => documentOf(name, mappingOf(rest), [], table);
    const shared = sharedLibrary({ store, noteKept, known });

    const stamp = () => new Date().toISOString().slice(0, 16).replace('T', ' ');

    return {
        /** What the browser has kept. */
        restored: shared.restored,
        watch: shared.watch,
        async store() {
            const document = store.state().history.present;
            const answer = hasOther(shared.present(), document) ? await askReplace(document.name) : 'replace';
            if (answer === null) return say('Nothing was stored.');
            const library = shared.present();
            const isKept = shared.set(answer === 'both' ? merged(library, [{ document, stored: stamp() }])
                : withDocument(library, document, stamp()));
            return say(isKept ? `${document.name} was stored in the library.` : `${document.name} is in the library until the page is closed.`,
                isKept ? '' : 'error');
        },
        /** Adds a document; one of the same name with other content stays. False: the browser cannot keep it. */
        add: (document) => shared.set(merged(shared.present(), [{ document, stored: stamp() }])),
        open: (entry) => edit.open(copyOf(entry.document), `${entry.document.name} was opened from the library.`),
        async remove(entry) {
            if (!await askDelete(entry.document.name)) return;
            shared.set(shared.present().filter((one) => !isSame(one, entry)));
            say(`${entry.document.name} was deleted from the library.`);
        },
        exported: () => textOf({ draft: store.state().history.present, library: store.state().library }),
        /** Takes the library of an exported file, and its draft as one step that undo takes back. */
        take(name, kept) {
            const entries = kept.library.filter((one) => known(one.document));
            shared.set(merged(shared.present(), entries));
            if (known(kept.draft)) edit.open(copyOf(kept.draft), `${name} was opened.`);
            const left = kept.lost + kept.library.length - entries.length;
            if (left > 0) notify('warning', `${name} has entries that cannot be read: ${left}.`, []);
            say(`${name} was read: ${entries.length} in the library${kept.draft ? ', and the draft' : ''}.`);
        },
    };
}
