// SPDX-License-Identifier: Apache-2.0
// Draft and library as texts: what the browser's storage and the exported file hold. Pure. A text that comes back is
// not trusted: what is no document is left out.
import { documentOf, kDirections, mappingOf } from './model.js';

const kForm = 'dpslaved configurator 1';
const kMostEntries = 500; // no telegram has so many: 244 octets in each direction

function packed(document) {
    return { name: document.name, mapping: mappingOf(document), table: document.table };
}

const isText = (value) => typeof value === 'string';
const isNumber = (value) => Number.isSafeInteger(value) && value >= 0;
const isEntry = (value) => isText(value) && new RegExp(`^(${kDirections.join('|')}):[0-9]{1,9}$`).test(value);

const isList = (list) => Array.isArray(list) && list.length <= kMostEntries && list.every(isEntry);

function isMapping(mapping) {
    const optional = (key, test) => mapping[key] === undefined || test(mapping[key]);
    return mapping !== null && typeof mapping === 'object' && isText(mapping.profile) &&
        (mapping.list === undefined ? Array.isArray(mapping.tags) : isList(mapping.list)) &&
        optional('ident', isNumber) && optional('max_tsdr', isNumber) &&
        optional('description', isText) && optional('model', isText);
}

function unpacked(one) {
    if (one === null || typeof one !== 'object' || !isText(one.name) || !isMapping(one.mapping)) return null;
    const table = one.table && isText(one.table.name) && isText(one.table.text)
        ? { name: one.table.name, text: one.table.text } : null;
    return documentOf(one.name, one.mapping, [], table);
}

function parsed(text) {
    try {
        const all = JSON.parse(text);
        return all !== null && typeof all === 'object' && all.form === kForm ? all : null;
    } catch {
        return null;
    }
}

/** A draft, a library or both as one text. */
export function textOf({ draft = null, library = [] }) {
    return JSON.stringify({
        form: kForm,
        draft: draft && packed(draft),
        library: library.map((entry) => ({ ...packed(entry.document), stored: entry.stored })),
    }, null, 1);
}

/** What textOf() wrote: {draft, library, lost}, `lost` the number of entries that are none. Null: it is another text. */
export function readKept(text) {
    const all = parsed(text);
    if (!all) return null;
    const entries = Array.isArray(all.library) ? all.library : [];
    const library = [];
    for (const one of entries) {
        const document = unpacked(one);
        if (document) library.push({ document, stored: isText(one.stored) ? one.stored : '' });
    }
    return { draft: unpacked(all.draft), library, lost: entries.length - library.length };
}

/** Whether two entries are for the same name and device. */
export function isSame(one, other) {
    return one.document.name === other.document.name && one.document.profile === other.document.profile;
}

/** All that a document makes, whatever it is called. */
export function contentOf(document) {
    return JSON.stringify([mappingOf(document), document.table]);
}

/** Whether two documents are the same draft. */
export function isSameDraft(one, other) {
    return one.name === other.name && contentOf(one) === contentOf(other);
}

/** Whether the library has another content under the document's name and device. */
export function hasOther(library, document) {
    const old = library.find((one) => isSame(one, { document }));
    return old !== undefined && contentOf(old.document) !== contentOf(document);
}

/** The library with the entries of another one. One that has the name but not the content of an old one gets a further name. */
export function merged(library, entries) {
    let all = library;
    for (const entry of entries) {
        let { document } = entry;
        for (let further = 2; ; ++further) {
            const old = all.find((one) => isSame(one, { document }));
            if (!old || contentOf(old.document) === contentOf(document)) break;
            document = { ...document, name: `${entry.document.name} (${further})` };
        }
        all = withDocument(all, document, entry.stored);
    }
    return all;
}

/** The library with a document in it. One with the same name and profile is replaced. */
export function withDocument(library, document, stored) {
    const others = library.filter((one) => !isSame(one, { document }));
    return [...others, { document, stored }].sort((a, b) => a.document.name.localeCompare(b.document.name));
}
