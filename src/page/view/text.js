// SPDX-License-Identifier: Apache-2.0
// The text of the GSD file. Where a parameter has octets or a comment in it, they are underlined in the parameter's colour.
import { h, hueOf } from './dom.js';
import { ownersOf } from './octets.js';

const kTelegrams = { User_Prm_Data: 'set_prm', Module: 'chk_cfg' }; // by the keyword that has its octets

/** The octets of each line: {telegram, places}, a place {at, octet} for each one. Null: the line has none. */
function octetsOf(lines) {
    let telegram = null;
    return lines.map((line, number) => {
        const goesOn = number > 0 && lines[number - 1].trimEnd().endsWith('\\');
        if (!goesOn) telegram = kTelegrams[/^(\w+)\s*=/.exec(line)?.[1]] ?? null;
        if (!telegram) return null;
        const start = line.lastIndexOf('"') + 1; // behind the name of a module
        const places = [...line.slice(start).matchAll(/0x[0-9A-F]{2}/g)].map((one) => ({ at: start + one.index, octet: Number(one[0]) }));
        return { telegram, places };
    });
}

/** The owners of a telegram's octets, where the text has the octets that the preview has. Else none is marked. */
function ownersIn(preview, found, telegram) {
    const octets = found.flatMap((one) => (one?.telegram === telegram ? one.places.map(({ octet }) => octet) : []));
    const same = octets.length === preview[telegram].length && octets.every((octet, at) => octet === preview[telegram][at]);
    return same ? ownersOf(preview, telegram) : [];
}

/** A part of the text that belongs to a parameter. Neighbours also differ without colour: in the kind of line. */
function mark(preview, number, text) {
    const one = preview.parameters[number - 1];
    const title = one ? `Parameter ${number}: ${one.tag} ${one.name || ''}`.trim() : 'Demand Data';
    return h('span', { class: `${hueOf(number)} part ${number % 2 === 0 ? 'even' : ''}`.trim(), title, 'data-parameter': number }, text);
}

/** A line with octets: those of one parameter that follow each other are one part. */
function octetLine(preview, line, places, owners) {
    const parts = [];
    let end = 0;
    for (let from = 0; from < places.length;) {
        let to = from;
        while (to + 1 < places.length && owners[to + 1] === owners[from]) ++to;
        const [start, behind] = [places[from].at, places[to].at + '0x00'.length];
        if (owners[from]) parts.push(line.slice(end, start), mark(preview, owners[from], line.slice(start, behind)));
        else parts.push(line.slice(end, behind));
        end = behind;
        from = to + 1;
    }
    return [...parts, line.slice(end)];
}

/** A comment that names a parameter, as "; 3 out tag 6 ..." does. */
function commentLine(preview, line) {
    const [, start, number, tag] = /^(; )(\d+) \S+ tag (\d+)/.exec(line) ?? [];
    if (preview.parameters[number - 1]?.tag !== Number(tag)) return line;
    return [start, mark(preview, Number(number), line.slice(start.length).trimEnd())];
}

/** The text of a preview, as parts of one line each. */
export function textPart(preview) {
    const lines = preview.text.split(/\r?\n/);
    const found = octetsOf(lines);
    const owners = { set_prm: ownersIn(preview, found, 'set_prm'), chk_cfg: ownersIn(preview, found, 'chk_cfg') };
    return lines.flatMap((line, number) => {
        const end = number + 1 < lines.length ? '\n' : '';
        if (!found[number]) return [commentLine(preview, line), end];
        const { telegram, places } = found[number];
        return [octetLine(preview, line, places, owners[telegram].splice(0, places.length)), end];
    });
}
