// SPDX-License-Identifier: Apache-2.0
// The rows of a tag table by words and by lists. Pure. The text of each row is put together once, so that a key of the
// search costs one look at each row.

/** The tab with all words of bits. It stands beside the tabs of the instrument's lists. */
export const kStatusWords = 'Status words';
const kNoSection = 'Parameters';

// What controllers show for a parameter: HA026290, table 4-1 (PV, SP1, SP2), and the mnemonics of HA026230, chapter 5.
const kShort = {
    pv: 'process variable', sp: 'setpoint', tsp: 'target setpoint', wsp: 'working setpoint', op: 'output power',
    xp: 'proportional band', ti: 'integral time', td: 'derivative time',
};

/** Prepares a table for search and tabs: {tags, byNumber, tabs}. A tab is {name, tags}. */
export function indexOf(tags) {
    const sections = new Map();
    for (const tag of tags) {
        const name = tag.section || kNoSection;
        if (!sections.has(name)) sections.set(name, []);
        sections.get(name).push(tag);
    }
    const tabs = [...sections].map(([name, rows]) => ({ name, tags: rows }));
    const words = tags.filter((tag) => tag.status_word);
    if (words.length > 0) tabs.push({ name: kStatusWords, tags: words });
    const texts = tags.map((tag) =>
        `${tag.number} ${tag.name} ${tag.mnemonic} ${tag.aliases.join(' ')} ${tag.section}`.toLowerCase());
    return { tags, texts, tabs, byNumber: new Map(tags.map((tag) => [tag.number, tag])) };
}

const wordsOf = (text) => text.toLowerCase().split(/\s+/).filter(Boolean);

/** A query as it is typed, and with what the instrument's mnemonics in it stand for: SP1 is setpoint 1. */
function readingsOf(query) {
    const typed = wordsOf(query);
    const long = typed.flatMap((word) => {
        const [, letters, digits] = /^([a-z]+)(\d*)$/.exec(word) ?? [];
        return Object.hasOwn(kShort, letters) ? wordsOf(`${kShort[letters]} ${digits}`) : [word];
    });
    return [typed, long];
}

/** How well a row fits, the best first: the number, a whole name, the start of one, starts of words, anything. */
function rankOf(tag, readings) {
    const names = [tag.name, tag.mnemonic, ...tag.aliases].filter(Boolean).map((name) => name.toLowerCase());
    const whole = readings.map((words) => words.join(' '));
    if (String(tag.number) === whole[0]) return 0;
    if (whole.some((text) => names.includes(text))) return 1;
    if (whole.some((text) => names.some((name) => name.startsWith(text)))) return 2;
    const parts = names.flatMap((name) => name.split(/[^a-z0-9]+/));
    if (readings.some((words) => words.every((word) => parts.some((part) => part.startsWith(word))))) return 3;
    return 4;
}

/** The rows that have all words of the query, the ones that fit best first. */
export function search(index, query) {
    const readings = readingsOf(query);
    const has = (text) => readings.some((words) => words.every((word) => text.includes(word)));
    return index.tags.filter((_, at) => has(index.texts[at]))
        .map((tag) => ({ tag, rank: rankOf(tag, readings) })).sort((a, b) => a.rank - b.rank).map(({ tag }) => tag);
}

/** How many letters are to be put in, left out, exchanged or changed so that one word becomes the other. */
function distance(one, other) {
    const rows = [[...Array(other.length + 1).keys()]];
    for (let at = 1; at <= one.length; ++at) {
        const row = [at];
        for (let by = 1; by <= other.length; ++by) {
            row[by] = Math.min(rows[at - 1][by] + 1, row[by - 1] + 1, rows[at - 1][by - 1] + (one[at - 1] === other[by - 1] ? 0 : 1));
            if (at > 1 && by > 1 && one[at - 1] === other[by - 2] && one[at - 2] === other[by - 1])
                row[by] = Math.min(row[by], rows[at - 2][by - 2] + 1);
        }
        rows.push(row);
    }
    return rows[one.length][other.length];
}

/** The word of the table's names that is most like a word, and of those the one that most rows have. Empty: none is like it. */
function mostLike(index, word) {
    const most = word.length < 5 ? 1 : 2;
    const counts = new Map();
    for (const { name, mnemonic } of index.tags)
        for (const one of `${name} ${mnemonic}`.toLowerCase().split(/[^a-z0-9]+/)) if (one.length > 2) counts.set(one, (counts.get(one) ?? 0) + 1);
    const near = [...counts].filter(([one]) => Math.abs(one.length - word.length) <= most)
        .map(([one, count]) => ({ one, count, far: distance(one, word) })).filter(({ far }) => far <= most)
        .sort((a, b) => a.far - b.far || b.count - a.count);
    return near[0]?.one ?? '';
}

/** For a query that finds nothing: one that finds something, with its wrong words mended. Empty: there is none. */
export function suggestion(index, query) {
    const mended = wordsOf(query).map((word) => (search(index, word).length > 0 ? word : mostLike(index, word)));
    const text = mended.join(' ');
    return mended.length > 0 && mended.every(Boolean) && search(index, text).length > 0 ? text : '';
}
