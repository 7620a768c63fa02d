// SPDX-License-Identifier: Apache-2.0
// What the page asks the core (docs/internals/configurator-calls.md). Answers that are asked for again and again are kept.
import { indexOf } from './mapping/search.js';
import { fileNameOf, mappingOf } from './mapping/model.js';

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

const kLost = 'character_lost';

export const isError = (finding) => finding.severity === 'error';

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
        /**
         * What a document gives. `findings` is the verdict: the check of the saved file has the same. A character that got lost
         * cannot be seen in the file, so it is a remark, which stands at its field.
         */
        preview: kept(4, (document) => JSON.stringify([fileNameOf(document), mappingOf(document), tableOf(document)]), (document) => {
            const reply = ask('preview', document, { name: fileNameOf(document) });
            const field = reply.field ?? (document.table ? 'table' : 'profile');
            const wrong = reply.exit === 0 ? [] : sentencesOf(reply).map((text) => ({ code: 'refused', severity: 'error', text, field }));
            const all = [...wrong, ...(reply.findings ?? [])];
            return {
                parameters: [], set_prm: [], chk_cfg: [], demand: null, ...reply,
                findings: all.filter((one) => one.code !== kLost), remarks: all.filter((one) => one.code === kLost),
            };
        }),
        make: (document, name) => ask('make', document, { name }),
        mappingFile: (document) => ask('mapping', document),
        importFile: (file, profile) => call({ do: 'import', file: file.octets, name: file.name, ...(profile && { profile }) }),
        readMapping: (file) => call({ do: 'read_mapping', file: file.octets, name: file.name }),
        /** The device that a GSD file is for: {profile, table}. The draft says it where the file leaves a choice. */
        deviceOf(file, draft) {
            const { mapping, candidates = [] } = call({ do: 'import', file: file.octets, name: file.name });
            const profile = mapping?.profile ?? candidates.find((one) => one === draft.profile) ?? '';
            return withTable({ profile, ...(mapping && { mapping }) }, profile === draft.profile ? draft : {});
        },
        deviceOfDraft: (document) => withTable({ profile: document.profile, mapping: mappingOf(document) }, document),
        // Files with the `device` that they are for.
        check: ({ octets, name, device }) => call({ do: 'check', file: octets, name, ...device }),
        show: ({ octets, name, device }) => call({ do: 'show', file: octets, name, ...device }),
        diff(file, other) {
            const named = [file, other].filter((one) => one.device.profile !== '');
            const one = named.every(({ device }) => device.profile === named[0].device.profile);
            return call({ do: 'diff', file: file.octets, other: other.octets, name: file.name, ...(one && named[0]?.device) });
        },
    };
}
