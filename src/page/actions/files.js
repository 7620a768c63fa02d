// SPDX-License-Identifier: Apache-2.0
// Files that the user opens: each is read as what it is, or refused with a sentence.
import { documentOf } from '../mapping/model.js';
import { contentOf, readKept } from '../mapping/keeping.js';
import { sentencesOf } from '../questions.js';
import { readFile, readLibrary, readTable } from '../files/disk.js';

const stem = (name) => name.replace(/\.[^.]*$/, '') || name;
const ending = (name) => (/\.([^.]*)$/.exec(name)?.[1] ?? '').toLowerCase();

/** A folder that was dropped, or a file that is gone, cannot be read: null. */
export async function readOrSay(file, notify) {
    try {
        return await readFile(file);
    } catch (error) {
        notify('error', `${file.name} cannot be read.`, [error.message]);
        return null;
    }
}

/** Files that are a mapping: {openGsd, openToml}. */
function openingMappings({ store, ask, say, notify, edit, chooseProfile }) {
    function openMapping(name, reply, lost = []) {
        const profile = ask.profile(reply.mapping.profile);
        if (!profile) return notify('error', `${name} was not opened.`, [`There is no profile "${reply.mapping.profile}" in this page.`]);
        const table = reply.table ? { name: reply.table_name, text: reply.table } : null;
        edit.open(documentOf(stem(name), reply.mapping, profile.default_list, table), `${name} was opened.`);
        const notes = reply.messages.filter((one) => one.startsWith('note: '));
        if (lost.length === 0 && notes.length === 0) return store.change({ saved: contentOf(store.state().history.present) });
        if (lost.length === 0) return notify('warning', `${name} was opened.`, notes);
        return notify('warning', `${name} was opened. The file that is made of it differs from it:`,
            [...notes, ...reply.refusals, ...lost.map((one) => one.text)]);
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

    return { openGsd, openToml };
}

/** Files that belong to mappings: {openKept, openTable}. */
function openingOthers({ store, ask, say, notify, edit, library }) {
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

    return { openKept, openTable };
}

/** The actions that open files from the disk. */
export function opening(app) {
    const { openGsd, openToml } = openingMappings(app);
    const { openKept, openTable } = openingOthers(app);
    return {
        openTable,
        /** Opens a file of any kind that the page knows. */
        async open(file) {
            app.store.change({ notice: null });
            if (ending(file.name) === 'json') return openKept(file);
            if (ending(file.name) === 'csv') return openTable(file);
            const read = await readOrSay(file, app.notify);
            if (!read) return undefined;
            return ending(file.name) === 'toml' ? openToml(read) : openGsd(read);
        },
        openRead: openGsd,
    };
}
