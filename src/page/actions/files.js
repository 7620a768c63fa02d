// SPDX-License-Identifier: Apache-2.0
// Files that the user opens: each is read as what it is, or refused with a sentence.
import { documentOf } from '../mapping/model.js';
import { readKept } from '../mapping/keeping.js';
import { sentencesOf } from '../questions.js';
import { readFile, readLibrary, readTable } from '../files/disk.js';

const stem = (name) => name.replace(/\.[^.]*$/, '') || name;
const ending = (name) => (/\.([^.]*)$/.exec(name)?.[1] ?? '').toLowerCase();

/** The actions with files from the disk. */
export function opening({ store, ask, say, notify, edit, library, chooseProfile }) {
    /** A folder that was dropped, or a file that is gone, cannot be read. */
    async function readOrSay(file) {
        try {
            return await readFile(file);
        } catch (error) {
            notify('error', `${file.name} cannot be read.`, [error.message]);
            return null;
        }
    }

    function openMapping(name, reply, lost = []) {
        const profile = ask.profile(reply.mapping.profile);
        if (!profile) return notify('error', `${name} was not opened.`, [`There is no profile "${reply.mapping.profile}" in this page.`]);
        edit.open(documentOf(stem(name), reply.mapping, profile.default_list), `${name} was opened.`);
        if (lost.length === 0) return undefined;
        return notify('warning', `${name} was opened. The file that is made of it differs from it:`,
            lost.map((one) => `${one.line > 0 ? `Line ${one.line}: ` : ''}${one.keyword}: ${one.left || 'nothing'} becomes ${one.right || 'nothing'}`));
    }

    async function openGsd(file, profile) {
        const reply = ask.importFile(file, profile);
        if (reply.mapping) return openMapping(file.name, reply, reply.lost ?? []);
        if (!reply.candidates?.length) return notify('error', `${file.name} was not opened.`, sentencesOf(reply));
        const chosen = await chooseProfile(file.name, sentencesOf(reply), reply.candidates);
        return chosen ? openGsd(file, chosen) : say(`${file.name} was not opened.`);
    }

    function openToml(file) {
        const reply = ask.readMapping(file);
        if (reply.mapping) return openMapping(file.name, reply);
        return notify('error', `${file.name} was not opened.`, sentencesOf(reply));
    }

    async function openKept(file) {
        const text = await readLibrary(file);
        const kept = text === null ? null : readKept(text);
        if (!kept) return notify('error', `${file.name} was not opened.`, ['It is no library of this page.']);
        return library.take(file.name, kept);
    }

    async function openTable(file) {
        const text = await readTable(file);
        const table = text === null ? null : { name: file.name, text };
        const document = store.state().history.present;
        const refusals = table ? ask.tags({ ...document, table }).refusals
            : ['It is larger than 1 MiB, or no text in UTF-8: save the table as CSV in UTF-8.'];
        if (refusals.length > 0) return notify('error', `The table ${file.name} was not loaded.`, refusals);
        edit.set('table', table);
        return say(`The table ${file.name} was loaded: ${ask.tags(store.state().history.present).tags.length} rows.`);
    }

    return {
        openTable,
        /** Opens a file of any kind that the page knows. */
        async open(file) {
            store.change({ notice: null });
            if (ending(file.name) === 'json') return openKept(file);
            if (ending(file.name) === 'csv') return openTable(file);
            const read = await readOrSay(file);
            if (!read) return undefined;
            return ending(file.name) === 'toml' ? openToml(read) : openGsd(read);
        },
        openRead: openGsd,
        /** Reads a file into one side of check and compare: 0 or 1. */
        async check(file, side) {
            const read = await readOrSay(file);
            if (read) setSide(side, read);
        },
        /** The mapping that is edited, as the file it would be. */
        checkPresent(side) {
            const document = store.state().history.present;
            const reply = ask.make(document, `${document.name}.GSD`);
            if (!reply.octets) return notify('error', 'The mapping gives no file yet.', sentencesOf(reply));
            return setSide(side, { name: `${document.name}.GSD`, octets: reply.octets });
        },
        forget: (side) => setSide(side, null),
    };

    function setSide(side, file) {
        const sides = [...store.state().sides];
        sides[side] = file;
        store.change({ sides, screen: 'check', notice: null });
        if (!file) return say('The file was removed.');
        const bad = sides.find((one) => one && !ask.check(one).findings);
        if (bad) return say(`${bad.name}: ${sentencesOf(ask.check(bad)).join(' ')}`, 'error');
        return say(sides.every(Boolean) ? `${sides[0].name} and ${sides[1].name} are compared.` : ask.check(file).lines.slice(-1)[0]);
    }
}
