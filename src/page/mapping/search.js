// SPDX-License-Identifier: Apache-2.0
// The rows of a tag table by words and by lists. Pure. The text of each row is put together once, so that a key of the
// search costs one look at each row.

/** The tab with all words of bits. It stands beside the tabs of the instrument's lists. */
export const kStatusWords = 'Status words';
const kNoSection = 'Parameters';

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

/** The rows that have all words of the query, those whose number is the query first. */
export function search(index, query) {
    const words = query.toLowerCase().split(/\s+/).filter(Boolean);
    const found = index.tags.filter((_, at) => words.every((word) => index.texts[at].includes(word)));
    const number = words.length === 1 ? index.byNumber.get(Number(words[0])) : undefined;
    return number ? [number, ...found.filter((tag) => tag !== number)] : found;
}
