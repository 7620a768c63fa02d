// SPDX-License-Identifier: Apache-2.0
// The [[station]] block for dpslaved.toml that belongs to a mapping. Pure.

/** A text as a TOML string. */
function quoted(text) {
    return JSON.stringify(text).replace(/\u007f/g, '\\u007F');
}

/** The block. `place`: {name, address, line, unit}, what the mapping does not know. */
export function stationBlock(document, profile, place) {
    const lines = [
        '[[station]]',
        `name = ${quoted(place.name)}`,
        `address = ${place.address}`,
        `profile = ${quoted(document.profile)}`,
        `line = ${quoted(place.line)}`,
        `unit = ${quoted(place.unit)}`,
    ];
    if (document.ident !== null) lines.push(`ident = 0x${document.ident.toString(16).toUpperCase().padStart(4, '0')}`);
    else if (profile.ident === null) lines.push('# ident = 0x....  # required: the Ident_Number of your device');
    if (document.table) lines.push(`tags = ${quoted(document.table.name)}`);
    return lines.join('\n') + '\n';
}
