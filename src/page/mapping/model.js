// SPDX-License-Identifier: Apache-2.0
// The document that is edited: a mapping, its file name and the user's own tag table. Pure: an edit gives a new document
// and leaves the old one as it is. What the octets, limits and findings of a mapping are, only the core knows.

/** The directions as the master sees them, in the order of their lists. */
export const kDirections = ['in', 'out', 'in-out'];

/** What the page calls the list of a direction. */
export const kListNames = { in: 'inputs', out: 'outputs', 'in-out': 'read and write' };

/** The name of the GSD file of a document: a name may have another ending of such files, as .GSE. */
export function fileNameOf({ name }) {
    return /\.gs[a-z]$/i.test(name) ? name : `${name}.GSD`;
}

/** The keys of a mapping that say what the plant's own GSD file has otherwise than the profile. The page keeps them as they are. */
const kPlantKeys = ['tags', 'tags_at', 'identifiers', 'modules', 'user_prm_data_len', 'max_module', 'max_input_len', 'max_output_len', 'max_data_len'];

function plantOf(mapping) {
    const keys = kPlantKeys.filter((key) => mapping[key] !== undefined && mapping[key] !== null);
    return keys.length === 0 ? null : Object.fromEntries(keys.map((key) => [key, mapping[key]]));
}

let documents = 0;

/** A document from a mapping as the core gives it. `fallback` is the list where the mapping has none. */
export function documentOf(name, mapping, fallback = [], table = null) {
    return {
        id: ++documents,
        name,
        table,
        profile: mapping.profile,
        list: (mapping.list ?? (mapping.tags ? [] : fallback)).map(entryOf),
        plant: plantOf(mapping),
        demand: mapping.demand === true,
        ident: mapping.ident ?? null,
        max_tsdr: mapping.max_tsdr ?? null,
        description: mapping.description ?? null,
        model: mapping.model ?? null,
    };
}

function entryOf(text) {
    const colon = text.indexOf(':');
    return { direction: text.slice(0, colon), tag: Number(text.slice(colon + 1)) };
}

/** The mapping of a document as the core takes it. */
export function mappingOf(document) {
    const mapping = {
        profile: document.profile,
        list: document.list.map(({ direction, tag }) => `${direction}:${tag}`),
        demand: document.demand,
        ...document.plant,
    };
    if (document.plant?.tags && document.list.length === 0) delete mapping.list; // the modules of the master's project say the directions
    for (const key of ['ident', 'max_tsdr', 'description', 'model'])
        if (document[key] !== null) mapping[key] = document[key];
    return mapping;
}

/** The places in the telegram's list that belong to a direction. */
export function placesOf(document, direction) {
    return document.list.flatMap((entry, at) => (entry.direction === direction ? [at] : []));
}

/** Where a further entry of a direction goes: behind the last of it, else behind the lists before it. */
function endOf(list, direction) {
    const behind = (directions) => list.reduce((end, one, at) => (directions.includes(one.direction) ? at + 1 : end), 0);
    return behind([direction]) || behind(kDirections.slice(0, kDirections.indexOf(direction)));
}

function withList(document, list) {
    return { ...document, list };
}

/** Adds a tag before the entry at `before`, or at the end of its list. Gives the document and the new entry's place. */
export function addEntry(document, direction, tag, before = null) {
    const at = before ?? endOf(document.list, direction);
    const entry = { direction, tag };
    return { document: withList(document, [...document.list.slice(0, at), entry, ...document.list.slice(at)]), at };
}

/** Moves an entry before another one, or to the end of a direction's list. Gives the document and the new place. */
export function moveEntry(document, from, direction, before = null) {
    const { tag } = document.list[from];
    const without = withList(document, document.list.filter((_, at) => at !== from));
    return addEntry(without, direction, tag, before !== null && before > from ? before - 1 : before);
}

/** Moves an entry by one place up (-1) or down (+1) in its own list. Null: it is already at that end. */
export function stepEntry(document, from, step) {
    const { direction } = document.list[from];
    const places = placesOf(document, direction);
    const other = places[places.indexOf(from) + step];
    if (other === undefined) return null;
    return moveEntry(document, from, direction, step < 0 ? other : other + 1);
}

/** Moves an entry by one place up (-1) or down (+1) in the telegram, whatever its neighbour's direction. Null: it is at that end. */
export function stepInTelegram(document, from, step) {
    const to = from + step;
    if (to < 0 || to >= document.list.length) return null;
    return moveEntry(document, from, document.list[from].direction, step < 0 ? to : to + 1);
}

/** Removes one entry. */
export function removeEntry(document, from) {
    return withList(document, document.list.filter((_, at) => at !== from));
}

/** Removes all entries of a direction. */
export function clearDirection(document, direction) {
    return withList(document, document.list.filter((one) => one.direction !== direction));
}

/** Sets one of: name, demand, plant, ident, max_tsdr, description, model, table. */
export function setField(document, key, value) {
    return document[key] === value ? document : { ...document, [key]: value };
}
