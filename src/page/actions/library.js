// SPDX-License-Identifier: Apache-2.0
// The library of several files for one instrument: kept by the browser, exported and imported as one file with the draft.
import { documentOf, mappingOf } from '../mapping/model.js';
import { isSame, merged, readKept, textOf, withDocument } from '../mapping/keeping.js';
import { keep, keptText, onKeptElsewhere } from '../files/storage.js';

/** The actions with the library. */
export function keeping({ store, ask, say, notify, noteKept, edit }) {
    const known = (document) => document !== null && ask.profile(document.profile) !== undefined;
    const copyOf = ({ name, table, ...rest }) => documentOf(name, mappingOf(rest), [], table);

    const stamp = () => new Date().toISOString().slice(0, 16).replace('T', ' ');

    /** True: the browser has kept it. */
    function setLibrary(library) {
        const isKept = keep('library', textOf({ library }));
        store.change({ library });
        noteKept('library', isKept);
        return isKept;
    }

    return {
        /** What the browser has kept. */
        restored() {
            const library = readKept(keptText('library') ?? '')?.library ?? [];
            return library.filter((one) => known(one.document));
        },
        watch: () => onKeptElsewhere('library', (text) => {
            const kept = readKept(text);
            if (kept) store.change({ library: kept.library.filter((one) => known(one.document)) });
        }),
        store() {
            const document = store.state().history.present;
            const isKept = setLibrary(withDocument(store.state().library, document, stamp()));
            say(isKept ? `${document.name} was stored in the library.` : `${document.name} is in the library until the page is closed.`,
                isKept ? '' : 'error');
        },
        /** Adds a document; one of the same name with other content stays. False: the browser cannot keep it. */
        add: (document) => setLibrary(merged(store.state().library, [{ document, stored: stamp() }])),
        open: (entry) => edit.open(copyOf(entry.document), `${entry.document.name} was opened from the library.`),
        remove(entry) {
            setLibrary(store.state().library.filter((one) => !isSame(one, entry)));
            say(`${entry.document.name} was deleted from the library.`);
        },
        exported: () => textOf({ draft: store.state().history.present, library: store.state().library }),
        /** Takes the library of an exported file, and its draft as one step that undo takes back. */
        take(name, kept) {
            const entries = kept.library.filter((one) => known(one.document));
            setLibrary(merged(store.state().library, entries));
            if (known(kept.draft)) edit.open(copyOf(kept.draft), `${name} was opened.`);
            const left = kept.lost + kept.library.length - entries.length;
            if (left > 0) notify('warning', `${name} has entries that cannot be read: ${left}.`, []);
            say(`${name} was read: ${entries.length} in the library${kept.draft ? ', and the draft' : ''}.`);
        },
    };
}
