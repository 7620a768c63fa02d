// SPDX-License-Identifier: Apache-2.0
// What the page asks the core (docs/internals/configurator-calls.md). Answers that are asked for again and again are kept.
import { indexOf } from './mapping/search.js';
import { mappingOf } from './mapping/model.js';

/** Keeps the last answers of a function of one object. */
function kept(most, keyOf, answer) {
    const known = new Map();
    return (about) => {
        const key = keyOf(about);
        if (known.has(key)) return known.get(key);
        const made = answer(about);
        known.set(key, made);
        if (known.size > most) known.delete(known.keys().next().value);
        return made;
    };
}

/** Why there is no answer, as sentences of the core. */
export function sentencesOf(reply) {
    return [...reply.refusals, ...reply.messages];
}

/** All questions of the page. */
export function questions(call) {
    const { profiles } = call({ do: 'profiles' });
    const withTable = (request, document) => (document.table
        ? { ...request, table: document.table.text, table_name: document.table.name } : request);
    const ask = (what, document, more = {}) => call(withTable({ do: what, mapping: mappingOf(document), ...more }, document));
    const tableOf = (document) => `${document.profile}\n${document.table ? document.table.text : ''}`;
    return {
        profiles,
        profile: (name) => profiles.find((one) => one.name === name),
        samples: kept(1, () => '', () => call({ do: 'samples' }).samples),
        /** The table of a document, ready for search; `refusals` where it cannot be read. */
        tags: kept(3, tableOf, (document) => {
            const reply = call(withTable({ do: 'tags', profile: document.profile }, document));
            return { ...indexOf(reply.tags ?? []), refusals: reply.tags ? [] : sentencesOf(reply) };
        }),
        preview: kept(4, (document) => JSON.stringify(mappingOf(document)) + tableOf(document), (document) => {
            const reply = ask('preview', document);
            const wrong = reply.exit === 0 ? [] : sentencesOf(reply).map((text) => ({ code: 'refused', severity: 'error', text }));
            return { parameters: [], set_prm: [], chk_cfg: [], demand: null, ...reply, findings: [...wrong, ...(reply.findings ?? [])] };
        }),
        make: (document, name) => ask('make', document, { name }),
        mappingFile: (document) => ask('mapping', document),
        importFile: (file, profile) => call({ do: 'import', file: file.octets, name: file.name, ...(profile && { profile }) }),
        readMapping: (file) => call({ do: 'read_mapping', file: file.octets, name: file.name }),
        check: (file) => call({ do: 'check', file: file.octets, name: file.name }),
        show: (file) => call({ do: 'show', file: file.octets, name: file.name }),
        diff: (file, other) => call({ do: 'diff', file: file.octets, other: other.octets, name: file.name }),
    };
}
