// SPDX-License-Identifier: Apache-2.0
// Saving the mapping: as a GSD file, as a mapping file, as the station's block of dpslaved.toml.
import { mappingOf } from '../mapping/model.js';
import { stationBlock } from '../mapping/station.js';
import { sentencesOf } from '../questions.js';
import { octetsOf } from '../files/octets.js';
import { download, hasPicker, pickFile, writePicked } from '../files/disk.js';

/** The kinds of file in which a mapping is saved. */
export const kKinds = {
    gsd: { ending: '.GSD', what: 'GSD file' },
    mapping: { ending: '.toml', what: 'Mapping' },
    station: { ending: '.toml', what: 'Block for dpslaved.toml' },
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

    async function write(target, name, octets) {
        try {
            if (target.handle) await writePicked(target.handle, octets);
            else download(name, octets);
        } catch (error) {
            return notify('error', `${name} was not saved.`, [error.message]);
        }
        if (target.kind !== 'station') {
            targets.set(present().id, { ...target, name });
            store.change({ saved: JSON.stringify(mappingOf(present())) });
        }
        return say(target.handle ? `${name} was saved.` : `${name} was given to the downloads of the browser.`);
    }

    return {
        /** Where the document was saved last: {kind, name}, or null. */
        target: () => targets.get(present().id) ?? null,
        /** Saves under a name. The picker of the browser asks again where it has one. */
        async saveAs(kind, name, place = null) {
            store.change({ notice: null });
            const { ending, what } = kKinds[kind];
            const full = /\.[^.]+$/.test(name) ? name : name + ending;
            const octets = octetsFor(app, present(), kind, { name: full, place });
            if (!octets) return;
            let handle = null;
            if (hasPicker()) {
                handle = await pickFile(full, ending, what);
                if (!handle) return say('Nothing was saved.');
            }
            const final = handle?.name ?? full;
            await write({ kind, handle }, final, octets);
            if (kind !== 'station') edit.set('name', final.replace(/\.[^.]*$/, ''));
        },
        /** Saves to where it was saved before. False: it was not saved yet. */
        async save() {
            const target = targets.get(present().id);
            if (!target) return false;
            store.change({ notice: null });
            const octets = octetsFor(app, present(), target.kind, target);
            if (octets) await write(target, target.name, octets);
            return true;
        },
        downloadText: (name, text) => download(name, new TextEncoder().encode(text)),
    };
}
