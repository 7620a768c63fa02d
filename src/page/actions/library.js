// SPDX-License-Identifier: Apache-2.0
// The library of several files for one instrument, and the draft: kept by the browser, exported and imported as one file.
import { documentOf, mappingOf } from '../mapping/model.js';
import { isSame, merged, readKept, textOf, withDocument } from '../mapping/keeping.js';
import { keep, keptText, onKeptElsewhere } from '../files/storage.js';

/** The actions with library and draft. */
export function keeping({ store, ask, say, notify, edit }) {
    const known = (document) => document !== null && ask.profile(document.profile) !== undefined;
    const copyOf = ({ name, table, ...rest }) => documentOf(name, mappingOf(rest), [], table);

    function setLibrary(library) {
        store.change({ library, storage: keep('library', textOf({ library })) });
    }

    return {
        /** What the browser has kept: {draft, library}. */
        restored() {
            const draft = readKept(keptText('draft') ?? '')?.draft ?? null;
            const library = readKept(keptText('library') ?? '')?.library ?? [];
            return { draft: known(draft) ? draft : null, library: library.filter((one) => known(one.document)) };
        },
        /** Keeps the draft; the state says whether the browser can. */
        keepDraft(document) {
            const storage = keep('draft', textOf({ draft: document }));
            if (storage !== store.state().storage) store.change({ storage });
        },
        watch: () => onKeptElsewhere('library', (text) => {
            const kept = readKept(text);
            if (kept) store.change({ library: kept.library.filter((one) => known(one.document)) });
        }),
        store() {
            const document = store.state().history.present;
            setLibrary(withDocument(store.state().library, document, new Date().toISOString().slice(0, 16).replace('T', ' ')));
            say(`${document.name} was stored in the library.`);
        },
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
