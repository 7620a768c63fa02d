// SPDX-License-Identifier: Apache-2.0
// The two sides of check and compare. They take any GSD file, and change nothing of the mapping.
import { fileNameOf } from '../mapping/model.js';
import { isError, sentencesOf } from '../questions.js';
import { readOrSay } from './files.js';

/** The actions of check and compare. A side is 0 or 1. */
export function checking({ store, ask, say, notify }) {
    function setSide(side, file) {
        const sides = [...store.state().sides];
        sides[side] = file;
        store.change({ sides, screen: 'check', notice: null });
        if (!file) return say('The file was removed.');
        const bad = sides.find((one) => one && !ask.check(one).findings);
        if (bad) return say(`${bad.name}: ${sentencesOf(ask.check(bad)).join(' ')}`, 'error');
        return say(sides.every(Boolean) ? `${sides[0].name} and ${sides[1].name} are compared.` : ask.check(file).lines.slice(-1)[0]);
    }

    return {
        /** Reads a file into one side. */
        async check(file, side) {
            const read = await readOrSay(file, notify);
            if (read) setSide(side, { ...read, device: ask.deviceOf(read, store.state().history.present) });
        },
        /** The mapping that is edited, as the file it would be. */
        checkPresent(side) {
            const document = store.state().history.present;
            const name = fileNameOf(document);
            const reply = ask.make(document, name);
            if (!reply.octets) return notify('error', 'The mapping gives no file yet.', [], ask.preview(document).findings.filter(isError));
            return setSide(side, { name, octets: reply.octets, device: ask.deviceOfDraft(document) });
        },
        forget: (side) => setSide(side, null),
    };
}
