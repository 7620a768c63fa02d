// SPDX-License-Identifier: Apache-2.0
// The [[station]] block for dpslaved.toml that belongs to a mapping. Pure. What it takes is what dpslaved takes: tests
// compare both.

// Letters as dpslaved knows them: what a terminal shows in one word, no sign and no space (src/config/station.cpp).
const kLetters = 'A-Za-z\u00C0-\u00D6\u00D8-\u00F6\u00F8-\u061B\u061D-\u167F\u1681-\u180D\u180F-\u1FFF\u2C00-\u2DFF\u3005-\uD7FF';
const kName = new RegExp(`^[${kLetters}0-9_.][${kLetters}0-9_.-]{0,31}$`);
const kNumber = /^[+-]?(0[xX][0-9a-fA-F]+|[0-9.]+)$/;

/** A text as a TOML string. */
function quoted(text) {
    return JSON.stringify(text).replace(/\u007f/g, '\\u007F');
}

function whyNoName(name) {
    if (kNumber.test(name)) return 'The station name is a number, which would be taken for an address. Begin it with a letter.';
    if (!kName.test(name)) return 'The station name takes letters, digits, "_", "-" and ".", 32 at most. Do not begin it with "-".';
    return '';
}

function whyNoAddress(address, { min_address: least, max_address: most }) {
    const fits = /^[0-9]{1,3}$/.test(address) && Number(address) >= least && Number(address) <= most;
    return fits ? '' : `The PROFIBUS address has to be a number from ${least} to ${most}.`;
}

function whyNoUnit(unit, { protocols }) {
    const ascii = protocols.includes('ei-ascii');
    const modbus = protocols.includes('modbus-rtu');
    if (ascii && /^[0-9a-fA-F]{2}$/.test(unit)) return '';
    if (modbus && /^[0-9]{1,3}$/.test(unit) && Number(unit) >= 1 && Number(unit) <= 247) return '';
    if (!modbus) return 'The unit has to be two hexadecimal digits, group and unit id of the drive, such as 00.';
    return ascii ? 'The unit has to be two hexadecimal digits, or a Modbus address from 1 to 247.'
        : 'The unit has to be the Modbus address of the instrument, 1 to 247.';
}

const whyNoLine = (line) => (line === '' || /[\u0000-\u001f\u007f]/.test(line) ? 'Name the drive line.' : '');

/**
 * Why dpslaved would refuse the block: {field, text}, a key of `place` and a sentence; null: it takes it. `place`: {name,
 * address, line, unit}, texts. The Ident_Number is asked for before.
 */
export function whyNoStation(profile, place) {
    const all = {
        name: whyNoName(place.name), address: whyNoAddress(place.address, profile), line: whyNoLine(place.line),
        unit: whyNoUnit(place.unit, profile),
    };
    const field = Object.keys(all).find((one) => all[one] !== '');
    return field ? { field, text: all[field] } : null;
}

/** The block. `place` as whyNoStation() takes it. */
export function stationBlock(document, profile, place) {
    const lines = [
        '[[station]]',
        `name = ${quoted(place.name)}`,
        `address = ${Number(place.address)}`,
        `profile = ${quoted(document.profile)}`,
        `line = ${quoted(place.line)}`,
        `unit = ${quoted(place.unit)}`,
    ];
    if (document.ident !== null) lines.push(`ident = 0x${document.ident.toString(16).toUpperCase().padStart(4, '0')}`);
    const { tags_at: tagsAt, identifiers } = document.plant ?? {};
    if (tagsAt !== undefined) lines.push(`tags_at = ${tagsAt}`);
    if (identifiers !== undefined) lines.push(`identifiers = [${identifiers.map(quoted).join(', ')}]`);
    if (document.table) lines.push(`tags = ${quoted(document.table.name)}`);
    if (document.max_tsdr !== null) lines.push(`# The GSD file has a MaxTsdr of its own: write max_tsdr = ${document.max_tsdr} into [bus].`);
    return lines.join('\n') + '\n';
}
