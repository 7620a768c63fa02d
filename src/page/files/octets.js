// SPDX-License-Identifier: Apache-2.0
// Octets as base64, as hexadecimal and as a hash. Pure.

/** base64 of octets. */
export function base64Of(octets) {
    const kPiece = 0x8000; // arguments of one call
    let text = '';
    for (let at = 0; at < octets.length; at += kPiece) text += String.fromCharCode(...octets.subarray(at, at + kPiece));
    return btoa(text);
}

/** The octets of a base64 text. */
export function octetsOf(base64) {
    return Uint8Array.from(atob(base64), (one) => one.charCodeAt(0));
}

/** One octet as two hexadecimal digits. */
export function hex(octet) {
    return octet.toString(16).toUpperCase().padStart(2, '0');
}

/** A number as 0x and four digits. */
export function hexWord(number) {
    return `0x${number.toString(16).toUpperCase().padStart(4, '0')}`;
}

/** The first 32 bits behind the point of the roots of the primes: FIPS 180-4, 4.2.2 and 5.3.3. */
function fractions(count, root) {
    const found = [];
    for (let number = 2; found.length < count; ++number) {
        let prime = true;
        for (let by = 2; by * by <= number; ++by) prime = prime && number % by !== 0;
        if (prime) found.push(((number ** (1 / root)) % 1) * 2 ** 32 | 0);
    }
    return found;
}

const kRounds = fractions(64, 3);
const turn = (word, by) => (word >>> by) | (word << (32 - by));

function round(state, words) {
    const schedule = [...words];
    for (let at = 16; at < 64; ++at) {
        const a = schedule[at - 15], b = schedule[at - 2];
        schedule[at] = (schedule[at - 16] + (turn(a, 7) ^ turn(a, 18) ^ (a >>> 3)) +
            schedule[at - 7] + (turn(b, 17) ^ turn(b, 19) ^ (b >>> 10))) | 0;
    }
    let [a, b, c, d, e, f, g, h] = state;
    for (let at = 0; at < 64; ++at) {
        const one = (h + (turn(e, 6) ^ turn(e, 11) ^ turn(e, 25)) + ((e & f) ^ (~e & g)) + kRounds[at] + schedule[at]) | 0;
        const two = ((turn(a, 2) ^ turn(a, 13) ^ turn(a, 22)) + ((a & b) ^ (a & c) ^ (b & c))) | 0;
        [a, b, c, d, e, f, g, h] = [(one + two) | 0, a, b, c, (d + one) | 0, e, f, g];
    }
    return [a, b, c, d, e, f, g, h].map((word, at) => (word + state[at]) | 0);
}

/** SHA-256 in hexadecimal. The browser's own is not there on every address from which the page may open. */
export function sha256(octets) {
    const padded = new Uint8Array(((octets.length + 8) >> 6 << 6) + 64);
    padded.set(octets);
    padded[octets.length] = 0x80;
    const view = new DataView(padded.buffer);
    view.setUint32(padded.length - 8, Math.floor(octets.length / 2 ** 29));
    view.setUint32(padded.length - 4, octets.length << 3);
    let state = fractions(8, 2);
    for (let block = 0; block < padded.length; block += 64)
        state = round(state, Array.from({ length: 16 }, (_, at) => view.getInt32(block + 4 * at)));
    return state.map((word) => (word >>> 0).toString(16).padStart(8, '0')).join('');
}
