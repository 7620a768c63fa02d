// SPDX-License-Identifier: Apache-2.0
// Saving the mapping: as a GSD file, as a mapping file, as the station's block of dpslaved.toml.
import { contentOf } from '../mapping/keeping.js';
import { stationBlock } from '../mapping/station.js';
import { isError, sentencesOf } from '../questions.js';
import { octetsOf } from '../files/octets.js';
import { download, hasPicker, pickFile, writePicked } from '../files/disk.js';

/** The kinds of file in which a mapping is saved. */
export const kKinds = {
    gsd: { ending: '.GSD', endings: /\.gs[a-z]$/i, what: 'GSD file' }, // .GSE, .GSG: the same in another language
    mapping: { ending: '.toml', endings: /\.toml$/i, what: 'Mapping' },
    station: { ending: '.toml', endings: /\.toml$/i, what: 'Block for dpslaved.toml' },
};

/** The name that a document has after its file. That of a GSD file keeps another ending than .GSD. */
const stemOf = (kind, name) => name.replace(kind === 'gsd' ? /\.GSD$/ : kKinds[kind].endings, '');

/** The octets of a kind of file, or null and a notice why there are none. A GSD file is made under its own name, as it is checked. */
function octetsFor({ ask, notify }, document, kind, { name, place = null }) {
    if (kind === 'station') return new TextEncoder().encode(stationBlock(document, ask.profile(document.profile), place));
    const reply = kind === 'gsd' ? ask.make(document, name) : ask.mappingFile(document);
    const { findings } = kind === 'gsd' ? ask.preview(document) : { findings: [] };
    if (!reply.octets) {
        notify('error', `${name} was not saved.`, findings.length > 0 ? [] : sentencesOf(reply), findings.filter(isError));
        return null;
    }
    return octetsOf(reply.octets);
}

/** The actions that save. */
export function saving(app) {
    const { store, ask, say, notify, edit } = app;
    const targets = new Map(); // by document: where it was saved last
    const present = () => store.state().history.present;

    /** What has happened, and the verdict of a GSD file that was saved. `document` is what its octets are of. */
    function tell(document, { kind, handle }, name) {
        const { findings } = kind === 'gsd' ? ask.preview({ ...document, name: stemOf(kind, name) }) : { findings: [] };
        if (findings.length > 0) notify('warning', `${name} has warnings:`, [], findings);
        say(handle ? `${name} was saved.` : `${name} was given to the downloads of the browser.`);
    }

    /** False, and a notice why: it could not be written. What is typed while the browser writes is not saved. */
    async function write(document, target, name, octets) {
        try {
            if (target.handle) await writePicked(target.handle, octets);
            else download(name, octets);
        } catch (error) {
            notify('error', `${name} was not saved.`, [error.message]);
            return false;
        }
        if (target.kind !== 'station') {
            targets.set(document.id, { ...target, name });
            store.change({ saved: contentOf(document) });
        }
        return true;
    }

    return {
        /** Where the document was saved last: {kind, name}, or null. */
        target: () => targets.get(present().id) ?? null,
        /** Saves under a name. The picker of the browser asks again where it has one. */
        async saveAs(kind, name, place = null) {
            store.change({ notice: null });
            const { ending, endings, what } = kKinds[kind];
            const document = present();
            const full = endings.test(name) ? name : name + ending;
            const octets = octetsFor(app, document, kind, { name: full, place });
            if (!octets) return;
            let handle = null;
            if (hasPicker()) {
                handle = await pickFile(full, ending, what);
                if (!handle) return say('Nothing was saved.');
            }
            const final = handle?.name ?? full;
            if (!await write(document, { kind, handle }, final, octets)) return;
            if (kind !== 'station') edit.set('name', stemOf(kind, final));
            tell(document, { kind, handle }, final);
        },
        /** Saves to where it was saved before. False: it was not saved yet, it has got another name, or it has errors. */
        async save() {
            const document = present();
            const target = targets.get(document.id);
            if (!target || stemOf(target.kind, target.name) !== document.name) return false;
            if (target.kind === 'gsd' && ask.preview(document).findings.some(isError)) return false;
            store.change({ notice: null });
            const octets = octetsFor(app, document, target.kind, target);
            if (octets && await write(document, target, target.name, octets)) tell(document, target, target.name);
            return true;
        },
        downloadText: (name, text) => download(name, new TextEncoder().encode(text)),
    };
}
