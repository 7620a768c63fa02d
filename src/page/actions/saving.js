// SPDX-License-Identifier: Apache-2.0
// Saving the mapping: as a GSD file, as a mapping file, as the station's block of dpslaved.toml.
import { contentOf } from '../mapping/keeping.js';
import { stationBlock } from '../mapping/station.js';
import { sentencesOf } from '../questions.js';
import { octetsOf } from '../files/octets.js';
import { download, hasPicker, pickFile, writePicked } from '../files/disk.js';

/** The kinds of file in which a mapping is saved. */
export const kKinds = {
    gsd: { ending: '.GSD', endings: /\.gs[a-z]$/i, what: 'GSD file' }, // .GSE, .GSG: the same in another language
    mapping: { ending: '.toml', endings: /\.toml$/i, what: 'Mapping' },
    station: { ending: '.toml', endings: /\.toml$/i, what: 'Block for dpslaved.toml' },
};

/** The octets of a kind of file, or null and a notice why there are none. */
function octetsFor({ ask, notify }, document, kind, { name, place = null }) {
    if (kind === 'station') return new TextEncoder().encode(stationBlock(document, ask.profile(document.profile), place));
    const reply = kind === 'gsd' ? ask.make(document, name) : ask.mappingFile(document);
    if (!reply.octets) {
        notify('error', `${name} was not saved.`, sentencesOf(reply));
        return null;
    }
    if (reply.messages.length > 0) notify('warning', `${name} has warnings:`, reply.messages);
    return octetsOf(reply.octets);
}

/** The actions that save. */
export function saving(app) {
    const { store, say, notify, edit } = app;
    const targets = new Map(); // by document: where it was saved last
    const present = () => store.state().history.present;

    /** `document` is what the octets are of: what is typed while the browser writes is not saved. */
    async function write(document, target, name, octets) {
        try {
            if (target.handle) await writePicked(target.handle, octets);
            else download(name, octets);
        } catch (error) {
            return notify('error', `${name} was not saved.`, [error.message]);
        }
        if (target.kind !== 'station') {
            targets.set(document.id, { ...target, name });
            store.change({ saved: contentOf(document) });
        }
        return say(target.handle ? `${name} was saved.` : `${name} was given to the downloads of the browser.`);
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
            await write(document, { kind, handle }, final, octets);
            if (kind !== 'station') edit.set('name', final.replace(endings, ''));
        },
        /** Saves to where it was saved before. False: it was not saved yet, or it has got another name. */
        async save() {
            const document = present();
            const target = targets.get(document.id);
            if (!target || target.name.replace(kKinds[target.kind].endings, '') !== document.name) return false;
            store.change({ notice: null });
            const octets = octetsFor(app, document, target.kind, target);
            if (octets) await write(document, target, target.name, octets);
            return true;
        },
        downloadText: (name, text) => download(name, new TextEncoder().encode(text)),
    };
}
