// SPDX-License-Identifier: Apache-2.0
// Numbers as they are typed: null for nothing, undefined for anything that is none. Pure.

/** A reader of numbers in a base, within limits. */
function numberIn(least, most, base, digits) {
    return (text) => {
        if (text.trim() === '') return null;
        const value = digits.test(text) ? parseInt(text.trim().replace(/^0x/i, ''), base) : NaN;
        return value >= least && value <= most ? value : undefined;
    };
}

/** An Ident_Number. Always hexadecimal, as the note beside the field and each GSD file have it: 1652 is 0x1652. */
export const identOf = numberIn(1, 0xffff, 16, /^\s*(0x)?[0-9a-f]{1,6}\s*$/i);
export const kIdentWanted = '0x0001 to 0xFFFF';

/** A number of bit times. */
export const bitTimesOf = numberIn(11, 0xffff, 10, /^\s*[0-9]{1,8}\s*$/);
export const kBitTimesWanted = '11 to 65535';

/** A tag of a device, whose last one is `most`. */
export const tagOf = (text, most) => numberIn(1, most, 10, /^\s*[0-9]{1,9}\s*$/)(text);
